// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/law/contact_law.hpp"

#include <cstddef>
#include <cstdint>

namespace talus
{

/// Lanes of a pack: contacts that a wide register solves at once.
inline constexpr int pack_size = 8;

/// Eight contacts, no two of which share a body, so that their order does not matter: all that a sweep streams, lane
/// beside lane, 104 B a contact. They are filled from lane 0 on; a lane that is empty has a = b = −1, and zeros. A lane
/// that holds two spheres which do not touch has zeros for what the laws make: a sweep changes nothing by it.
struct alignas(64) ContactPack {
    // Placed by assembly (PackFiller), read by all.
    std::int32_t a[pack_size]; ///< body that a sweep changes, of the sphere with the same index (State::body_of)
    std::int32_t b[pack_size]; ///< the other one or, in packs of wall contacts, the wall

    // Found by detection and recalled from materials, read by laws and sweeps.
    double normal[3][pack_size]; ///< n, unit, from b to a
    double arm_scale[pack_size]; ///< s
    double friction[pack_size];  ///< μ

    // λ⁰ of the laws; sweeps change it, and `hand_on` reads it.
    double impulse[3][pack_size]; ///< λ [N s] on a

    // Made by the laws, changed beside impacts (TileContacts::set_law), read by sweeps.
    double target[pack_size];       ///< q_n [m/s]
    double parting[pack_size];      ///< u_n that it asks for at most [m/s]
    double normal_mass[pack_size];  ///< 1 / (W + Σ_n) [kg]
    double tangent_mass[pack_size]; ///< 1 / (W (1 + 5/2 s²)) [kg]
};
static_assert(sizeof(ContactPack) == 832);

/// What a step knows of them besides their solve: made by `take_down` of what the laws have found, changed beside
/// impacts, read by `hand_on` after the solve, and by all that look at contacts.
struct alignas(64) RecordPack {
    double gap[pack_size];              ///< g at the beginning of the step [m]; < 0 is overlap
    double inverse_mass_sum[pack_size]; ///< W [1/kg]
    double compliance[pack_size];       ///< Σ_n [1/kg]
    float compression[pack_size];       ///< κ: what of the overlap a load has pressed [m]; −∞: it will keep none
    float stored[pack_size];            ///< what its spring stored before the step, as the square of a length [m²]
    float spring[pack_size];            ///< Σ_n of its spring, also where it is rigid in this step [1/kg]
    float shift[pack_size];             ///< of StepSpring [m]; not made where no material has a modulus
    float push[pack_size];              ///< what it may put in by pushing out, by its impulse [m/s]
    float restitution[pack_size];       ///< e
    float hands_on[pack_size];          ///< normal impulse at most [N s]
    std::uint32_t slot[pack_size];      ///< where it is kept what it carries
    ContactKind kind[pack_size];
    std::uint8_t touch[pack_size]; ///< TouchRecord: what is known from the steps before
    std::uint8_t in_problem = 0;   ///< lanes, as bits: contacts of this step

    bool holds(std::size_t lane) const { return (in_problem >> lane & 1U) != 0; }
};

/// Their rolling rows, and that along n: made by make_rolling_rows, swept like contacts.
struct alignas(64) RollingPack {
    double impulse[3][pack_size];  ///< angular impulse on a [N m s], at right angles to n
    double twist[pack_size];       ///< … and along n
    double reach[pack_size];       ///< μ_r R* [m]
    double twist_reach[pack_size]; ///< μ_t R* [m]
    double inertia[pack_size];     ///< 1 / (1/I_a + 1/I_b) [kg m²]
};

/// How their walls move, the mean over the step: found by detection, read by sweeps.
struct alignas(64) WallPack {
    double velocity[3][pack_size]; ///< [m/s]
    double spin[3][pack_size];     ///< [rad/s]
    double gain[pack_size];        ///< of the velocity along n since the step before [m/s]
};

/// Where walls are: found by detection, read when spheres have moved.
struct WallLevelPack {
    double level[pack_size]; ///< n·x at which the gap to the wall is zero after the step [m]
};

/// How those attract each other that do: made by find_attractions, read by apply_attractions and reports.
struct AttractionPack {
    double impulse[3][pack_size]; ///< on a, −c along the line of centres [N s]; 0: they do not
};

/// The packs of one tile as a sweep sees them.
struct PackSpan {
    ContactPack* contact = nullptr;
    RollingPack* rolling = nullptr; ///< null where the scene has none
    WallPack* wall = nullptr;       ///< null where no wall moves
    std::size_t count = 0;
};

} // namespace talus
