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

constexpr double very_heavy = 500.0; ///< a sphere, times the lightest: on eight of its diameters or more it may hop
constexpr double fine = 1e-3;
constexpr double packed_share = 0.6; ///< of the room that a bed takes

/// All volumes and masses that the scene makes.
struct Contents {
    double volume = 0.0;                        ///< of the spheres [m³]
    double lightest = infinity, heaviest = 0.0; ///< spheres [kg]
    double heaviest_body = 0.0;                 ///< or piston [kg]
    Box room;                                   ///< of fills and pours [m]
};

Contents contents_of(const Simulation& simulation)
{
    const auto& model = simulation.model;
    const State& state = simulation.state;
    Contents all;
    const auto add_mass = [&](double mass) {
        all.lightest = std::min(all.lightest, mass);
        all.heaviest = std::max(all.heaviest, mass);
    };
    const auto volume = [](double diameter) { return std::numbers::pi / 6.0 * std::pow(diameter, 3); };
    for (std::size_t i = 0; i < state.count(); ++i) {
        all.volume += volume(2.0 * state.radius[i]);
        all.room.extend(Box{state.position[i], state.position[i]}.grown(state.radius[i]));
        add_mass(state.mass(i));
    }
    for (const Pour& source : simulation.pours) {
        all.volume += expected_count(source, model.materials) * volume(source.mixture.mean_diameter());
        all.room.extend(source.region.bounds());
        for (const Species& species : source.mixture.species) {
            const double density = model.materials.list[static_cast<std::size_t>(species.material)].density;
            add_mass(density * volume(source.mixture.min_diameter()));
            add_mass(density * volume(source.mixture.max_diameter()));
        }
    }
    all.heaviest_body = all.heaviest;
    for (const Piston& piston : model.pistons) all.heaviest_body = std::max(all.heaviest_body, piston.mass);
    return all;
}

/// How deep the bed may become, in mean diameters: its volume, packed, over the room across gravity. 0 without gravity.
double depth_of(const Contents& all, const Model& model)
{
    if (model.gravity.isZero() || all.room.empty()) return 0.0;
    const Vec3 up = model.up().cwiseAbs();
    const Vec3 extent = all.room.extent();
    const double across = // the area of the box as seen from above
        up.x() * extent.y() * extent.z() + up.y() * extent.z() * extent.x() + up.z() * extent.x() * extent.y();
    return all.volume / packed_share / across / model.mean_diameter;
}

BedMeasures measures_of(const Simulation& simulation)
{
    const Contents all = contents_of(simulation);
    const double ratio = simulation.model.gravity.isZero() ? 1.0 : all.heaviest / all.lightest;
    return {depth_of(all, simulation.model), ratio, all.heaviest_body / all.lightest};
}

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
           std::ranges::all_of(model.materials.laws, [](const ContactLaw& law) { return law.stiffness == infinity; });
}

int usual_sweeps(Stabilisation stabilisation)
{
    return stabilisation == Stabilisation::matched ? 2 : 3;
}

/// The load of a sphere rests on some (D/d)² grains, so a grain bears D/d of its weight, and overlaps by that times h²:
/// with this factor by no more than below a sphere of 800 times its mass, 2 % d.
double step_under(double ratio)
{
    return std::min(1.0, std::pow(800.0 / ratio, 1.0 / 6.0));
}

template <class... Numbers> std::string text(const char* format, Numbers... numbers)
{
    char buffer[200];
    std::snprintf(buffer, sizeof buffer, format, numbers...);
    return buffer;
}

std::string explain(const SolverSettings& solver, double step_factor, const BedMeasures& bed)
{
    const std::string found = bed.mass_ratio >= very_heavy
                                  ? text("the heaviest sphere is %.3g times the lightest", bed.mass_ratio)
                                  : text("the spheres stand %.3g diameters high", bed.depth);
    const std::string step = step_factor < 1.0 ? text(", %.2g of the step", step_factor) : "";
    return text("stabilisation %s%s and tolerance %g, for %s",
        solver.stabilisation == Stabilisation::projected ? "projected" : "matched", step.c_str(), solver.tolerance,
        found.c_str());
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
    solver.min_sweeps = table.min_sweeps > 0     ? static_cast<int>(table.min_sweeps)
                        : setting.min_sweeps > 0 ? setting.min_sweeps
                                                 : usual_sweeps(solver.stabilisation);
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

SolverChoice complete_solver(SolverSettings solver, const scene::Scene& scene, const Simulation& simulation)
{
    const Model& model = simulation.model;
    const scene::SolverTable& table = scene.solver;
    const BedMeasures bed = measures_of(simulation);
    const bool scaled = pressure_is_scaled(table.pressure_scaling, bed, model);
    std::string explanation;
    double step_factor = 1.0;
    if (scene.accuracy.empty()) { // else measured settings decide
        if (table.stabilisation == "auto" && scaled && needs_rigid_contacts(bed) && may_be_rigid(simulation)) {
            solver.stabilisation = Stabilisation::projected;
            if (table.min_sweeps == 0)
                solver.min_sweeps = std::min(usual_sweeps(solver.stabilisation), solver.max_sweeps);
        }
        if (scene.time.step.name == "auto") step_factor = step_under(bed.mass_ratio);
        const bool gas = model.gravity.isZero() && model.physics.restitution;
        if (table.tolerance.name == "auto" && (bed.mass_ratio >= very_heavy || gas)) solver.tolerance = fine;
        if (needs_rigid_contacts(bed) || bed.mass_ratio >= very_heavy) explanation = explain(solver, step_factor, bed);
        if (gas)
            explanation =
                text("tolerance %g, for impacts without gravity, whose energy nothing stills", solver.tolerance);
    }
    solver.pressure_scaling = scaled && solver.stabilisation == Stabilisation::projected;
    if (solver.pressure_scaling && table.min_sweeps == 0)
        solver.min_sweeps = std::clamp(least_sweeps_after_scaling(bed), solver.min_sweeps, solver.max_sweeps);
    return {solver, step_factor, explanation};
}

} // namespace talus
