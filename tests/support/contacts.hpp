// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact_network.hpp"

namespace talus::test
{

/// Calls visit(arrays, k, with_wall) for the contacts of the last assembly in the order in which one thread sweeps
/// them: tile by tile, those between spheres first; then those with pistons.
template <class Visit> void for_each_contact(const ContactNetwork& network, Visit&& visit)
{
    const auto& [spheres, walls, pistons, arms] = network.contacts;
    for (std::size_t tile = 0; tile < spheres.tiles(); ++tile) {
        for (const std::size_t k : spheres.of_tile(tile)) visit(spheres, k, false);
        for (const std::size_t k : walls.of_tile(tile)) visit(walls, k, true);
    }
    for (std::size_t tile = 0; tile < pistons.tiles(); ++tile)
        for (const std::size_t k : pistons.of_tile(tile)) visit(pistons, k, true);
}

} // namespace talus::test
