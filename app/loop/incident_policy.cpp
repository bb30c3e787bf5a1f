// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/loop/incident_policy.hpp"

#include <algorithm>

namespace talus
{

bool IncidentPolicy::stops(const StepReport& report) const
{
    return std::ranges::any_of(report.bodies.incidents, [&](const Incident& incident) {
        const bool may_be_removed = incident.kind == Incident::Kind::escaped && !incident.of_piston();
        return !(may_be_removed && remove_escaped_) && !(incident.kind == Incident::Kind::pressed && go_on_pressed_);
    });
}

void take_out_escaped(Simulation& simulation, const StepReport& report)
{
    if (report.bodies.incidents.empty()) return;
    remove_escaped(simulation.escaped, simulation.state, simulation.network, simulation.model, report.bodies.incidents);
}

} // namespace talus
