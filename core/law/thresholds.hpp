// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// The numbers in the laws of a contact, METHOD (4). What holds each is in METHOD's table of thresholds.
namespace talus
{

/// Υ = 1/(1 + 4τ/h) at τ = 2h, the critical damping of the note's step: a bilateral
/// error g₀ decays as g₀ (1 + 2k/3) 3⁻ᵏ over k steps.
inline constexpr double upsilon = 1.0 / 9.0;

/// σ N_min of `matched`: the softest normal compliance, in inverse mass sums, at which N_min warm-started sweeps
/// neither boil nor creep. Measured in beds, columns and heaps: σ N = 0.2 is clean, 0.1 restless, 0.05 creeps, 0 boils.
inline constexpr double sigma_per_sweep = 0.2;

/// Spheres touch up to this gap, and a spring exists from this compression on, in smallest diameters: no decision
/// hangs on rounding.
inline constexpr double touching_gap = 1e-9;

/// A load below this share of an impact's impulse is none.
inline constexpr double load_share = 1e-4;

/// An impact below this share of a contact's load is light: the contact stays a spring beside it.
inline constexpr double light_share = 0.1;

/// Overlap up to which a contact is deferred beside an impact, in diameters of the smaller sphere.
inline constexpr double deferred_overlap = 0.4;

/// Of what strikes, to what bears it: up to this, columns of what bears are solved to their end.
inline constexpr double most_impact_ratio = 1100.0;

/// A spring gives way no faster than with this restitution: with a smaller one, it parts slowly.
inline constexpr double least_restitution = 0.25;

/// A contact that overlaps more than this yields, in reduced radii R*: it holds no more than what has pressed it so
/// far. What strains a contact is the root of overlap over R* (Hertz).
inline constexpr double yield_overlap = 0.05;

/// Rigid contacts get softer with the fourth power of their overlap, up to this, in diameters of the smaller sphere,
/// and up to this compliance, in inverse mass sums.
inline constexpr double rigid_yield_overlap = 0.016;
inline constexpr double rigid_softness = 0.02;

/// Share of an overlap that one position pass of `projected` removes: that of the note's step, 4Υ.
inline constexpr double projected_share = 4.0 * upsilon;

/// What sweeps may leave undone of the load of a rigid contact.
inline constexpr double undone_share = 0.03;

/// Nearer to the centre of the smaller sphere than this a contact gets stiffer, up to the second; in its diameters.
inline constexpr double stiffening_rest = 0.25;
inline constexpr double least_rest = 3e-2;

/// For reports alone, in smallest diameters: what comes deeper for many steps beyond the first (with `projected` beyond
/// where contacts yield), or twice beyond the second, has jammed, until it is shallower than the third.
inline constexpr double pressed_overlap = 0.05;
inline constexpr double jamming_overlap = 0.25;
inline constexpr double jammed_overlap = 0.01;

} // namespace talus
