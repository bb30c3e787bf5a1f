// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/candidates/contact_network.hpp"

namespace talus::test
{

/// Calls visit(arrays, k, with_wall) for the contacts of the last assembly in the order in which one thread sweeps
/// them: tile by tile, those between spheres first; then those with pistons.
template <class Visit> void for_each_contact(const ContactNetwork& network, Visit&& visit)
{
    const auto visit_some = [&](const ContactArrays& arrays, std::size_t first, std::size_t tile, bool with_wall) {
        for (std::size_t k = first; k < first + arrays.count[tile]; ++k) visit(arrays, k, with_wall);
    };
    for (std::size_t tile = 0; tile < network.tiles.count(); ++tile) {
        visit_some(network.sphere_contacts, network.pairs_of_tile[tile], tile, false);
        visit_some(network.wall_contacts, network.wall_slots_of_tile[tile], tile, true);
    }
    if (!network.piston_contacts.count.empty()) visit_some(network.piston_contacts, 0, 0, true);
}

} // namespace talus::test
