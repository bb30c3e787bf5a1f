// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/supply/removal.hpp"

#include <set>

namespace talus
{

void remove_spheres(State& state, ContactNetwork& network, const std::vector<std::uint8_t>& gone)
{
    std::vector<std::int32_t> new_index(state.count(), -1);
    std::int32_t kept = 0;
    for (std::size_t i = 0; i < state.count(); ++i)
        if (!gone[i]) new_index[i] = kept++;
    if (static_cast<std::size_t>(kept) == state.count()) return;
    renumber_spheres(state, new_index, static_cast<std::size_t>(kept));
    remove_candidates(network.list, network.carried, new_index);
    network.contacts.clear();
}

void empty_outlets(Outflow& outflow, State& state, ContactNetwork& network)
{
    for (std::size_t i = 0; i < state.count(); ++i) {
        if (!state.leaving[i]) continue;
        ++outflow.count;
        outflow.mass += state.mass(i);
    }
    remove_spheres(state, network, state.leaving);
}

void remove_escaped(
    std::vector<EscapedSphere>& escaped, State& state, ContactNetwork& network, const std::vector<Incident>& incidents)
{
    std::set<std::int64_t> ids;
    for (const Incident& incident : incidents)
        if (incident.kind == Incident::Kind::escaped) ids.insert(incident.id);
    if (ids.empty()) return;
    std::vector<std::uint8_t> gone(state.count(), 0);
    for (std::size_t i = 0; i < state.count(); ++i) {
        if (!ids.contains(state.id[i])) continue;
        gone[i] = 1;
        escaped.push_back({state.time, state.id[i], state.position[i], state.body(i).velocity,
            state.angular_velocity(i), state.radius[i], state.material[i], state.last_wall[i]});
    }
    remove_spheres(state, network, gone);
}

} // namespace talus
