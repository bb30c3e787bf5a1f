// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/builder/solver.hpp"

#include "core/deep_beds/choice.hpp"
#include "scenarios/scene_error.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace talus
{
namespace
{

constexpr double usual_mass_ratio = 5.0; ///< of the heaviest sphere to the lightest: beyond it the tolerance falls
constexpr double fine = 1e-3;

bool pressure_is_scaled(const scene::SwitchOrName& asked, const BedMeasures& bed, const Model& model)
{
    if (asked.name == "auto") return needs_scaled_pressures(bed, model);
    if (asked.on && !may_scale_pressures(model))
        throw SceneError("solver.pressure_scaling",
            "pressure scaling is not for periodic axes, where beads may be shot out of a bed by the pressure on its "
            "own images; leave it out, or write false");
    return asked.on;
}

/// Whether contacts may be rigid, and it pays: nothing moves as prescribed, or flows.
bool may_be_rigid(const Simulation& simulation)
{
    const Model& model = simulation.model;
    return simulation.pours.empty() && model.outlets.empty() && !model.physics.moving_walls &&
           std::ranges::all_of(model.materials.laws,
               [](const ContactLaw& law) { return std::min(law.stiffness, law.modulus) == infinity; });
}

int usual_sweeps(Stabilisation stabilisation)
{
    return stabilisation == Stabilisation::matched ? 2 : 3;
}

template <class... Numbers> std::string text(const char* format, Numbers... numbers)
{
    char buffer[200];
    std::snprintf(buffer, sizeof buffer, format, numbers...);
    return buffer;
}

std::string explain(const SolverSettings& solver, const BedMeasures& bed)
{
    std::string found;
    if (bed.mass_ratio > usual_mass_ratio)
        found = text("the heaviest sphere is %.3g times the lightest", bed.mass_ratio);
    if (needs_rigid_contacts({.depth = bed.depth}))
        found += text("%sthe spheres stand %.3g diameters high", found.empty() ? "" : ", and ", bed.depth);
    return text("stabilisation %s and tolerance %g, for %s",
        solver.stabilisation == Stabilisation::projected ? "projected" : "matched", solver.tolerance, found.c_str());
}

double tolerance(const scene::NumberOrName& value, double automatic)
{
    if (value.name == "auto") return automatic;
    if (value.name == "draft") return 5e-2;
    if (value.name == "standard") return 1e-2;
    if (value.name == "fine") return fine;
    if (value.name == "reference") return 1e-4;
    return value.number;
}

/// What a tolerance on impulses leaves undone of what a light sphere bears, is as much more of the sphere's own
/// momentum as what it bears is heavier.
double tolerance_under(double mass_ratio, double usual)
{
    return std::clamp(usual * usual_mass_ratio / mass_ratio, std::min(fine, usual), usual);
}

} // namespace

double push_out_speed(const scene::SolverTable& table, const Model& model)
{
    return table.push_out_speed.name == "auto" ? usual_push_out_speed(model) : table.push_out_speed.number;
}

Stabilisation stabilisation_of(const scene::SolverTable& table)
{
    return table.stabilisation == "projected" ? Stabilisation::projected : Stabilisation::matched;
}

SolverSettings build_solver(const scene::SolverTable& table, const RunSetting& setting)
{
    SolverSettings solver;
    solver.stabilisation = stabilisation_of(table);
    solver.min_sweeps = table.min_sweeps > 0 ? static_cast<int>(table.min_sweeps) : usual_sweeps(solver.stabilisation);
    solver.max_sweeps = static_cast<int>(table.max_sweeps);
    if (solver.max_sweeps < solver.min_sweeps)
        throw SceneError("solver.max_sweeps",
            "'max_sweeps' must be at least the " + std::to_string(solver.min_sweeps) + " of 'min_sweeps'");
    solver.tolerance = tolerance(table.tolerance, setting.tolerance);
    solver.relaxation = table.relaxation;
    const auto& scaling = table.pressure_scaling;
    if (scaling.name != "auto" && scaling.on && solver.stabilisation == Stabilisation::matched)
        throw SceneError("solver.pressure_scaling",
            "pressure scaling goes with stabilisation \"projected\" only; with \"matched\" contacts are too soft "
            "for it to matter");
    return solver;
}

SolverChoice complete_solver(
    SolverSettings solver, const scene::Scene& scene, const Simulation& simulation, const BedMeasures& bed)
{
    const Model& model = simulation.model;
    const scene::SolverTable& table = scene.solver;
    const bool scaled = pressure_is_scaled(table.pressure_scaling, bed, model);
    std::string explanation;
    if (table.tolerance.name == "auto") solver.tolerance = tolerance_under(bed.mass_ratio, solver.tolerance);
    if (scene.accuracy.empty()) { // else measured settings decide
        if (table.stabilisation == "auto" && scaled && needs_rigid_contacts(bed) && may_be_rigid(simulation)) {
            solver.stabilisation = Stabilisation::projected;
            if (table.min_sweeps == 0)
                solver.min_sweeps = std::min(usual_sweeps(solver.stabilisation), solver.max_sweeps);
        }
        const bool gas = model.gravity.isZero() && model.physics.restitution;
        if (table.tolerance.name == "auto" && gas) solver.tolerance = fine;
        if (needs_rigid_contacts(bed) || bed.mass_ratio > usual_mass_ratio) explanation = explain(solver, bed);
        if (gas)
            explanation =
                text("tolerance %g, for impacts without gravity, whose energy nothing stills", solver.tolerance);
    }
    solver.pressure_scaling = scaled && solver.stabilisation == Stabilisation::projected;
    if (solver.pressure_scaling && table.min_sweeps == 0)
        solver.min_sweeps = std::clamp(least_sweeps_after_scaling(bed), solver.min_sweeps, solver.max_sweeps);
    return {solver, explanation};
}

} // namespace talus
