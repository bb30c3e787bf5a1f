// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/step/hold_at_walls.hpp"

namespace talus
{
namespace
{

constexpr double deepest_in_wall = 0.25; ///< smallest diameters

} // namespace

double hold_at_walls(
    const ContactNetwork& network, State& state, const Model& model, const std::vector<PlacedWall>& walls)
{
    double lifted = 0.0;
    const double deepest = deepest_in_wall * model.min_diameter;
    const auto hold = [&](const Contact& c, double wall_level) {
        const double overlap = wall_level - c.normal.dot(state.position[c.a]);
        if (overlap <= deepest) return;
        const Vec3 shift = (overlap - deepest) * c.normal;
        state.position[c.a] += shift;
        lifted -= state.mass(c.a) * model.gravity.dot(shift);
    };
    for (const TileContacts& at_walls : network.contacts.walls)
        for (const std::size_t k : at_walls.indices()) hold(at_walls.contact(k), at_walls.wall_level(k));
    const TileContacts& pistons = network.contacts.pistons;
    for (const std::size_t k : pistons.indices()) {
        const Contact c = pistons.contact(k);
        hold(c, c.wall_level + c.normal.dot(way_of(walls[c.b], model, state)));
    }
    return lifted;
}

} // namespace talus
