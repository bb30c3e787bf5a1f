// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/supply/escape.hpp"

#include "core/supply/removal.hpp"

#include <set>

namespace talus
{

void remove_escaped(std::vector<EscapedSphere>& escaped, State& state, ContactNetwork& contacts, const Model& model,
    const std::vector<Incident>& incidents)
{
    std::set<std::int64_t> ids;
    for (const Incident& incident : incidents)
        if (incident.kind == Incident::Kind::escaped) ids.insert(incident.id);
    if (ids.empty()) return;
    std::vector<std::uint8_t> gone(state.count(), 0);
    for (std::size_t i = 0; i < state.count(); ++i) {
        if (!ids.contains(state.id[i])) continue;
        gone[i] = 1;
        escaped.push_back({state.time, state.id[i], state.position[i], state.motion[i].velocity,
            state.angular_velocity(i), state.radius(i), state.material[i], state.last_wall[i]});
    }
    remove_spheres(state, contacts, model, gone);
}

} // namespace talus
