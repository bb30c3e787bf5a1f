// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/build/scaling_choice.hpp"

#include "scenarios/scene_error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus
{
namespace
{

constexpr double deep = 40.0;       ///< mean diameters; in shallower beds at rest sweeps alone do nearly as well
constexpr double very_deep = 100.0; ///< mean diameters; there three sweeps do not clean up after it (hard case 33)
constexpr int sweeps_in_very_deep = 6;
constexpr double heavy = 10.0;       ///< times the lightest sphere
constexpr double packed_share = 0.6; ///< of the room that a bed takes

/// All volumes and masses that the scene makes.
struct Contents {
    double volume = 0.0;                        ///< of the spheres [m³]
    double lightest = infinity, heaviest = 0.0; ///< bodies [kg]
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
        all.volume += volume(2.0 * state.radius(i));
        all.room.extend(Box{state.position[i], state.position[i]}.grown(state.radius(i)));
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
    for (const Piston& piston : model.pistons) all.heaviest = std::max(all.heaviest, piston.mass);
    return all;
}

/// How deep the bed may become, in mean diameters: its volume, packed, over the room across gravity. 0 without gravity.
double depth_of(const Contents& all, const Model& model)
{
    if (model.gravity.isZero() || all.room.empty()) return 0.0;
    const Vec3 up = model.up().cwiseAbs();
    const Vec3 extent = all.room.extent();
    // The box's shadow along gravity.
    const double across =
        up.x() * extent.y() * extent.z() + up.y() * extent.z() * extent.x() + up.z() * extent.x() * extent.y();
    return all.volume / packed_share / across / model.mean_diameter;
}

} // namespace

void choose_pressure_scaling(const scene::Scene& scene, Simulation& simulation)
{
    SolverSettings& solver = simulation.model.solver;
    const auto& asked = scene.solver.pressure_scaling;
    const bool rigid = solver.stabilisation == Stabilisation::projected, open = asked.name == "auto";
    if (!open && asked.on && !rigid)
        throw SceneError("solver.pressure_scaling",
            "pressure scaling goes with stabilisation \"projected\" only; with \"matched\" contacts are too soft "
            "for it to matter");
    if (!rigid) return;
    const Contents all = contents_of(simulation);
    const double depth = depth_of(all, simulation.model);
    // A bed presses against its own images: that balances whatever its size, so nothing seems to keep the pressure from
    // growing. A flow down a periodic slope overlapped five times as much (hard case 35).
    const bool useful = !simulation.model.periodicity.any() && (depth >= deep || all.heaviest >= heavy * all.lightest);
    solver.pressure_scaling = open ? useful : asked.on;
    if (solver.pressure_scaling && depth >= very_deep && scene.solver.min_sweeps == 0)
        solver.min_sweeps = std::clamp(sweeps_in_very_deep, solver.min_sweeps, solver.max_sweeps);
}

} // namespace talus
