// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/candidates/contact_network.hpp"
#include "core/solver/contact_kernel.hpp"

#include <type_traits>

namespace talus
{

/// Calls visit(contact, terms, rows, is_wall) for the contacts of one tile, spheres first.
template <class Visit> void for_each_contact(ContactNetwork& network, std::size_t tile, Visit&& visit)
{
    const auto visit_all = [&](ContactArrays& arrays, std::size_t first, auto is_wall) {
        RollingRow* rolling = arrays.rolling.empty() ? nullptr : arrays.rolling.data();
        const WallRow* wall = arrays.wall.empty() ? nullptr : arrays.wall.data();
        for (std::size_t k = first; k < first + arrays.count[tile]; ++k)
            visit(arrays.contact[k], arrays.terms[k],
                SideRows{rolling ? rolling + k : nullptr, wall ? wall + k : nullptr}, is_wall);
    };
    visit_all(network.sphere_contacts, network.pairs_of_tile[tile], std::false_type{});
    visit_all(network.wall_contacts, network.wall_slots_of_tile[tile], std::true_type{});
}

template <bool with_moving_walls, class Work> auto with_rows(const ModelledPhysics& physics, Work&& work)
{
    if (physics.rolling) return work(Rows<true, true, true, with_moving_walls>{});
    if (physics.spin) return work(Rows<true, true, false, with_moving_walls>{});
    if (physics.friction) return work(Rows<true, false, false, with_moving_walls>{});
    return work(Rows<false, false, false, with_moving_walls>{});
}

/// Calls work(Rows<…>{}) with what the scene needs.
template <class Work> auto with_rows(const ModelledPhysics& physics, Work&& work)
{
    return physics.moving_walls ? with_rows<true>(physics, work) : with_rows<false>(physics, work);
}

} // namespace talus
