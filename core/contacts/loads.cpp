// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contacts/loads.hpp"

namespace talus
{

std::vector<SphereLoad> sphere_loads(const ContactNetwork& network, std::size_t spheres)
{
    std::vector<SphereLoad> loads(spheres);
    const auto add = [&](std::int32_t sphere, const Vec3& impulse) {
        loads[sphere].impulse += impulse;
        ++loads[sphere].contacts;
    };
    for_each_loaded_sphere_contact(network, [&](const Contact& c) {
        add(c.a, c.impulse);
        add(c.b, -c.impulse);
    });
    for_each_loaded_wall_contact(network, [&](const Contact& c) { add(c.a, c.impulse); });
    return loads;
}

WallLoad& WallLoad::operator+=(const WallLoad& other)
{
    impulse += other.impulse;
    torque += other.torque;
    return *this;
}

std::vector<WallLoad> wall_loads(const ContactNetwork& network, const State& state, std::size_t walls)
{
    std::vector<WallLoad> loads(walls);
    const auto add = [&](const TileContacts& contacts) {
        for (const std::size_t k : contacts.indices()) {
            const Contact c = contacts.contact(k);
            const Vec3 point = state.position[c.a] - state.radius[c.a] * c.normal;
            loads[c.b].impulse -= c.whole_impulse();
            loads[c.b].torque -= point.cross(c.whole_impulse());
            if (contacts.has_rolling()) loads[c.b].torque -= contacts.rolling_impulse(k);
        }
    };
    for (const TileContacts& tile : network.contacts.walls) add(tile);
    add(network.contacts.pistons);
    return loads;
}

} // namespace talus
