// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/scaling_choice.hpp"

#include "scenarios/scene_error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus
{
namespace
{

constexpr double deep = 10.0;        ///< mean diameters; in shallower beds sweeps alone do as well
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

bool choose_pressure_scaling(const scene::Scene& scene, const Simulation& simulation)
{
    const bool rigid = simulation.model.solver.stabilisation == Stabilisation::projected;
    const auto& asked = scene.solver.pressure_scaling;
    if (asked.name != "auto") {
        if (asked.on && !rigid)
            throw SceneError("solver.pressure_scaling",
                "pressure scaling goes with stabilisation \"projected\" only; with \"matched\" contacts are too soft "
                "for it to matter");
        return asked.on;
    }
    // A bed presses against its own images: that balances whatever its size, so nothing seems to keep the pressure from
    // growing. A flow down a periodic slope overlapped five times as much (hard case 35).
    if (!rigid || simulation.model.periodicity.any()) return false;
    const Contents all = contents_of(simulation);
    return depth_of(all, simulation.model) >= deep || all.heaviest >= heavy * all.lightest;
}

} // namespace talus
