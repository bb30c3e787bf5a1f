// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/supply/removal.hpp"

#include "core/candidates/candidate_search.hpp"

namespace talus
{

void remove_spheres(State& state, ContactNetwork& contacts, const Model& model, const std::vector<std::uint8_t>& gone)
{
    std::vector<std::int32_t> new_index(state.count(), -1);
    std::int32_t kept = 0;
    for (std::size_t i = 0; i < state.count(); ++i)
        if (!gone[i]) new_index[i] = kept++;
    if (static_cast<std::size_t>(kept) == state.count()) return;
    renumber_spheres(state, new_index, static_cast<std::size_t>(kept));
    renumber_candidates(contacts, state, model, new_index);
}

} // namespace talus
