// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/support/world.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace talus::test
{

/// What a property asks of its worlds; nothing: both are drawn.
struct Wish {
    std::optional<bool> friction = {};
    std::optional<bool> push_out = {};
    bool moving_walls = true;
    bool pistons = true;
    bool press = false; ///< two walls close on the spheres
    bool attraction = false;
    bool elasticity = false; ///< of materials with moduli, `matched`
};

/// A small world that a seed stands for: a few spheres, some of which touch or are about to, with or without walls, and
/// a number of steps after which it becomes interesting. It prints itself.
struct RandomWorld {
    std::uint64_t seed = 0;
    World world;
    std::vector<int> parts;           ///< sub-steps of each step before the one that is looked at, and of that one
    std::vector<std::string> told;    ///< in words, a line each
    double warm_up_tolerance = 1e-12; ///< of the steps before

    bool is_frictionless() const { return !world.model.physics.friction; }
    /// Of the lightest and the heaviest body, pistons included.
    double mass_ratio() const;
    bool has_moving_walls() const; ///< that move as prescribed
};

RandomWorld draw_world(std::uint64_t seed, const Wish& wish = {});

/// One of `parts` sub-steps of a step; after the last of them the whole step has been made.
StepLength part_of_step(const Model& model, int parts);
StepReport make_part(World& world, int parts);
void end_step(World& world, int parts);

/// The steps before the one that is looked at. Returns whether there was room in all of them (room.hpp).
/// @param sweeps a fixed number of them; 0: until the tolerance
bool warm_up(RandomWorld& own, int sweeps = 0);

/// All speeds that the world can speak of: of bodies and walls, h g, and a small share of a diameter in a step [m/s].
double largest_velocity(const World& world);

/// The world as it is now, so that a person can see it: laws, walls, spheres in diameters, contacts.
std::string picture(const RandomWorld& own);
/// The contacts that the next step would have, with the law of each.
std::string contact_table(const World& world, int parts);

bool is_finite(const World& world);

} // namespace talus::test
