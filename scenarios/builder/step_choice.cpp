// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/builder/step_choice.hpp"

#include "core/law/attraction.hpp"
#include "core/law/hertz.hpp"
#include "scenarios/builder/closing_speed.hpp"
#include "scenarios/scene_error.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace talus
{
namespace
{

/// Mean overlap by h² gravity/N_min, for each diameter of depth, in a free column of 100: more than the 0.45 of beds,
/// by what keeps it from swaying.
constexpr double overlap_of_layer = 0.6;
constexpr int most_sweeps = 4;        ///< with longer steps slow impacts no longer give back what they should (P4)
constexpr double rigid_step = 0.0072; ///< h / √(d/gravity) with `projected`, where more sweeps are no help
constexpr double borne_step = 0.0072; ///< with two sweeps, below a sphere of `borne_ratio` times the mass
constexpr double borne_ratio = 800.0; ///< grains overlap by 0.02 d (measured)
constexpr double beyond_sense = 10.0; ///< times as fast as anything should come to be

/// How fast attraction brings two spheres, or a sphere and a wall, together, the worst of all pairs of materials: W F
/// of spheres of this diameter [m/s²].
double attraction_of(const Simulation& simulation, double diameter)
{
    const Model& model = simulation.model;
    if (!model.physics.attraction) return 0.0;
    double worst = 0.0;
    const std::set<int> spheres = sphere_materials(simulation);
    const auto note = [&](int a, int b, double density, double reduced_radius, double masses) {
        const double mass = density * std::numbers::pi / 6.0 * std::pow(diameter, 3);
        const AttractionOfPair pair(model.materials.attraction(a, b), reduced_radius, mass * model.gravity.norm());
        worst = std::max(worst, masses / mass * pair.force(0.0));
    };
    const auto density_of = [&](int k) { return model.materials.list[static_cast<std::size_t>(k)].density; };
    for (const int a : spheres) {
        for (const int b : spheres) note(a, b, std::min(density_of(a), density_of(b)), 0.25 * diameter, 2.0);
        for (const Wall& wall : model.walls) note(a, wall.material, density_of(a), 0.5 * diameter, 1.0);
    }
    return worst;
}

/// Of a mean sphere of the lightest material: what a bed of depth Z presses on each of its contacts, and how much of
/// the softness that a step brings its materials have anyway.
struct Softness {
    double load = 0.0;  ///< mean overlap by h²/N_min [m/s²]
    double given = 0.0; ///< h²/N_min at which the law is as stiff as the stiffest pair of materials [s²]

    Softness(const Simulation& simulation, const Bed& bed)
    {
        const Model& model = simulation.model;
        const double d = model.mean_diameter;
        double density = infinity, stiffness = 0.0, modulus = 0.0;
        const std::set<int> materials = sphere_materials(simulation);
        for (const int a : materials) {
            density = std::min(density, model.materials.list[static_cast<std::size_t>(a)].density);
            for (const int b : materials) {
                stiffness = std::max(stiffness, model.materials.between(a, b).stiffness);
                modulus = std::max(modulus, model.materials.between(a, b).modulus);
            }
        }
        const double inverse_mass_sum = 2.0 / (density * std::numbers::pi / 6.0 * d * d * d);
        load = overlap_of_layer * ((model.gravity.norm() + bed.wall_acceleration) * bed.borne_depth() +
                                      2.0 * bed.surcharge / (packed_share * density * d)) +
               sigma_per_sweep / (4.0 * upsilon) * attraction_of(simulation, d);
        const double carried = 4.0 * upsilon / (sigma_per_sweep * inverse_mass_sum); // stiffness, times h²/N_min
        const double of_hertz = 1.25 * secant_stiffness(modulus, 0.25 * d, carried * load);
        given = 4.0 * upsilon / (sigma_per_sweep * inverse_mass_sum * std::min(stiffness, of_hertz));
    }
};

/// The longest steps that keep to each target, with so many sweeps at least.
StepChoice longest_with(int sweeps, const Simulation& simulation, const Bed& bed, const Softness& softness,
    double closing_speed, const StepTargets& targets)
{
    const Model& model = simulation.model;
    const double d = model.min_diameter, time_of_fall = std::sqrt(d / model.gravity.norm());
    const bool soft = model.solver.stabilisation == Stabilisation::matched;
    const double borne = borne_step * std::sqrt(std::cbrt(borne_ratio / bed.measures.mass_ratio));
    StepChoice choice;
    choice.min_sweeps = sweeps;
    choice.closing_speed = closing_speed;
    choice.restitution = std::ranges::max(model.materials.laws, {}, &ContactLaw::restitution).restitution;
    choice.by_approach = targets.approach * d / choice.meeting_speed();
    choice.by_attraction = std::sqrt(targets.approach * d / attraction_of(simulation, d));
    choice.by_heavy = borne * time_of_fall * std::sqrt(soft ? 0.5 * sweeps : 1.0);
    choice.by_creep = (soft ? std::min(sweeps, most_sweeps) * targets.creep : rigid_step) * time_of_fall;
    if (soft)
        choice.by_overlap =
            std::sqrt(sweeps * (targets.overlap * model.mean_diameter / softness.load + softness.given));
    return choice;
}

/// The sweeps that keep the creep of a given step.
int sweeps_for(double step, const Model& model, const StepTargets& targets)
{
    if (model.solver.stabilisation == Stabilisation::projected) return model.solver.min_sweeps;
    const double sweeps = step / targets.creep * std::sqrt(model.gravity.norm() / model.min_diameter);
    const int most = std::min(most_sweeps, model.solver.max_sweeps);
    return static_cast<int>(std::clamp(std::ceil(sweeps), std::min<double>(model.solver.min_sweeps, most), 1.0 * most));
}

/// With as few sweeps as go with the longest step that any number allows.
StepChoice automatic_choice(const scene::Scene& scene, const Simulation& simulation, const Bed& bed,
    double closing_speed, const StepTargets& targets)
{
    const SolverSettings& solver = simulation.model.solver;
    const Softness softness(simulation, bed);
    const auto with = [&](int n) { return longest_with(n, simulation, bed, softness, closing_speed, targets); };
    if (scene.solver.min_sweeps > 0 || solver.stabilisation == Stabilisation::projected) return with(solver.min_sweeps);
    StepChoice best = with(solver.min_sweeps);
    for (int n = solver.min_sweeps + 1; n <= std::min(most_sweeps, solver.max_sweeps); ++n)
        if (const StepChoice longer = with(n); longer.automatic() > best.automatic()) best = longer;
    return best;
}

} // namespace

StepChoice choose_step(
    const scene::Scene& scene, const Simulation& simulation, const Bed& bed, const StepTargets& targets)
{
    const Model& model = simulation.model;
    const SceneSpeeds speeds = scene_speeds(simulation, bed);
    StepChoice choice = automatic_choice(scene, simulation, bed, speeds.closing, targets);
    choice.by_samples = scene.time.metrics_interval;
    choice.given = scene.time.step.name != "auto";
    choice.step = choice.given ? scene.time.step.number : choice.automatic();
    if (!std::isfinite(choice.step))
        throw SceneError("time.step", "without gravity and speeds there is no automatic step: give one in seconds");
    if (scene.time.duration > 0.0 && choice.step > scene.time.duration)
        throw SceneError("time.step", "the step is longer than the run, 'duration'");
    if (choice.given && scene.solver.min_sweeps == 0) choice.min_sweeps = sweeps_for(choice.step, model, targets);
    choice.speed_limit = beyond_sense * speeds.highest + model.min_diameter / choice.step;
    return choice;
}

} // namespace talus
