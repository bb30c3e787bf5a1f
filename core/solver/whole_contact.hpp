// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/tile_contacts.hpp"
#include "core/packs/packed_sweep.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

namespace talus
{

/// One contact with all its rows, for what is not a sweep: that of the kernels, to the bit.
template <bool wall, class R> using WholeContact = packs::Contacts<1, wall, R, true>;

template <bool wall, class R> WholeContact<wall, R> whole_contact(const PackSpan& packs, std::size_t k, Body* bodies)
{
    return {packs, k / pack_size, reinterpret_cast<double*>(bodies), static_cast<int>(k % pack_size)};
}

inline Vec3 as_vector(const packs::Vector<1>& vector)
{
    return {vector.x[0], vector.y[0], vector.z[0]};
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
