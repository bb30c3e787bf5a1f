// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contacts/contact_network.hpp"

namespace talus
{

void ContactArrays::resize(const std::vector<std::uint32_t>& first_slot, bool with_rolling, bool with_moving_walls)
{
    const std::size_t slots = first_slot.back();
    contact.resize(slots);
    terms.resize(slots);
    rolling.resize(with_rolling ? slots : 0);
    wall.resize(with_moving_walls ? slots : 0);
    geometry.resize(slots);
    first = first_slot;
    count.assign(first_slot.size() - 1, 0);
}

void StepContacts::resize(const CandidateList& list, const ModelledPhysics& physics)
{
    const auto wall_slots = static_cast<std::uint32_t>(list.patches.size());
    spheres.resize(list.pairs_of_tile, physics.rolling);
    walls.resize(list.wall_slots_of_tile, physics.rolling, physics.moving_walls);
    pistons.resize({0, physics.pistons ? wall_slots : 0}, physics.rolling);
    piston_arms.resize(pistons.contact.size());
}

void StepContacts::clear()
{
    for (ContactArrays* arrays : {&spheres, &walls, &pistons}) arrays->count.assign(arrays->count.size(), 0);
}

} // namespace talus
