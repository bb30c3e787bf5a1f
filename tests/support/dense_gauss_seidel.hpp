// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/world/model.hpp"
#include "core/world/state.hpp"

#include <Eigen/Dense>

#include <vector>

namespace talus::test
{

/// A contact in the words of the note: what its rows of G, Σ, q and the cone are made of.
struct DenseContact {
    std::size_t a = 0;
    std::size_t b = 0;                 ///< unused at a wall
    bool with_wall = false;            ///< b is a wall: it moves as prescribed below, unless it is a piston's
    int piston = -1;                   ///< its index, if it is
    Vec3 piston_arm = Vec3::Zero();    ///< from its centre to the contact
    Vec3 wall_velocity = Vec3::Zero(); ///< of the wall's material at the contact
    Vec3 wall_spin = Vec3::Zero();
    Vec3 normal = Vec3::UnitZ(); ///< from b to a
    double target = 0.0;         ///< q_n
    double compliance = 0.0;     ///< Σ_n
    double friction = 0.0;       ///< μ
    double rolling_reach = 0.0;  ///< μ_r R* [m]
    Vec3 impulse = Vec3::Zero(); ///< λ⁰ on a, in space
    Vec3 rolling_impulse = Vec3::Zero();
};

/// A step's contact problem with the dense matrices of the note, eq. (1): v = (v₁, ω₁, v₂, ω₂, …), inertia 2/5 m r²,
/// and five rows for each contact: normal, two tangents, two axes of rolling, in an explicit basis of the tangent
/// plane; after the spheres come the pistons, after the contacts five rows for each of their guides.
///
/// It knows nothing of what makes the sphere kernel short: not that D_kk is diagonal, not r ω instead of ω, not
/// impulses as vectors in space. It is the oracle of that kernel.
struct DenseProblem {
    static constexpr Eigen::Index rows = 5;       ///< of a contact
    static constexpr Eigen::Index guide_rows = 5; ///< of a piston

    Eigen::MatrixXd jacobian;     ///< G
    Eigen::VectorXd inverse_mass; ///< diagonal of M⁻¹
    Eigen::VectorXd compliance;   ///< diagonal of Σ
    Eigen::VectorXd target;       ///< q
    Eigen::VectorXd drift;        ///< what the rows see of the walls' motion: the relative velocity is G v − drift
    Eigen::VectorXd impulse;      ///< λ
    Eigen::VectorXd velocity;     ///< v
    std::vector<Eigen::Matrix3d> basis; ///< of each contact: normal and two tangents as columns
    std::vector<double> friction;       ///< μ of each contact
    std::vector<double> rolling_reach;
    std::vector<bool> coupled; ///< whether D_kk of a contact is not diagonal

    /// λ of contact k as a vector in space [N s], and of its rolling rows [N m s].
    Vec3 impulse_in_space(std::size_t k) const;
    Vec3 rolling_impulse_in_space(std::size_t k) const;
};

/// The problem of these contacts with the velocities of `state` (v⁽¹⁾, gravity included) and without the warm start.
/// Lever arms between spheres are their radii scaled so that they add up to the distance of the centres.
/// @param spin whether spheres turn; where not, their inertia is infinite, and there is no rolling resistance
DenseProblem make_dense_problem(const State& state, const std::vector<DenseContact>& contacts, bool spin = true);

/// Adds the pistons of a model, released, to a problem of this many spheres: bodies with the velocity v⁽¹⁾, and rows
/// that let each move along its guide alone; then G of their contacts.
/// @pre their inertia is diagonal
void add_pistons(
    DenseProblem& problem, const State& state, const Model& model, const std::vector<DenseContact>& contacts);

/// v ← v + M⁻¹ Gᵀ λ⁰, which the note's algorithms leave out though eq. (12) needs it.
void warm_start(DenseProblem& problem);

/// One pass of Algorithm 3.1 over the contacts in the given order, with its slips put right: λ_k is stored, and the
/// projection takes the normal first and the disk of radius μ z_n (the note tests against μ z_n² where it must be μ²
/// z_n²) after it.
/// @param relaxation the note's: a factor on d, of contacts whose block is diagonal
void sweep(DenseProblem& problem, double relaxation = 1.0);

/// ε = (Σ W|δ|² / Σ W|λ|²)^½ with δ = what a sweep would change in each contact if it changed no other;
/// W is the inverse mass sum, for rolling rows the inverse inertia sum.
double residual(const DenseProblem& problem);

} // namespace talus::test
