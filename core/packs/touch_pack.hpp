// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/law/impact.hpp"
#include "core/packs/contact_pack.hpp"

namespace talus
{

/// Numbers that all contacts of a step share.
struct StepConstants {
    LawOfStep law;
    double reach;                  ///< of open contacts [m]
    double horizon;                ///< how far ahead a gap is looked at [s]
    double inverse_inertia_factor; ///< 5/2; 0 where spheres do not turn
    double cell_length[3];         ///< of periodic axes [m], else infinite
    bool is_periodic;
};

/// Up to eight touches on their way to contacts, lane beside lane. The contact itself stands in a ContactPack beside
/// it.
struct alignas(64) TouchPack {
    // Found by detection (`detect`, WallAssembly::add), read by the laws (`event_of`).
    double gap[pack_size];              ///< g [m]
    double diameter[pack_size];         ///< of the smaller sphere [m]
    double reduced_radius[pack_size];   ///< r_a r_b/(r_a + r_b); at a wall r_a [m]
    double inverse_mass_sum[pack_size]; ///< W [1/kg]
    double u_n[pack_size];              ///< of v⁽⁰⁾ [m/s] …
    double u_n_before[pack_size];       ///< … against the velocity of the wall in the step before [m/s]
    double closes[pack_size];           ///< when the gap does so, with v⁽¹⁾ [s]

    // Recalled from materials and slots (`recall`, WallAssembly::add), read by the laws.
    double restitution[pack_size];  ///< e
    double stiffness[pack_size];    ///< k [N/m]
    double modulus[pack_size] = {}; ///< E* [Pa]; 0 where no material has one
    double carried[3][pack_size];   ///< impulse of the step before [N s]
    std::int64_t struck[pack_size]; ///< it was an impact then: −1 for yes, 0 for no
    std::int64_t pushed[pack_size]; ///< it had a gap then: −1 for yes, 0 for no
    double compression[pack_size];  ///< what its spring has handed on; the laws make κ of it [m]

    // Made by the laws (`apply_law`), read by `take_down`, which puts it into a RecordPack and into sums.
    std::int64_t kind[pack_size];      ///< ContactKind
    double compliance[pack_size];      ///< Σ_n [1/kg]
    double spring[pack_size];          ///< that of its spring, also where it is rigid [1/kg]
    double stored[pack_size];          ///< what that stored before pushing out puts in more [m²]
    double shift[pack_size] = {};      ///< of StepSpring [m]; 0 where no material has a modulus
    double full_shift[pack_size] = {}; ///< of StepSpring [m]; 0 where no material has a modulus
    double push[pack_size];            ///< of NormalLaw [m/s]
    double strain[pack_size];          ///< overlap, of that with which it yields, beyond that; else 0
    double impact_size[pack_size];     ///< of an impact [N s], else 0
    double stored_energy[pack_size];   ///< in its spring [J] …
    double push_out_energy[pack_size]; ///< … of which pushing out has put in so much [J]
};

/// What detection reads of one sphere and of its body, as the step begins: one cache line, made by SphereAssembly.
struct alignas(64) SpherePlace {
    double center[3];    ///< x [m]
    double radius;       ///< r [m]
    double velocity[3];  ///< v⁽⁰⁾ of the centre [m/s]
    double inverse_mass; ///< 1/m of its body [1/kg]
};
static_assert(sizeof(SpherePlace) == 64 && offsetof(SpherePlace, radius) == 24 &&
              offsetof(SpherePlace, velocity) == 32 && offsetof(SpherePlace, inverse_mass) == 56);

/// What is known of all spheres, and of what the contacts of a tile carry, as plain numbers.
struct SphereNumbers {
    const SpherePlace* places;    ///< by sphere
    const double* reaches;        ///< by sphere: from its centre, what it can touch in this step [m]
    const std::int32_t* material; ///< by sphere
    std::int32_t materials;       ///< how many there are
    const double* laws;           ///< 8 for each pair of materials: μ, e, μ_r, k, μ_t, E*, …
    const double* carried;        ///< 4 for each slot of the tile: those of CarriedContact
};

/// What a tile's touches of spheres add up to, each lane by itself, so that sums do not depend on the instruction set.
struct alignas(64) TouchSums {
    double overlap[pack_size] = {};           ///< of those that overlap, in the problem or not [m] …
    double worst_overlap[pack_size] = {};     ///< … and the largest [m]
    double stored_energy[pack_size] = {};     ///< in springs [J] …
    double push_out_energy[pack_size] = {};   ///< … of which pushing out has put in so much [J]
    double worst_strain[pack_size] = {};      ///< largest overlap, of that with which a contact yields
    double closing_speed[pack_size] = {};     ///< largest −u_n of those that close in the step [m/s]
    std::int64_t overlapping[pack_size] = {}; ///< how many overlap, in the problem or not …
    std::int64_t contacts[pack_size] = {};    ///< … are in it …
    std::int64_t impacts[pack_size] = {};     ///< … and are impacts
};

/// The impacts of a pack.
struct PackImpacts {
    unsigned lanes = 0;     ///< as bits
    double size[pack_size]; ///< [N s]
};

} // namespace talus
