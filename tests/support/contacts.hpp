// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact_network.hpp"

namespace talus::test
{

/// Calls visit(contacts, k, with_wall) for the contacts of the last assembly in the order in which one thread sweeps
/// them: tile by tile, those between spheres first; then those with pistons.
template <class Visit> void for_each_contact(const ContactNetwork& network, Visit&& visit)
{
    const auto visit_all = [&](const TileContacts& contacts, bool with_wall) {
        for (const std::size_t k : contacts.indices()) visit(contacts, k, with_wall);
    };
    for (std::size_t tile = 0; tile < network.contacts.spheres.size(); ++tile) {
        visit_all(network.contacts.spheres[tile], false);
        visit_all(network.contacts.walls[tile], true);
    }
    visit_all(network.contacts.pistons, true);
}

} // namespace talus::test
