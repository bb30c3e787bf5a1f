// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contacts/wall_load.hpp"

namespace talus
{
namespace
{

void add_loads(std::vector<WallLoad>& loads, const ContactArrays& contacts, std::size_t first, std::size_t count,
    const State& state)
{
    for (auto k = first; k < first + count; ++k) {
        const Contact& c = contacts.contact[k];
        const Vec3 point = state.position[c.a] - state.radius(c.a) * c.normal;
        loads[c.b].impulse -= c.impulse;
        loads[c.b].torque -= point.cross(c.impulse);
        if (!contacts.rolling.empty()) loads[c.b].torque -= contacts.rolling[k].impulse;
    }
}

} // namespace

std::vector<WallLoad> wall_loads(const ContactNetwork& network, const State& state, std::size_t walls)
{
    std::vector<WallLoad> loads(walls);
    const auto& contacts = network.wall_contacts;
    for (std::size_t tile = 0; tile < network.tiles.count(); ++tile)
        add_loads(loads, contacts, network.wall_slots_of_tile[tile], contacts.count[tile], state);
    for (const auto count : network.piston_contacts.count) add_loads(loads, network.piston_contacts, 0, count, state);
    return loads;
}

} // namespace talus
