// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/candidates/contact_network.hpp"

namespace talus
{

CarriedImpulses::CarriedImpulses(std::size_t slots, bool with_rolling)
    : impulse(slots, Vec3::Zero()), rolling_impulse(with_rolling ? slots : 0, Vec3::Zero()), touched(slots, 0)
{
}

void CarriedImpulses::clear(std::size_t slot)
{
    if (!touched[slot]) return; // nothing is carried without
    impulse[slot].setZero();
    if (!rolling_impulse.empty()) rolling_impulse[slot].setZero();
    touched[slot] = 0;
}

void CarriedImpulses::scale(double factor)
{
    for (Vec3& p : impulse) p *= factor;
    for (Vec3& p : rolling_impulse) p *= factor;
}

void CarriedImpulses::copy(std::size_t slot, const CarriedImpulses& from, std::size_t from_slot, bool opposite)
{
    const double sign = opposite ? -1.0 : 1.0;
    impulse[slot] = sign * from.impulse[from_slot];
    if (!rolling_impulse.empty()) rolling_impulse[slot] = sign * from.rolling_impulse[from_slot];
    touched[slot] = from.touched[from_slot];
}

void ContactArrays::resize(std::size_t slots, std::size_t tiles, bool with_rolling, bool with_moving_walls)
{
    contact.resize(slots);
    terms.resize(slots);
    rolling.resize(with_rolling ? slots : 0);
    wall.resize(with_moving_walls ? slots : 0);
    geometry.resize(slots);
    count.assign(tiles, 0);
}

void ContactNetwork::resize_contacts(const ModelledPhysics& physics)
{
    sphere_contacts.resize(pairs.size(), tiles.count(), physics.rolling, false);
    wall_contacts.resize(patches.size(), tiles.count(), physics.rolling, physics.moving_walls);
    const auto piston_slots = physics.pistons ? patches.size() : 0;
    piston_contacts.resize(piston_slots, 1, physics.rolling);
    piston_arms.resize(piston_slots);
}

void ContactNetwork::persist(Archive& archive)
{
    archive(listed_box, listed_pose, listed_around, tiles, pairs, pairs_of_tile, pair_of_sphere, first_pair, pair_count,
        pair_carried);
    archive(wall_pairs, wall_pairs_of_tile, first_wall_pair, wall_pair_count, wall_slots_of_tile, patches, wall_carried,
        wall_carried_normal, impulse_step);
}

} // namespace talus
