// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/archive.hpp"
#include "core/world/model.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace talus
{

struct Simulation;

/// What a program did to a simulation between its steps, which no scene prescribes: it is part of every checkpoint, and
/// a summary says that there was something.
class Interventions
{
public:
    bool any = false;           ///< of any kind, spheres put in and own forces included
    std::int64_t taken_out = 0; ///< spheres

    /// From now on a wall that is no piston moves at this velocity [m/s], and no more as its scene says.
    void drive(Model& model, std::size_t wall, const Vec3& velocity, double time);

    /// From now on this load acts on a piston, along its guide [N].
    void load(Model& model, std::size_t piston, double force);

    /// Stores them, or puts the model into the state that it had with those that were stored.
    void persist(Archive& archive, Model& model);

private:
    /// A wall that was driven: what the scene says of it until `from`, then these.
    struct Drive {
        std::size_t wall = 0;
        double from = 0.0;             ///< [s]
        std::vector<Translation> ways; ///< one after the other, at most three
        WallMotion prescribed;         ///< by the scene

        void apply(Model& model) const;
        void persist(Archive& archive);
    };
    struct Load {
        std::size_t piston = 0;
        double force = 0.0; ///< [N]
        std::vector<LoadPoint> prescribed;

        void apply(Model& model) const;
        void persist(Archive& archive) { archive(piston, force); }
    };
    std::vector<Drive> drives_;
    std::vector<Load> loads_;
};

// What may be done from outside between two steps.

/// As Interventions::drive.
void drive_wall(Simulation& simulation, std::size_t wall, const Vec3& velocity);

/// As Interventions::load.
void load_piston(Simulation& simulation, std::size_t piston, double force);

/// From now on this force acts on a sphere besides gravity and contacts [N]. @param sphere by storage index
void set_own_force(Simulation& simulation, std::size_t sphere, const Vec3& force);

/// Puts a sphere in and returns its storage index, the last.
/// @pre its diameter is not outside those of the model
std::size_t put_in(Simulation& simulation, const Vec3& position, double diameter, int material, const Vec3& velocity);

/// Takes the spheres out for which `gone` is not 0, by storage index; the contacts of the last step are forgotten.
void take_out(Simulation& simulation, const std::vector<std::uint8_t>& gone);

} // namespace talus
