// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/build/solver.hpp"

#include "scenarios/scene_error.hpp"

#include <cmath>

namespace talus
{
namespace
{

double tolerance(const scene::NumberOrName& value, double automatic)
{
    if (value.name == "auto") return automatic;
    if (value.name == "draft") return 5e-2;
    if (value.name == "standard") return 1e-2;
    if (value.name == "fine") return 1e-3;
    if (value.name == "reference") return 1e-4;
    return value.number;
}

} // namespace

Stabilisation stabilisation_of(const scene::SolverTable& table)
{
    return table.stabilisation == "matched" ? Stabilisation::matched : Stabilisation::projected;
}

SolverSettings build_solver(const scene::Scene& scene, const RunSetting& setting)
{
    const auto& table = scene.solver;
    SolverSettings solver;
    solver.stabilisation = stabilisation_of(table);
    const int usual_sweeps = solver.stabilisation == Stabilisation::matched ? 2 : 3;
    solver.min_sweeps = table.min_sweeps > 0     ? static_cast<int>(table.min_sweeps)
                        : setting.min_sweeps > 0 ? setting.min_sweeps
                                                 : usual_sweeps;
    solver.max_sweeps = static_cast<int>(table.max_sweeps);
    if (solver.max_sweeps < solver.min_sweeps)
        throw SceneError("solver.max_sweeps",
            "'max_sweeps' must be at least the " + std::to_string(solver.min_sweeps) + " of 'min_sweeps'");
    solver.tolerance = tolerance(table.tolerance, setting.tolerance);
    solver.relaxation = table.relaxation;
    return solver;
}

double push_out_speed(const scene::Scene& scene, const Model& model)
{
    const auto& given = scene.solver.push_out_speed;
    if (given.name != "auto") return given.number;
    const double gravity = model.gravity.norm();
    // Without gravity what it is with gravity at the automatic step h = 0.008 √(d/gravity).
    return gravity > 0.0 ? 0.1 * std::sqrt(model.mean_diameter * gravity)
                         : 0.0008 * model.mean_diameter / model.time_step;
}

} // namespace talus
