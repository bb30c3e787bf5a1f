// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/sweep_sums.hpp"
#include "core/packs/touch_pack.hpp"

#include <array>
#include <vector>

namespace talus
{

/// What the sweep of a scene contains; chosen once for a solve, so that what a scene does not need is not there.
template <bool with_friction, bool with_spin, bool with_rolling, bool with_moving_walls> struct Rows {
    static constexpr bool friction = with_friction;
    static constexpr bool spin = with_spin;
    static constexpr bool rolling = with_rolling;
    static constexpr bool moving_walls = with_moving_walls;
    /// Its place in a table of variants.
    static constexpr std::size_t index = 2 * (with_friction + with_spin + with_rolling) + with_moving_walls;
};
inline constexpr std::size_t row_variants = 8;

/// The passes over the contacts of one tile, those between spheres first, for one instruction set and one `Rows`.
/// Whichever it is, the bits of the results are the same.
/// @param bodies all, as 8 numbers each: v, 1/m, a, r
struct SweepKernel {
    using Sweep = SweepSums (*)(const PackSpan& spheres, const PackSpan& walls, double* bodies, double relaxation);
    using Pass = SweepSums (*)(const PackSpan& spheres, const PackSpan& walls, double* bodies);
    using Start = void (*)(const PackSpan& spheres, const PackSpan& walls, double* bodies);

    Sweep relax = nullptr;      ///< every contact once
    Pass measure = nullptr;     ///< what an unrelaxed sweep would change if all contacts were relaxed at once
    Start warm_start = nullptr; ///< v ← v + M⁻¹ Gᵀ λ
};

/// What contacts leave, each lane by itself, so that sums do not depend on the instruction set.
struct alignas(64) HandedOn {
    double cone_violation[pack_size] = {};  ///< worst |λ_t| − μ λ_n [N s], at least 0
    double stored_energy[pack_size] = {};   ///< in springs [J]
    double push_out_energy[pack_size] = {}; ///< of contacts without one [J]
};

/// What makes contacts of touches.
struct TouchKernel {
    /// Lists the candidates whose balls meet or that were loaded. Returns how many.
    /// @param pairs of spheres, by candidate, which is their slot; @param near has room for all and one more
    std::size_t (*find_near)(const std::int32_t* pairs, std::uint32_t candidates, const SphereNumbers& spheres,
        const StepConstants& step, std::uint32_t* near) = nullptr;
    /// Finds how the spheres a and b of a pack lie to each other, and makes their contacts with what their slots carry.
    /// A lane whose spheres do not touch is left out of the problem, and has nothing to hand on.
    PackImpacts (*touch_spheres)(ContactPack& contact, RecordPack& record, TouchSums& sums,
        const SphereNumbers& spheres, const StepConstants& step) = nullptr;
    /// Makes contacts of touches with walls that have been found: of all lanes that have a sphere.
    PackImpacts (*touch_walls)(ContactPack& contact, RecordPack& record, TouchPack& touch, TouchSums& sums,
        const StepConstants& step) = nullptr;
    /// Stores what the contacts of a pack between spheres hand on. Touch records of those that overlap by more than
    /// jammed_overlap stay as they are, and their lanes are returned, as bits. @param carried as in SphereNumbers
    unsigned (*hand_on)(const ContactPack& contact, RecordPack& record, const LawOfStep& law, double* carried,
        HandedOn& handed) = nullptr;
};

/// The kernels for one instruction set, the sweep's by Rows::index.
struct Kernels {
    const char* instructions = "";
    std::array<SweepKernel, row_variants> sweep;
    TouchKernel touch;
};

extern const Kernels plain_kernels, avx2_kernels, avx512_kernels;

/// Those that this processor can run, the fastest first.
std::vector<const Kernels*> usable_kernels();

/// The fastest.
const Kernels& fastest_kernels();

} // namespace talus
