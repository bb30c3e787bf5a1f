// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/loop/companions.hpp"

#include "app/loop/schedule.hpp"
#include "app/loop/step_cost.hpp"
#include "core/base/region.hpp"
#include "scenarios/builder/sensors.hpp"
#include "scenarios/builder/solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus
{
namespace
{

constexpr double least_samples = 16.0, least_fall = 4.0; ///< of a piece, the latter in diameters
constexpr double settling = 0.25;                        ///< share of a piece before anything is measured
constexpr double nudge = 1e-6;                           ///< of velocities, by another seed

Simulation with_another_seed(const Simulation& simulation)
{
    Simulation companion = copy_without_sensors(simulation);
    Random random(static_cast<std::uint64_t>(simulation.state.steps));
    for (Body& m : companion.state.bodies) {
        m.velocity *= 1.0 + nudge * (2.0 * uniform(random) - 1.0);
        m.rim_velocity *= 1.0 + nudge * (2.0 * uniform(random) - 1.0);
    }
    for (Pour& source : companion.pours) source.random.seed(random());
    return companion;
}

Simulation with_half_the_step(const Simulation& simulation, const scene::Scene& scene)
{
    Simulation companion = copy_without_sensors(simulation);
    companion.model.time_step *= 0.5;
    companion.model.solver.push_out_speed = push_out_speed(scene.solver, companion.model);
    companion.state.steps *= 2; // so that it is at the same time
    return companion;
}

Simulation with_a_tenth_of_the_tolerance(const Simulation& simulation)
{
    Simulation companion = copy_without_sensors(simulation);
    companion.model.solver.tolerance *= 0.1;
    companion.model.solver.max_sweeps *= 10;
    return companion;
}

/// A companion that makes a piece.
class Companion
{
public:
    Companion(Simulation simulation, const scene::Scene& scene)
        : simulation_(std::move(simulation)), samples_(scene.time.metrics_interval)
    {
        simulation_.sensors = build_sensors(scene, simulation_.model);
    }

    /// @param from when sensors begin to look [s]; @param to [s]
    void make_piece(double from, double to, const std::function<bool()>& go_on)
    {
        samples_.due(from);
        StepHooks hooks;
        hooks.before_step = go_on;
        hooks.after_step = [&](const StepReport& report) {
            cost_ += cost_of(report);
            if (simulation_.state.time > from && !simulation_.incident_policy.stops(report))
                show_to_sensors(simulation_, report, samples_.due(simulation_.state.time));
        };
        run_until(simulation_, to, hooks);
        is_whole_ = has_reached(simulation_, to);
    }

    /// Of its sensors, in their order; not numbers where an incident has stopped it.
    std::vector<double> results() const
    {
        std::vector<double> values;
        for (const auto& sensor : simulation_.sensors)
            for (const Measurement& m : sensor->results())
                values.push_back(is_whole_ ? m.value : std::numeric_limits<double>::quiet_NaN());
        return values;
    }

    double cost() const { return cost_; } ///< [contact updates]

private:
    Simulation simulation_;
    Schedule samples_;
    double cost_ = 0.0;
    bool is_whole_ = false;
};

} // namespace

void ChangesOfResult::add(double same, double seed, double step, double solver)
{
    const double middle = 0.5 * (same + seed);
    step_.add(step - middle);
    solver_.add(solver - middle);
    seed_squares_.add((seed - same) * (seed - same));
}

ChangeOfResult ChangesOfResult::change(const MeanAndError& differences) const
{
    const auto pieces = static_cast<double>(differences.count());
    const double by_seeds = std::sqrt(0.75 * seed_squares_.mean() / pieces);
    return {differences.mean(), std::max(differences.standard_error(), by_seeds),
        static_cast<std::int64_t>(differences.count())};
}

double Companions::piece_length(const Model& model, const scene::Scene& scene)
{
    const double sampled = least_samples * scene.time.metrics_interval;
    if (model.gravity.isZero()) return sampled;
    return std::max(sampled, std::sqrt(2.0 * least_fall * model.mean_diameter / model.gravity.norm()));
}

bool Companions::is_due(const Simulation& simulation, const scene::Scene& scene) const
{
    const double time = simulation.state.time, length = piece_length(simulation.model, scene);
    if (share_ == 0.0 || credit_ < 0.0 || time < next_) return false;
    return std::ranges::any_of(scene.sensor, [&](const scene::SensorTable& sensor) {
        return sensor.from <= time + settling * length && time + length <= sensor.to;
    });
}

void Companions::before_step(
    const Simulation& simulation, const scene::Scene& scene, const std::function<bool()>& go_on)
{
    if (!is_due(simulation, scene)) return;
    const double begin = simulation.state.time, length = piece_length(simulation.model, scene);
    double cost = 0.0;
    const auto results_of = [&](Simulation start) {
        Companion companion(std::move(start), scene);
        companion.make_piece(begin + settling * length, begin + length, go_on);
        cost += companion.cost();
        return companion.results();
    };
    const auto same = results_of(copy_without_sensors(simulation));
    const auto seed = results_of(with_another_seed(simulation));
    const auto step = results_of(with_half_the_step(simulation, scene));
    const auto solver = results_of(with_a_tenth_of_the_tolerance(simulation));
    if (go_on && !go_on()) return;

    changes_.resize(same.size());
    for (std::size_t k = 0; k < same.size(); ++k) changes_[k].add(same[k], seed[k], step[k], solver[k]);
    ++pieces_;
    next_ = begin + length;
    credit_ -= cost;
}

void Companions::after_step(const StepReport& report)
{
    credit_ += share_ * cost_of(report);
}

} // namespace talus
