// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/law/law_of_step.hpp"

#include "core/world/model.hpp"
#include "core/world/step_length.hpp"

namespace talus
{

LawOfStep law_of_step(const Model& model, const StepLength& step)
{
    const double by_rounding = touching_gap * model.min_diameter / step.whole;
    const double slowest = model.solver.restitution_threshold * model.gravity.norm() * step.whole;
    return {.h = step.h(),
        .threshold_speed = slowest + by_rounding,
        .elastic_speed = slowest > 0.0 ? slowest : 12.0 * upsilon * model.solver.push_out_speed,
        .rigid = model.solver.stabilisation == Stabilisation::projected,
        .min_sweeps = static_cast<double>(model.solver.min_sweeps),
        .push_out_speed = model.solver.push_out_speed,
        .parts = static_cast<double>(step.parts),
        .min_diameter = model.min_diameter,
        .elastic = model.physics.elasticity};
}

} // namespace talus
