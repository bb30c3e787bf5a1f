// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/loop/energy_balance.hpp"

#include <algorithm>

namespace talus
{

void EnergyBalance::add(const StepReport& report, bool same_spheres)
{
    if (!same_spheres) motion_energy_ = total_energy_ = std::nullopt;

    // a report has the contact energy at the beginning of its step, which is the end of the step before
    std::optional<double> total;
    if (motion_energy_) total = *motion_energy_ + report.contacts.stored_energy;
    if (total && total_energy_) {
        const double rise = *total - *total_energy_ - work_;
        lost_ += std::max(0.0, -rise);
        gained_ += std::max(0.0, rise);
    }
    total_energy_ = total;
    work_ = report.outcome.wall_work + report.bodies.load_work + report.bodies.gravity_work;
    put_in_ += work_;
    motion_energy_ = report.bodies.kinetic_energy + report.bodies.potential_energy;
}

} // namespace talus
