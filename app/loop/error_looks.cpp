// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/loop/error_looks.hpp"

#include "app/loop/step_cost.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace talus
{
namespace
{

constexpr double exact_tolerance = 1e-12;
constexpr int most_sweeps = 20000;

/// A copy whose next step is solved to this tolerance, or as far as so many sweeps go.
Simulation exact_copy(const Simulation& simulation, double tolerance = exact_tolerance, int sweeps = most_sweeps)
{
    Simulation copy = copy_without_sensors(simulation);
    copy.model.solver.tolerance = tolerance;
    copy.model.solver.max_sweeps = sweeps;
    return copy;
}

// A look goes this much further than the step, in residual; in sweeps by no less than this, whatever it costs, and
// otherwise as far as looks, with all that were before, cost no more than so many times their share.
constexpr double further = 1e-3;
constexpr int least_sweeps = 100;
constexpr double most_shares = 10.0 / 3.0;

constexpr double parts_per_share = 4000.0; ///< 120 parts for the usual share
constexpr double least_cost_of_look = 4.0; ///< in steps; what it is in truth joins parts
constexpr double memory = 0.25;            ///< weight of the last look in what they cost of late
constexpr double dear = 4.0 / 3.0;         ///< shares that they then may cost
constexpr double fewest = 1.0 / 15;        ///< of the parts, before which it is too early to judge
constexpr double golden_ratio = 0.61803398874989485;

/// By id: a step may put spheres into another order.
using Velocities = std::unordered_map<std::int64_t, Vec3>;

Velocities velocities(const State& state)
{
    Velocities all;
    for (std::size_t i = 0; i < state.count(); ++i) all.emplace(state.id[i], state.body(i).velocity);
    return all;
}

/// What the velocities would be after the next step if nothing touched.
Velocities free_velocities(const Simulation& simulation)
{
    const State& state = simulation.state;
    const double h = simulation.model.time_step;
    Velocities all;
    for (std::size_t i = 0; i < state.count(); ++i) {
        Vec3 v = state.body(i).velocity + h * simulation.model.gravity;
        if (!state.own_force.empty()) v += h * state.body(i).inverse_mass * state.own_force[i];
        all.emplace(state.id[i], v);
    }
    return all;
}

double rms(double squares, std::size_t count)
{
    return count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0.0;
}

/// Rms of the differences of velocities, and of what contacts have changed in them.
void compare_velocities(ErrorLook& look, const State& found, const Velocities& exact, const Velocities& free)
{
    double errors = 0.0, speeds = 0.0, changes = 0.0;
    for (std::size_t i = 0; i < found.count(); ++i) {
        const Vec3& v = found.body(i).velocity;
        const Vec3& right = exact.at(found.id[i]);
        errors += (v - right).squaredNorm();
        speeds += v.squaredNorm();
        const auto before = free.find(found.id[i]); // those that have just been poured touch nothing yet
        if (before != free.end()) changes += (right - before->second).squaredNorm();
    }
    look.velocity_error = rms(errors, found.count());
    look.flow_speed = rms(speeds, found.count());
    look.change_by_contacts = rms(changes, found.count());
}

/// Sums over the contacts of a step that was solved twice.
struct ForceSums {
    double squares = 0.0, size = 0.0;
    std::size_t count = 0;

    /// @pre the same contacts
    void add(const TileContacts& found, const TileContacts& exact)
    {
        for (const std::size_t k : exact.indices()) {
            const Vec3 one = found.impulse(k), other = exact.impulse(k);
            if (one.isZero(0.0) && other.isZero(0.0)) continue;
            squares += (one - other).squaredNorm();
            size += other.norm();
            ++count;
        }
    }
};

double force_error(const ContactNetwork& found, const ContactNetwork& exact)
{
    ForceSums sums;
    for (std::size_t t = 0; t < exact.contacts.spheres.size(); ++t)
        sums.add(found.contacts.spheres[t], exact.contacts.spheres[t]);
    for (std::size_t t = 0; t < exact.contacts.walls.size(); ++t)
        sums.add(found.contacts.walls[t], exact.contacts.walls[t]);
    sums.add(found.contacts.pistons, exact.contacts.pistons);
    if (sums.size == 0.0) return ErrorLook::unknown;
    return rms(sums.squares, sums.count) / (sums.size / static_cast<double>(sums.count));
}

/// √(Σ x² / n) over the looks in which x is known; not a number without any.
template <class Part> double rms_over(const std::vector<ErrorLook>& looks, Part&& part)
{
    double squares = 0.0;
    std::size_t count = 0;
    for (const ErrorLook& look : looks)
        if (const double x = part(look); std::isfinite(x)) {
            squares += x * x;
            ++count;
        }
    return count > 0 ? std::sqrt(squares / static_cast<double>(count)) : ErrorLook::unknown;
}

} // namespace

double velocity_error_of_next_step(const Simulation& simulation)
{
    Simulation usual = copy_without_sensors(simulation), exact = exact_copy(simulation);
    advance(usual);
    advance(exact);
    const Velocities found = velocities(usual.state);
    double squares = 0.0;
    for (const auto& [id, right] : velocities(exact.state))
        if (const auto one = found.find(id); one != found.end()) squares += (one->second - right).squaredNorm();
    return rms(squares, found.size());
}

std::vector<std::size_t> watched_walls(const scene::Scene& scene, const Model& model)
{
    std::vector<std::size_t> walls;
    for (std::size_t w = 0; w < model.walls.size(); ++w)
        if (std::ranges::any_of(scene.sensor, [&](const scene::SensorTable& sensor) {
                return sensor.kind == "wall_force" && sensor.wall == model.walls[w].name;
            }))
            walls.push_back(w);
    return walls;
}

void ErrorLooks::begin_part(std::int64_t step)
{
    // Places in the parts that are spread evenly, so that nothing that comes back after a time is always met alike.
    const double place = std::fmod(golden_ratio * static_cast<double>(++parts_), 1.0);
    begin_ = step;
    next_ = begin_ + static_cast<std::int64_t>(place * static_cast<double>(part_));
}

void ErrorLooks::join_parts()
{
    // Of two looks now the first is kept and now the second. The part that goes on is the first or the second half of
    // one that is twice as long.
    const bool is_first_half = looks_.size() % 2 == 1;
    std::vector<ErrorLook> kept;
    for (std::size_t k = 0; k + 1 < looks_.size(); k += 2) kept.push_back(std::move(looks_[k + k / 2 % 2]));
    if (is_first_half) kept.push_back(std::move(looks_.back()));
    looks_ = std::move(kept);
    if (!is_first_half) begin_ -= part_;
    part_ *= 2;
}

void ErrorLooks::before_step(const Simulation& simulation)
{
    copy_.reset();
    const std::int64_t step = simulation.state.steps;
    if (planned_share_ != share_) { // at the beginning, or where a resumed run is looked at more or less closely
        const double length = (simulation.duration - simulation.state.time) / simulation.model.time_step;
        const double part = std::max(length / (parts_per_share * share_), least_cost_of_look / share_);
        part_ = static_cast<std::int64_t>(std::clamp(part, 1.0, 1e9));
        planned_share_ = share_;
        begin_part(step);
    }
    if (step == begin_ + part_) begin_part(step);
    if (step != next_ || contacts_ == 0) return;
    const double affordable =
        (most_shares * share_ * cost_ - spent_) / static_cast<double>(contacts_) - 2.0 * rest_of_step;
    copy_ = std::make_shared<Simulation>(
        exact_copy(simulation, std::max(exact_tolerance, further * simulation.model.solver.tolerance),
            static_cast<int>(std::clamp<double>(affordable, least_sweeps, most_sweeps))));
}

void ErrorLooks::after_step(const Simulation& simulation, const StepReport& report)
{
    contacts_ = static_cast<std::int64_t>(report.contacts.count);
    cost_ += cost_of(report);
    if (!copy_) return;

    const Velocities free = free_velocities(*copy_);
    const StepReport exact = advance(*copy_);
    const double looked = cost_of(exact) + rest_of_step * static_cast<double>(exact.contacts.count); // with the copy
    spent_ += looked;
    ErrorLook look;
    look.time = simulation.state.time;
    look.residual = exact.solve.residual;
    look.to_the_end = exact.solve.converged;
    compare_velocities(look, simulation.state, velocities(copy_->state), free);
    if (report.sub_steps == 1 && exact.sub_steps == 1)
        look.force_error = force_error(simulation.network, copy_->network);
    const double h = simulation.model.time_step;
    for (std::size_t w = 0; w < report.wall_loads.size(); ++w) {
        const Vec3& right = exact.wall_loads[w].impulse;
        look.wall_errors.push_back((report.wall_loads[w].impulse - right).norm() / h);
        look.wall_forces.push_back(right.norm() / h);
    }
    copy_.reset();

    ++made_;
    latest_ = look;
    looks_.push_back(std::move(look));
    recent_looks_ += memory * (looked - recent_looks_);
    recent_steps_ += memory * (cost_of(report) - recent_steps_);
    const double parts = parts_per_share * share_, kept = static_cast<double>(looks_.size());
    const bool is_dear = recent_looks_ > dear * share_ * static_cast<double>(part_) * recent_steps_;
    if ((is_dear && kept > fewest * parts) || kept >= 2.0 * parts) join_parts();
}

SolverErrorSummary ErrorLooks::summary(const Model& model) const
{
    SolverErrorSummary summary;
    summary.looks = static_cast<std::int64_t>(looks_.size());
    summary.made = made_;
    summary.share = cost_ > 0.0 ? spent_ / cost_ : 0.0;
    summary.to_the_end = std::ranges::count_if(looks_, [](const ErrorLook& look) { return look.to_the_end; });
    summary.residual = rms_over(looks_, [](const ErrorLook& look) { return look.residual; });
    summary.velocity_error = rms_over(looks_, [](const ErrorLook& look) { return look.velocity_error; });
    for (const ErrorLook& look : looks_)
        if (look.velocity_error >= summary.worst_velocity_error) {
            summary.worst_velocity_error = look.velocity_error;
            summary.worst_time = look.time;
        }
    const double unit = std::sqrt(model.gravity.norm() * model.mean_diameter);
    const auto share_of = [&](double speed) {
        return speed > 0.0 ? summary.velocity_error / speed : ErrorLook::unknown;
    };
    summary.in_fall_speeds = share_of(unit);
    summary.of_flow = share_of(rms_over(looks_, [](const ErrorLook& look) { return look.flow_speed; }));
    summary.of_contacts = share_of(rms_over(looks_, [](const ErrorLook& look) { return look.change_by_contacts; }));
    summary.force_error = rms_over(looks_, [](const ErrorLook& look) { return look.force_error; });
    if (!model.physics.wall_loads || looks_.empty()) return summary;
    for (std::size_t w = 0; w < model.walls.size(); ++w) {
        const auto part = [&](const std::vector<double> ErrorLook::*list) {
            return rms_over(looks_, [&](const ErrorLook& look) { return (look.*list)[w]; });
        };
        summary.walls.push_back({model.walls[w].name, part(&ErrorLook::wall_errors), part(&ErrorLook::wall_forces)});
    }
    return summary;
}

} // namespace talus
