// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/candidates/contact_network.hpp"

#include <cstdint>
#include <vector>

namespace talus
{

/// Calls use(contact, geometry) for each of these contacts of the last step that has an impulse, tile by tile.
/// @param first_of_tile where the contacts of each tile begin
template <class Use>
void for_each_loaded(const ContactArrays& contacts, const std::vector<std::uint32_t>& first_of_tile, Use&& use)
{
    for (std::size_t tile = 0; tile < contacts.count.size(); ++tile)
        for (std::size_t k = first_of_tile[tile]; k < first_of_tile[tile] + contacts.count[tile]; ++k)
            if (!contacts.contact[k].impulse.isZero(0.0)) use(contacts.contact[k], contacts.geometry[k]);
}

/// The loaded contacts between spheres. Those who need the branch from b to a take (r_a + r_b + gap) n, which is right
/// wherever the two centres are kept; the difference of the positions is not where space is periodic.
template <class Use> void for_each_loaded_sphere_contact(const ContactNetwork& network, Use&& use)
{
    for_each_loaded(network.sphere_contacts, network.pairs_of_tile, use);
}

/// The loaded contacts between a sphere and a wall, pistons last; the wall is touched at (r_a + gap) n from the centre.
template <class Use> void for_each_loaded_wall_contact(const ContactNetwork& network, Use&& use)
{
    for_each_loaded(network.wall_contacts, network.wall_slots_of_tile, use);
    for_each_loaded(network.piston_contacts, {0}, use);
}

} // namespace talus
