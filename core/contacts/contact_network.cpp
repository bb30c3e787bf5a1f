// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contacts/contact_network.hpp"

#include <omp.h>

namespace talus
{

void StepContacts::resize(const CandidateList& list, const ModelledPhysics& physics)
{
    spheres.resize(list.tiles.count());
    walls.resize(list.tiles.count());
    for (TileContacts& tile : spheres) tile.clear(physics.rolling, false);
    for (TileContacts& tile : walls) tile.clear(physics.rolling, physics.moving_walls);
    pistons.clear(physics.rolling, false);
    piston_arms.clear();
    fillers.resize(static_cast<std::size_t>(omp_get_max_threads()));
}

void StepContacts::clear()
{
    *this = {};
}

} // namespace talus
