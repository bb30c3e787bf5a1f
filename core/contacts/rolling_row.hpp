// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/tile_contacts.hpp"
#include "core/world/material.hpp"
#include "core/world/state.hpp"

#include <algorithm>

namespace talus
{

/// 1/I of a solid sphere [1/(kg m²)].
inline double inverse_inertia(const Motion& m)
{
    return inverse_inertia_factor * m.inverse_mass / (m.radius * m.radius);
}

/// The rolling row of a contact whose impulse is set, METHOD (8), with what it carries put back into its plane and
/// disk.
/// @param radius R* [m]; @param inverse_inertia 1/I_a + 1/I_b; @param carried rolling impulse of the step before [N m
/// s]
inline RollingRow rolling_row(const TileContacts& contacts, std::size_t k, const ContactLaw& law, double radius,
    double inverse_inertia, const Vec3& carried)
{
    RollingRow row{Vec3::Zero(), law.rolling_friction * radius, 1.0 / inverse_inertia};
    if (contacts.kind(k) == ContactKind::impact) return row;
    const Vec3 normal = contacts.normal(k);
    row.impulse = carried - carried.dot(normal) * normal;
    const double largest = row.reach * contacts.impulse(k).dot(normal);
    const double size = row.impulse.norm();
    if (size > largest) row.impulse *= largest / size;
    return row;
}

} // namespace talus
