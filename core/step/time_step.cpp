// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/step/time_step.hpp"

#include "core/contacts/attractions.hpp"
#include "core/deep_beds/position_pass.hpp"
#include "core/law/thresholds.hpp"
#include "core/solver/piston_group.hpp"
#include "core/step/hold_at_walls.hpp"
#include "core/step/motion.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace talus
{
namespace
{

constexpr double usual_ratio = 10.0;             ///< of what strikes a sphere that bears it, to its own mass …
constexpr int most_sweeps = 3000;                ///< … beyond which a step goes to its end, in so many sweeps;
constexpr double tolerance_beyond = 0.1 / 300.0; ///< … that of a ratio beyond `most_impact_ratio` …
constexpr int most_sweeps_beyond = 900;          ///< … and its sweeps

// What two come nearer in a step, in smallest diameters.
constexpr double longest_approach = 0.2;
constexpr double sub_step_approach = 0.1;
constexpr double longest_throw = 0.4; ///< by impulses: by 0.5 the centre of what touched a thin wall is inside it

/// Nothing is thrown so many times as fast as two close at most: a light sphere that a heavy one meets twice as fast,
/// through a lighter one between them four times.
constexpr double greatest_gain = 10.0;

/// What an impact of something much heavier than what bears it leaves undone in its step, takes the bounces of many.
/// What is pinched bears impulses beside which those of all others are small: ε would not see their errors. But with
/// sweeps to the end they would only grow, where walls leave no room.
SolverSettings solver_for(const PreparedStep& prepared, SolverSettings solver)
{
    solver.tolerance = tightened(solver.tolerance, 1.0 / prepared.contacts.worst_strain);
    const bool is_beyond = prepared.impact_ratio > most_impact_ratio, is_pinched = prepared.contacts.worst_strain > 0.0;
    if (prepared.impact_ratio <= usual_ratio || (is_pinched && !is_beyond)) return solver;
    solver.to_the_end = !is_beyond;
    if (!solver.to_the_end) solver.tolerance = std::min(solver.tolerance, tolerance_beyond);
    solver.max_sweeps = std::max(solver.max_sweeps, solver.to_the_end ? most_sweeps : most_sweeps_beyond);
    return solver;
}

/// One step of the method, stage by stage, with what each leaves to the next ones.
class Step
{
public:
    Step(const StepLength& length, State& state, ContactNetwork& network, const Model& model,
        const PhaseObserver& observer)
        : length_(length), h_(length.h()), state_(state), network_(network), model_(model), observer_(observer)
    {
    }

    /// Who touches whom, under which law, and with what impulse to begin with?
    void prepare()
    {
        prepared_ = prepare_step(state_, network_, model_, length_, observer_);
        report_.search = prepared_.search;
        report_.contacts = prepared_.contacts;
    }

    /// The velocity if nothing touched: v⁽¹⁾ = v⁽⁰⁾ + h M⁻¹ f. Then the impulses of the last step: v ← v + M⁻¹ Gᵀ λ⁰.
    void free_motion()
    {
        enter(Phase::warm_start);
        pistons_.emplace(network_, state_, model_, h_);
        attraction_work_ = 0.5 * attraction_power(network_, state_, model_);
        add_forces(state_, model_.gravity, h_);
        apply_warm_start(network_, *pistons_, state_.bodies, model_.physics);
    }

    /// The contact impulses: every contact in turn until all laws hold. Before that the pressures of a deep bed are
    /// corrected as a whole.
    void solve()
    {
        enter(Phase::sweeps);
        solver_ = solver_for(prepared_, model_.solver);
        report_.scaling = correct_pressures(network_, *pistons_, state_, model_);
        report_.solve =
            solve_contacts(network_, *pistons_, state_.bodies, model_.physics, solver_, report_.scaling.sweeps);
        pistons_->store(network_, state_);
        attraction_work_ += 0.5 * attraction_power(network_, state_, model_);
    }

    /// How much nearer those come that touch in the step [m].
    double approach() const { return h_ * prepared_.contacts.closing_speed; }

    /// How far impulses throw what they throw furthest, from where it would have come [m].
    double farthest_throw() const
    {
        double speed = talus::farthest_throw(state_, network_.contacts.free_velocity);
        for (std::size_t k = 0; k < state_.pistons.size(); ++k)
            speed = std::max(speed, (state_.pistons[k].velocity - network_.before.pistons[k].velocity).norm());
        return h_ * speed;
    }

    /// Positions with the new velocity: x ← x + h v. What walls bear is measured before.
    void move()
    {
        enter(Phase::positions);
        if (model_.physics.wall_loads) report_.wall_loads = wall_loads(network_, state_, model_.walls.size());
        incidents_ = find_walls_inside(network_, state_, model_);
        move_spheres(state_, h_);
        report_.lifted_energy = move_flights(prepared_.flights, state_, model_.gravity);
        load_work_ = move_pistons(state_, model_.pistons, h_);
        report_.lifted_energy += project_positions(network_, state_, model_, prepared_.walls);
        if (length_.is_split()) report_.lifted_energy += hold_at_walls(network_, state_, model_, prepared_.walls);
        wrap_positions(state_, model_.periodicity);
        length_.pass(state_);
    }

    /// What there is to report, and what the next step begins with.
    StepReport hand_on()
    {
        enter(Phase::report);
        mark_leaving(state_, model_.outlets);
        report_.outcome = carry_impulses(network_, state_, model_, length_);
        report_.bodies = survey_state(state_, model_, h_);
        report_.bodies.load_work += load_work_;
        report_.attraction_work = attraction_work_;
        if (report_.outcome.newly_jammed > 0)
            std::ranges::move(find_presses(network_, state_, model_), std::back_inserter(incidents_));
        std::ranges::move(incidents_, std::back_inserter(report_.bodies.incidents));
        return std::move(report_);
    }

private:
    const StepLength& length_;
    const double h_;
    State& state_;
    ContactNetwork& network_;
    const Model& model_;
    const PhaseObserver& observer_;
    StepReport report_;

    PreparedStep prepared_;              ///< by prepare
    std::optional<PistonGroup> pistons_; ///< by free_motion, with their velocities from solve on
    SolverSettings solver_;              ///< by solve
    double attraction_work_ = 0.0;       ///< by free_motion and solve [J]
    double load_work_ = 0.0;             ///< by move: of pistons' loads [J]
    std::vector<Incident> incidents_;    ///< by move: walls that appeared inside spheres

    void enter(Phase phase) const
    {
        if (observer_) observer_(phase);
    }
};

} // namespace

void StepReport::then(StepReport next)
{
    search.then(next.search);
    contacts.then(next.contacts);
    solve.then(next.solve);
    scaling.then(next.scaling);
    const double stored_energy = next.outcome.stored_energy;
    outcome += next.outcome;
    outcome.stored_energy = stored_energy;
    lifted_energy += next.lifted_energy;
    attraction_work += next.attraction_work;
    bodies.then(std::move(next.bodies));
    for (std::size_t w = 0; w < wall_loads.size(); ++w) wall_loads[w] += next.wall_loads[w];
}

std::optional<StepReport> advance_once(const StepLength& length, bool in_any_case, State& state,
    ContactNetwork& network, const Model& model, const PhaseObserver& observer)
{
    Step step(length, state, network, model, observer);
    const double d = model.min_diameter;
    step.prepare();
    if (!in_any_case && step.approach() > (length.is_split() ? sub_step_approach : longest_approach) * d)
        return std::nullopt;
    const bool may_throw = !in_any_case && greatest_gain * step.approach() > longest_throw * d;
    if (may_throw) network.before.take(state);
    step.free_motion();
    step.solve();
    if (may_throw && step.farthest_throw() > longest_throw * d) {
        network.before.put_back(state);
        return std::nullopt;
    }
    step.move();
    return step.hand_on();
}

} // namespace talus
