// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact_network.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

#include <cstdint>
#include <vector>

namespace talus
{

/// Something that must not go on unseen: a sphere, or a piston, that escaped, is not a number, or moves faster than it
/// can; bodies that are pressed together so that no motion obeys their contacts (TouchRecord); or a wall that appears
/// where spheres are, `appeared_inside`, which are pushed out on the sides on which their centres are.
struct Incident {
    enum class Kind { escaped, not_a_number, blow_up, pressed, appeared_inside };
    Kind kind = Kind::escaped;
    std::int64_t id = -1; ///< of the sphere; −1: it is a piston, that of the wall below
    Vec3 position = Vec3::Zero();
    double speed = 0.0;          ///< [m/s]
    std::int32_t last_wall = -1; ///< index of the wall that the sphere touched last, −1: none; of a piston, its own
    std::vector<std::int64_t> spheres = {}; ///< all that are pressed together, or that the wall cuts, by id …
    std::vector<std::int32_t> walls = {};   ///< … and by index the walls that press them, or the wall
    double overlap = 0.0;                   ///< of the contact that shows it [m]

    bool of_piston() const { return id < 0; }

    /// Whether the run may go on with it, whatever the scene asks for.
    bool is_harmless() const { return kind == Kind::appeared_inside; }
};

/// An incident for each group of bodies that contacts join together which overlap by a thousandth of the smallest
/// diameter, where a wall is that moves as prescribed, a contact came to be jammed in this step, and none was before.
/// Their contacts note that it is known.
std::vector<Incident> find_presses(ContactNetwork& network, const State& state, const Model& model);

/// An incident for each wall that has just appeared and overlaps spheres by more than 0.05 of the smallest diameter.
/// @pre what contacts carry is still that of the step before
std::vector<Incident> find_walls_inside(const ContactNetwork& network, const State& state, const Model& model);

/// Adds the incidents of the next sub-step to those of the ones before it: each is reported once, as it was first.
void add_incidents(std::vector<Incident>& all, std::vector<Incident> next);

} // namespace talus
