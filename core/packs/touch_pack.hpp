// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/packs/contact_pack.hpp"
#include "core/packs/law.hpp"

namespace talus
{

/// Numbers that all contacts of a step share.
struct StepConstants {
    LawOfStep law;
    double reach;           ///< of open contacts [m]
    double horizon;         ///< how far ahead a gap is looked at [s]
    double touching;        ///< overlap of spheres that touch [m]
    double inverse_inertia; ///< 5/2; 0 where spheres do not turn
    bool restitution;       ///< there is some
    std::uint8_t jam_steps; ///< a touch record above this is that of a jammed contact
    double cell_length[3];  ///< of periodic axes [m], else infinite
    bool is_periodic;
};

/// Up to eight touches on their way to contacts: what detection has found, lane beside lane, and what the laws make of
/// it. The contact itself, with the numbers of its solve, stands in a ContactPack beside it: found there are a, b,
/// normal, arm_scale, friction and inverse_mass_sum, and the rest is made.
struct alignas(64) TouchPack {
    double gap[pack_size];
    double u_n[pack_size];       ///< of v⁽⁰⁾ [m/s]
    double u_n_ahead[pack_size]; ///< of v⁽¹⁾ [m/s]
    double closes[pack_size];    ///< when the gap does so, with v⁽¹⁾ [s]; used where there is restitution
    double u_n_before[pack_size]; ///< of v⁽⁰⁾ against the wall's velocity then: 0 where a sphere goes with it [m/s]
    double u_n_turned[pack_size];   ///< what the turn of the normal since the step before has added to u_n [m/s]
    double restitution[pack_size];  ///< e
    double stiffness[pack_size];    ///< k [N/m]
    double carried[3][pack_size];   ///< impulse of the step before [N s] …
    double compression[pack_size];  ///< … its κ, and then that of this step [m]
    std::int64_t loaded[pack_size]; ///< in the step before: −1 for yes, 0 for no, as in all below
    std::int64_t jammed[pack_size];

    std::int64_t impact[pack_size]; ///< made: its kind …
    std::int64_t open[pack_size];
    std::int64_t carries[pack_size];    ///< … it has an impulse from the step before
    std::int64_t waits[pack_size];      ///< … it is left out of the problem where one of its spheres has an impact
    std::int64_t in_problem[pack_size]; ///< … it is a contact of this step
    double stored_energy[pack_size];    ///< in its spring [J]
};

/// What a sphere can touch in this step meets this ball.
struct ReachBall {
    double center[3];
    double radius;
};

/// What is known of all spheres, and of what the contacts of a tile carry, as plain numbers.
struct SphereNumbers {
    const ReachBall* balls;       ///< by sphere, with the centres that they have now
    const double* motion;         ///< 8 for each sphere: v, 1/m, a, r
    const std::int32_t* material; ///< by sphere
    std::int32_t materials;       ///< how many there are
    const double* laws;           ///< 4 for each pair of materials: μ, e, μ_r, k
    const double* carried;        ///< 4 for each slot of the tile: those of CarriedContact
};

/// What a tile's touches of spheres add up to, each lane by itself, so that sums do not depend on the instruction set.
struct alignas(64) TouchSums {
    double overlap[pack_size] = {};           ///< of those that overlap, in the problem or not [m] …
    double worst_overlap[pack_size] = {};     ///< … and the largest [m]
    double stored_energy[pack_size] = {};     ///< in springs [J]
    std::int64_t overlapping[pack_size] = {}; ///< how many overlap
};

/// Lanes of a pack, as bits, that make marks on their spheres.
struct TouchMarks {
    unsigned impact = 0;  ///< they have an impact
    unsigned carries = 0; ///< they have an impulse from the step before
};

} // namespace talus
