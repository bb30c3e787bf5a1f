// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/candidates/candidate_list.hpp"
#include "core/contacts/pack_filler.hpp"
#include "core/packs/touch_pack.hpp"
#include "core/world/state.hpp"

#include <atomic>
#include <vector>

namespace talus
{

/// What a thread needs to assemble contacts.
struct AssemblyRoom {
    PackFiller filler;
    std::vector<std::uint32_t> near; ///< candidates of a tile between spheres …
    std::vector<TouchPack> touches;  ///< … and what was found of its contacts with walls, by pack
};

/// What a body has that has an impact in this step. Tiles that share it may note it at once.
struct BodyImpacts {
    double size = 0.0; ///< impulse of its largest impact, had it that alone [N s]; 0: it has none
    double mass = 0.0; ///< heaviest that it meets so [kg]
    double load = 0.0; ///< largest normal impulse that its contacts brought from the step before [N s]

    void note(double impulse, double other_mass)
    {
        raise(size, impulse);
        raise(mass, other_mass);
    }

    void note_load(double impulse) { raise(load, impulse); }

private:
    static void raise(double& number, double to)
    {
        std::atomic_ref shared(number);
        double now = shared.load(std::memory_order_relaxed);
        while (now < to && !shared.compare_exchange_weak(now, to, std::memory_order_relaxed)) {}
    }
};

/// The contacts of one step; scratch, made anew in every step.
struct StepContacts {
    std::vector<TileContacts> spheres; ///< by tile
    std::vector<TileContacts> walls;   ///< by tile; without those with pistons …
    TileContacts pistons;              ///< … which one thread takes after the tiles, one by one
    std::vector<Vec3> piston_arms;     ///< by contact: from the centre of the piston to where it is [m]
    std::vector<AssemblyRoom> rooms;   ///< by thread
    std::vector<SpherePlace> places;   ///< by sphere, for detection …
    std::vector<double> reaches;       ///< … with what it can touch in this step, from its centre [m]
    std::vector<BodyImpacts> impacts;  ///< by body
    std::vector<Vec3> free_velocity;   ///< by body: v⁽¹⁾, as if nothing touched; of the warm start [m/s]

    /// That of the thread that asks.
    AssemblyRoom& room();
    /// Makes room for the tiles of the list.
    void resize(const CandidateList& list, const ModelledPhysics& physics, std::size_t sphere_count);
    /// Forgets them, where spheres have been renumbered since.
    void clear();
};

/// How the bodies moved before a step that may have to be taken back; scratch, kept for its room.
struct MotionBefore {
    std::vector<Body> bodies;
    std::vector<PistonState> pistons;

    void take(const State& state)
    {
        bodies = state.bodies;
        pistons = state.pistons;
    }
    void put_back(State& state) const
    {
        state.bodies = bodies;
        state.pistons = pistons;
    }
};

/// Who may touch whom, who does, and with what impulse: all that a step needs beyond the spheres themselves.
///
///   kept from step to step                                     scratch of a step
///
///   list      update_candidates: listed boxes,
///     |       pairs by tile; the place of a pair is its slot
///     v
///   slots     λ, κ, touch        -- assemble_contacts -->  contacts  n, g, law, λ⁰: by tile, those that are near
///     ^                                                        |     their `slot` says where λ comes from
///     |                                                        |     warm start, sweeps: λ
///     +------------------ carry_impulses ----------------------+
///
/// Impulses stay in place as long as the pair is not searched for, and move with it then. Those of pairs of spheres
/// stand in their tiles, `carried` has those of walls.
struct ContactNetwork {
    CandidateList list;
    Carried carried;
    StepContacts contacts;
    MotionBefore before;

    /// What is kept.
    void persist(Archive& archive) { archive(list, carried); }
};

} // namespace talus
