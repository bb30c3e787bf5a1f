// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contacts/sphere_load.hpp"

#include "core/contacts/loaded_contacts.hpp"

namespace talus
{

std::vector<SphereLoad> sphere_loads(const ContactNetwork& network, std::size_t spheres)
{
    std::vector<SphereLoad> loads(spheres);
    const auto add = [&](std::int32_t sphere, const Vec3& impulse) {
        loads[sphere].impulse += impulse;
        ++loads[sphere].contacts;
    };
    for_each_loaded_sphere_contact(network, [&](const Contact& c, const ContactGeometry&) {
        add(c.a, c.impulse);
        add(c.b, -c.impulse);
    });
    for_each_loaded_wall_contact(network, [&](const Contact& c, const ContactGeometry&) { add(c.a, c.impulse); });
    return loads;
}

} // namespace talus
