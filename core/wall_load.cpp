// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/wall_load.hpp"

namespace talus
{

std::vector<WallLoad> wall_loads(const ContactNetwork& network, const State& state, std::size_t walls)
{
    std::vector<WallLoad> loads(walls);
    const auto& contacts = network.wall_contacts;
    for (std::size_t tile = 0; tile < network.tiles.count(); ++tile) {
        const auto first = network.wall_slots_of_tile[tile];
        for (auto k = first; k < first + contacts.count[tile]; ++k) {
            const Contact& c = contacts.contact[k];
            const Vec3 point = state.position[c.a] - state.radius(c.a) * c.normal;
            loads[c.b].impulse -= c.impulse;
            loads[c.b].torque -= point.cross(c.impulse);
            if (!contacts.rolling.empty()) loads[c.b].torque -= contacts.rolling[k].impulse;
        }
    }
    return loads;
}

} // namespace talus
