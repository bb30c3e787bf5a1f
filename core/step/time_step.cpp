// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/step/time_step.hpp"

#include "core/candidates/candidate_search.hpp"
#include "core/candidates/curve_order.hpp"
#include "core/contacts/assembly.hpp"
#include "core/contacts/carry.hpp"
#include "core/contacts/law.hpp"
#include "core/pressure_scaling/pressure_scaling.hpp"
#include "core/solver/gauss_seidel.hpp"
#include "core/solver/piston_group.hpp"
#include "core/solver/position_projection.hpp"
#include "core/step/press.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace talus
{
namespace
{

constexpr std::int64_t renumbering_interval = 1000; ///< steps between renumberings along a curve

/// Brings the spheres into the order of a space-filling curve now and then, for the sake of the cache.
void renumber_along_curve(State& state, ContactNetwork& contacts, const Model& model)
{
    if (state.steps % renumbering_interval != 0 || state.count() < 2) return;
    contacts.listed_box.resize(state.count());
    const auto order = curve_order(state.position);
    renumber_spheres(state, order, state.count());
    renumber_candidates(contacts, state, model, order);
}

/// v⁽¹⁾ = v⁽⁰⁾ + h g.
void add_gravity(std::vector<Motion>& motion, const Vec3& gravity, double h)
{
    for (auto& m : motion) m.velocity += h * gravity;
}

/// x ← x + h v. Spheres are round: their orientation is not kept. What does not fit into the digits of x waits for the
/// next step (Kahan's sum): at 1e6 diameters from the origin they end at 1e-10, and a sphere at constant speed would
/// lose half of that in every step, always the same way.
void move_spheres(State& state, double h)
{
    for (std::size_t i = 0; i < state.count(); ++i) {
        Vec3& x = state.position[i];
        Vec3& rest = state.position_rest[i];
        const Vec3 move = h * state.motion[i].velocity + rest;
        const Vec3 before = x;
        x += move;
        rest = move - (x - before);
    }
}

/// Pistons likewise. Returns the work that their loads did on the way [J].
double move_pistons(State& state, const std::vector<Piston>& pistons, double h)
{
    double work = 0.0;
    for (std::size_t k = 0; k < pistons.size(); ++k) {
        work += h * pistons[k].load_at(state.time) * travel_speed(pistons[k], state.pistons[k]);
        move(pistons[k], state.pistons[k], h);
    }
    return work;
}

/// Spheres that have left the cell of periodic axes come in again on its other side.
void wrap_positions(State& state, const Periodicity& periodicity)
{
    if (!periodicity.any()) return;
    for (Vec3& x : state.position) x = periodicity.wrapped(x);
}

/// A sphere whose centre is inside an outlet leaves lawfully, even if it is out of the outlet again when it is taken
/// away.
void mark_leaving(State& state, const std::vector<Region>& outlets)
{
    for (const auto& outlet : outlets)
        for (std::size_t i = 0; i < state.count(); ++i)
            if (outlet.contains(state.position[i])) state.leaving[i] = 1;
}

StepReport make_report(const BegunStep& begun, const ContactNetwork& contacts, const SolveReport& solve,
    const ContactOutcome& outcome, std::vector<WallLoad> loads, double load_work, StateSurvey bodies)
{
    const ContactSurvey& survey = begun.survey;
    const auto overlapping = static_cast<double>(survey.overlapping);
    return {.sweeps = solve.sweeps,
        .residual = solve.residual,
        .converged = solve.converged,
        .candidates = contacts.pairs.size() + contacts.wall_pairs.size(),
        .contacts = survey.contacts,
        .overlapping = survey.overlapping,
        .worst_overlap = survey.worst_overlap,
        .mean_overlap = survey.overlapping ? survey.overlap_sum / overlapping : 0.0,
        .cone_violation = outcome.cone_violation,
        .kinetic_energy = bodies.kinetic_energy,
        .potential_energy = bodies.potential_energy,
        .gravity_work = bodies.gravity_work,
        .contact_energy = survey.contact_energy,
        .fastest_speed = bodies.fastest_speed,
        .long_moves = bodies.long_moves,
        .searched = begun.searched,
        .wall_impulse = outcome.wall_impulse,
        .wall_work = outcome.wall_work,
        .load_work = load_work,
        .wall_loads = std::move(loads),
        .incidents = std::move(bodies.incidents)};
}

/// Impulses go with the length of the step: those of a step of another length are scaled. Returns by how much.
double scale_impulses(State& state, ContactNetwork& contacts, double h)
{
    const double scale = contacts.impulse_step < infinity ? h / contacts.impulse_step : 1.0;
    contacts.impulse_step = h;
    if (scale == 1.0) return scale;
    contacts.pair_carried.scale(scale);
    contacts.wall_carried.scale(scale);
    for (PistonState& piston : state.pistons) piston.guide_impulse *= scale;
    return scale;
}

using MovingBodies = std::tuple<std::vector<Motion>, std::vector<PistonState>>;

/// The speed of the fastest sphere or piston; not asked for where nothing is too fast.
double fastest_of(const State& state, double too_fast)
{
    if (too_fast == infinity) return 0.0;
    double fastest = 0.0;
    for (const Motion& m : state.motion) fastest = std::max(fastest, m.velocity.squaredNorm());
    for (const PistonState& piston : state.pistons) fastest = std::max(fastest, piston.velocity.squaredNorm());
    return std::sqrt(fastest);
}

} // namespace

BegunStep begin_step(State& state, ContactNetwork& contacts, const Model& model, const PhaseObserver& observer)
{
    BegunStep begun;

    // Which spheres and walls can touch during this step?
    if (observer) observer(Phase::search);
    begun.impulse_scale = scale_impulses(state, contacts, model.time_step);
    renumber_along_curve(state, contacts, model);
    begun.walls = place_walls(model, state, model.time_step);
    begun.searched = update_candidates(contacts, state, model, begun.walls);

    // Which do, under which law, and with what impulse to begin with?
    if (observer) observer(Phase::assembly);
    begun.survey = assemble_contacts(contacts, state, model, begun.walls);
    return begun;
}

StepReport advance(State& state, ContactNetwork& contacts, const Model& model, const PhaseObserver& observer)
{
    return *advance_unless_faster(infinity, state, contacts, model, observer);
}

std::optional<StepReport> advance_unless_faster(
    double fastest, State& state, ContactNetwork& contacts, const Model& model, const PhaseObserver& observer)
{
    const double h = model.time_step;
    const auto enter = [&](Phase phase) {
        if (observer) observer(phase);
    };

    // Who touches whom, and under which law?
    const BegunStep begun = begin_step(state, contacts, model, observer);
    PistonGroup pistons(contacts, state, model);
    const MovingBodies before = fastest < infinity ? MovingBodies{state.motion, state.pistons} : MovingBodies{};

    // The velocity if nothing touched: v⁽¹⁾ = v⁽⁰⁾ + h M⁻¹ f.
    // Then the impulses of the last step: v ← v + M⁻¹ Gᵀ λ⁰.
    enter(Phase::warm_start);
    add_gravity(state.motion, model.gravity, h);
    double warm_size = apply_warm_start(contacts, pistons, state.motion, model.physics);
    // The impulse of an impact does not grow with the step: it must not loosen the measure of the others.
    if (begun.impulse_scale > 1.0) warm_size /= begun.impulse_scale * begun.impulse_scale;

    // Where the load has changed, the pressure changes with it, through the whole bed at once: λ ← θ λ. First what is
    // local must be out of the way: contacts that open, and impacts.
    enter(Phase::sweeps);
    int sweeps = 0;
    if (model.solver.pressure_scaling) {
        sweeps = std::min(sweeps_before_scaling, model.solver.max_sweeps - 1);
        sweep_contacts(sweeps, contacts, pistons, state.motion, model.physics);
        scale_pressure(contacts, pistons, state, model);
    }

    // The contact impulses: every contact in turn until all laws hold.
    const auto solve = solve_contacts(contacts, pistons, state.motion, model.physics, model.solver, warm_size, sweeps);
    pistons.store(contacts, state);
    if (fastest_of(state, fastest) > fastest) {
        std::tie(state.motion, state.pistons) = before;
        return std::nullopt;
    }

    auto loads = model.physics.wall_loads ? wall_loads(contacts, state, model.walls.size()) : std::vector<WallLoad>{};

    // Positions with the new velocity: x ← x + h v.
    enter(Phase::positions);
    move_spheres(state, h);
    const double load_work = move_pistons(state, model.pistons, h);
    if (model.solver.stabilisation == Stabilisation::projected)
        project_positions(contacts, state, model, begun.walls, projected_share);
    if (model.solver.sub_steps > 1) hold_at_walls(contacts, state, model, begun.walls);
    wrap_positions(state, model.periodicity);
    if (model.solver.sub_steps == 1)
        state.time = static_cast<double>(++state.steps) * h;
    else
        state.time += h;

    // What there is to tell, and what the next step begins with.
    enter(Phase::report);
    mark_leaving(state, model.outlets);
    const auto outcome = carry_impulses(contacts, state, model);
    StateSurvey bodies = survey_state(state, model);
    if (outcome.beyond_solution > 0)
        for (Incident& press : find_presses(contacts, state, model)) bodies.incidents.push_back(std::move(press));
    return make_report(begun, contacts, solve, outcome, std::move(loads), load_work, std::move(bodies));
}

} // namespace talus
