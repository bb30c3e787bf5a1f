// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact_network.hpp"
#include "core/world/state.hpp"

#include <cstdint>
#include <vector>

namespace talus
{

/// Calls use(contact) for each of these contacts of the last step that has an impulse: with the whole one, attraction
/// and all.
template <class Use> void for_each_loaded(const TileContacts& contacts, Use&& use)
{
    for (const std::size_t k : contacts.indices())
        if (!contacts.impulse(k).isZero(0.0) || contacts.attracts(k)) {
            Contact whole = contacts.contact(k);
            whole.impulse = whole.whole_impulse();
            use(whole);
        }
}

/// The loaded contacts between spheres. Those who need the branch from b to a take (r_a + r_b + gap) n, which is right
/// wherever the two centres are kept; the difference of the positions is not where space is periodic.
template <class Use> void for_each_loaded_sphere_contact(const ContactNetwork& network, Use&& use)
{
    for (const TileContacts& tile : network.contacts.spheres) for_each_loaded(tile, use);
}

/// The loaded contacts between a sphere and a wall, pistons last; the wall is touched at (r_a + gap) n from the centre.
template <class Use> void for_each_loaded_wall_contact(const ContactNetwork& network, Use&& use)
{
    for (const TileContacts& tile : network.contacts.walls) for_each_loaded(tile, use);
    for_each_loaded(network.contacts.pistons, use);
}

/// What its contacts did to a sphere in a step, those with walls included.
struct SphereLoad {
    Vec3 impulse = Vec3::Zero(); ///< sum of the contact impulses [N s]
    std::int32_t contacts = 0;   ///< those with one, or that attract: the sphere's coordination number
};

/// The load on each of `spheres` spheres by storage index, from the solved contacts.
std::vector<SphereLoad> sphere_loads(const ContactNetwork& network, std::size_t spheres);

/// What spheres did to a wall in a step, or walls to the spheres.
struct WallLoad {
    Vec3 impulse = Vec3::Zero(); ///< [N s]
    Vec3 torque = Vec3::Zero();  ///< angular impulse about the origin, rolling resistance included [N m s]

    WallLoad& operator+=(const WallLoad& other);
};

/// The load on each of `walls` walls, from the solved contacts. An impulse acts at x − r n, where the sphere meets the
/// wall's own velocity too, so that torque times rate of turning is the power that a wall puts in.
/// @pre the spheres have not been moved since detection
std::vector<WallLoad> wall_loads(const ContactNetwork& network, const State& state, std::size_t walls);

} // namespace talus
