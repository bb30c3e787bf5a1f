// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contacts/contact_network.hpp"

#include <omp.h>

namespace talus
{

void StepContacts::resize(const CandidateList& list, const ModelledPhysics& physics, std::size_t sphere_count)
{
    spheres.resize(list.tiles.count());
    walls.resize(list.tiles.count());
    for (TileContacts& tile : spheres) tile.clear({.rolling = physics.rolling, .attraction = physics.attraction}, true);
    TileContacts::Parts at_walls = {.rolling = physics.rolling, .attraction = physics.attraction, .walls = true};
    pistons.clear(at_walls);
    at_walls.moving_walls = physics.moving_walls;
    for (TileContacts& tile : walls) tile.clear(at_walls);
    piston_arms.clear();
    places.resize(sphere_count);
    reaches.resize(sphere_count);
    impacts.assign(sphere_count, {});
    rooms.resize(static_cast<std::size_t>(omp_get_max_threads()));
}

AssemblyRoom& StepContacts::room()
{
    return rooms[static_cast<std::size_t>(omp_get_thread_num())];
}

void StepContacts::clear()
{
    *this = {};
}

} // namespace talus
