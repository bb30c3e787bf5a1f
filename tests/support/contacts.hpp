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

/// Puts a contact of solid spheres that turn, or of one and a wall, into its packs.
inline void set_contact(TileContacts& contacts, std::size_t k, const Contact& contact)
{
    ContactPack& pack = contacts.pack(k / pack_size);
    RecordPack& record = contacts.record(k / pack_size);
    const std::size_t lane = k % pack_size;
    const double w = contact.inverse_mass_sum;
    contacts.place(k, contact.a, contact.b, contact.slot);
    contacts.set_impulse(k, contact.impulse);
    contacts.set_touch(k, contact.touch);
    for (int d = 0; d < 3; ++d) pack.normal[d][lane] = contact.normal[d];
    pack.target[lane] = contact.target;
    pack.arm_scale[lane] = contact.arm_scale;
    pack.friction[lane] = contact.friction;
    pack.parting[lane] = contact.parting;
    pack.normal_mass[lane] = 1.0 / (w + contact.compliance);
    pack.tangent_mass[lane] = 1.0 / (w * (1.0 + inverse_inertia_factor * contact.arm_scale * contact.arm_scale));
    record.gap[lane] = contact.gap;
    record.inverse_mass_sum[lane] = w;
    record.compliance[lane] = contact.compliance;
    record.compression[lane] = static_cast<float>(contact.compression);
    record.kind[lane] = contact.kind;
    record.in_problem |= static_cast<std::uint8_t>(1U << lane);
}

} // namespace talus::test
