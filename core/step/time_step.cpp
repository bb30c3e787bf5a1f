// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/step/time_step.hpp"

#include "core/candidates/candidate_search.hpp"
#include "core/candidates/curve_order.hpp"
#include "core/contacts/beside_impacts.hpp"
#include "core/packs/law.hpp"
#include "core/solver/flight.hpp"
#include "core/solver/piston_group.hpp"
#include "core/solver/position_projection.hpp"
#include "core/step/contact_gain.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace talus
{
namespace
{

constexpr std::int64_t audit_interval = 16;         ///< steps; gains of contacts are looked for in one of so many
constexpr std::int64_t renumbering_interval = 1000; ///< steps between renumberings along a curve
constexpr double usual_ratio = 10.0;                ///< of what strikes a sphere that bears it, to its own mass …
constexpr int most_sweeps = 3000;                   ///< … beyond which a step goes to its end, in so many sweeps;
constexpr double tolerance_beyond = 0.1 / 300.0;    ///< … that of a ratio beyond `most_impact_ratio` …
constexpr int most_sweeps_beyond = 900;             ///< … and its sweeps
constexpr std::size_t few_spheres = 1000;           ///< that one thread takes faster than several

/// Brings the spheres into the order of a space-filling curve now and then, for the sake of the cache.
void renumber_along_curve(State& state, ContactNetwork& network, const Model& model)
{
    if (state.steps % renumbering_interval != 0 || state.count() < 2) return;
    network.list.listed_box.resize(state.count());
    std::vector<std::uint64_t> key(state.count());
#pragma omp parallel for schedule(static) if (state.count() > few_spheres)
    for (std::size_t i = 0; i < state.count(); ++i)
        key[i] = curve_key(state.position[i], model.contents.min, model.max_diameter);
    const auto order = curve_order(key, state.id);
    renumber_spheres(state, order, state.count());
    renumber_candidates(network.list, network.carried, state, model, order);
}

/// The carried impulses of contacts and guides for a step of this length: impulses go with it. Returns by how much they
/// were scaled.
double scale_impulses(State& state, ContactNetwork& network, double h)
{
    const double before = std::exchange(network.carried.impulse_step, h);
    const double scale = before < infinity ? h / before : 1.0;
    if (scale == 1.0) return scale;
    for (Tile& tile : network.list.tiles.tiles) tile.carried.scale(scale);
    network.carried.walls.scale(scale);
    for (PistonState& piston : state.pistons) piston.guide_impulse *= scale;
    return scale;
}

/// v⁽¹⁾ = v⁽⁰⁾ + h g.
void add_gravity(std::vector<Motion>& motion, const Vec3& gravity, double h)
{
#pragma omp parallel for schedule(static) if (motion.size() > few_spheres)
    for (std::size_t i = 0; i < motion.size(); ++i) motion[i].velocity += h * gravity;
}

/// v⁽¹⁾ ← v⁽¹⁾ + h f / m for the spheres' own forces.
void add_own_forces(State& state, double h)
{
    for (std::size_t i = 0; i < state.own_force.size(); ++i)
        state.motion[i].velocity += h * state.motion[i].inverse_mass * state.own_force[i];
}

/// x ← x + h v. Spheres are round: their orientation is not kept. What does not fit into the digits of x waits for the
/// next step (Kahan's sum): at 1e6 diameters from the origin they end at 1e-10, and a sphere at constant speed would
/// lose half of that in every step, always the same way.
void move_spheres(State& state, double h)
{
#pragma omp parallel for schedule(static) if (state.count() > few_spheres)
    for (std::size_t i = 0; i < state.count(); ++i) {
        Vec3& x = state.position[i];
        Vec3& rest = state.position_rest[i];
        const Vec3 move = h * state.motion[i].velocity + rest;
        const Vec3 before = x;
        x += move;
        rest = move - (x - before);
    }
}

/// Moves pistons along their guides with their velocity. Returns the work that their loads did on the way [J].
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
#pragma omp parallel for schedule(static) if (state.count() > few_spheres)
    for (std::size_t i = 0; i < state.count(); ++i) state.position[i] = periodicity.wrapped(state.position[i]);
}

/// A sphere whose centre is inside an outlet leaves lawfully, even if it is out of the outlet again when it is taken
/// away.
void mark_leaving(State& state, const std::vector<Region>& outlets)
{
    for (const auto& outlet : outlets)
#pragma omp parallel for schedule(static) if (state.count() > few_spheres)
        for (std::size_t i = 0; i < state.count(); ++i)
            if (outlet.contains(state.position[i])) state.leaving[i] = 1;
}

/// The speed of the fastest sphere or piston, for those in flight that of the way which they have left to go; not asked
/// for where nothing is too fast.
double fastest_of(const State& state, const std::vector<Flight>& flights, double h, double too_fast)
{
    if (too_fast == infinity) return 0.0;
    double fastest = 0.0;
#pragma omp parallel for schedule(static) reduction(max : fastest) if (state.count() > few_spheres)
    for (std::size_t i = 0; i < state.count(); ++i) fastest = std::max(fastest, state.motion[i].velocity.squaredNorm());
    for (const PistonState& piston : state.pistons) fastest = std::max(fastest, piston.velocity.squaredNorm());
    fastest = std::sqrt(fastest);
    for (const Flight& flight : flights)
        fastest = std::max(fastest, (1.0 - flight.instant / h) * state.motion[flight.sphere].velocity.norm());
    return fastest;
}

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

} // namespace

void SearchReport::then(const SearchReport& next)
{
    candidates = next.candidates;
    searched += next.searched;
}

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
    bodies.then(std::move(next.bodies));
    for (std::size_t w = 0; w < wall_loads.size(); ++w) wall_loads[w] += next.wall_loads[w];
}

PreparedStep prepare_step(
    State& state, ContactNetwork& network, const Model& model, const StepLength& step, const PhaseObserver& observer)
{
    PreparedStep prepared;

    // Which spheres and walls can touch during this step?
    if (observer) observer(Phase::search);
    prepared.impulse_scale = scale_impulses(state, network, step.h());
    renumber_along_curve(state, network, model);
    prepared.walls = place_walls(model, state, step.h());
    prepared.search.searched = update_candidates(network.list, network.carried, state, model, step.h(), prepared.walls);
    prepared.search.candidates = network.list.size();

    // Which do, under which law, and with what impulse to begin with?
    if (observer) observer(Phase::assembly);
    prepared.contacts = assemble_contacts(network, state, model, step, prepared.walls);
    if (prepared.contacts.impacts > 0) {
        prepared.impact_ratio = stand_beside_impacts(network, state, model, law_of_step(model, step));
        prepared.flights = find_flights(network, state, model, step.h());
    }
    return prepared;
}

std::optional<StepReport> advance_once(const StepLength& step, double fastest, State& state, ContactNetwork& network,
    const Model& model, const PhaseObserver& observer)
{
    const double h = step.h();
    const auto enter = [&](Phase phase) {
        if (observer) observer(phase);
    };

    // Who touches whom, and under which law?
    const PreparedStep prepared = prepare_step(state, network, model, step, observer);
    PistonGroup pistons(network, state, model, h);
    if (fastest < infinity) network.before.take(state);
    StepReport report;
    report.search = prepared.search;
    report.contacts = prepared.contacts;

    // The velocity if nothing touched: v⁽¹⁾ = v⁽⁰⁾ + h M⁻¹ f.
    // Then the impulses of the last step: v ← v + M⁻¹ Gᵀ λ⁰.
    enter(Phase::warm_start);
    add_gravity(state.motion, model.gravity, h);
    add_own_forces(state, h);
    double warm_size = apply_warm_start(network, pistons, state.motion, model.physics);
    // The impulse of an impact does not grow with the step: it must not loosen the measure of the others.
    if (prepared.impulse_scale > 1.0) warm_size /= prepared.impulse_scale * prepared.impulse_scale;
    // Nor may one of something heavy that a column has borne, which hands it on: what counts is the load before.
    const double shorter = std::min(1.0, prepared.impulse_scale);
    warm_size = std::min(warm_size, shorter * shorter * network.carried.load_before_impact);

    // Where the load has changed, the pressure changes with it, through the whole bed at once: λ ← θ λ. First what is
    // local must be out of the way: contacts that open, and impacts.
    enter(Phase::sweeps);
    int sweeps = 0;
    if (model.solver.pressure_scaling) {
        sweeps = std::min(sweeps_before_scaling, model.solver.max_sweeps - 1);
        const double change = sweep_contacts(sweeps, network, pistons, state.motion, model.physics, warm_size);
        if (needs_scaling(change, state, model)) report.scaling = scale_pressure(network, pistons, state, model);
    }

    // The contact impulses: every contact in turn until all laws hold.
    const SolverSettings solver = solver_for(prepared, model.solver);
    report.solve = solve_contacts(network, pistons, state.motion, model.physics, solver, warm_size, sweeps);
    pistons.store(network, state);
    if (fastest_of(state, prepared.flights, h, fastest) > fastest) {
        network.before.put_back(state);
        return std::nullopt;
    }
    network.carried.load_before_impact = solver.to_the_end ? warm_size : infinity;
    if (!step.is_split() && state.steps % audit_interval == 0)
        report.contact_gain = audit_interval * contact_gain(network, state, model, h);
    if (model.physics.wall_loads) report.wall_loads = wall_loads(network, state, model.walls.size());

    const bool may_appear = std::ranges::any_of(model.walls, [](const Wall& wall) { return wall.appear_at > 0.0; });
    auto walls_inside = may_appear ? find_walls_inside(network, state, model) : std::vector<Incident>{};

    // Positions with the new velocity: x ← x + h v.
    enter(Phase::positions);
    move_spheres(state, h);
    report.lifted_energy = move_flights(prepared.flights, state, model.gravity);
    const double load_work = move_pistons(state, model.pistons, h);
    if (model.solver.stabilisation == Stabilisation::projected)
        report.lifted_energy += project_positions(network, state, model, prepared.walls, projected_share);
    if (step.is_split()) report.lifted_energy += hold_at_walls(network, state, model, prepared.walls);
    wrap_positions(state, model.periodicity);
    state.time = step.is_split() ? state.time + h : static_cast<double>(++state.steps) * h;

    // What there is to tell, and what the next step begins with.
    enter(Phase::report);
    mark_leaving(state, model.outlets);
    report.outcome = carry_impulses(network, state, model, step);
    report.bodies = survey_state(state, model, step);
    report.bodies.load_work = load_work;
    survey_own_forces(report.bodies, state, h);
    for (Incident& wall : walls_inside) report.bodies.incidents.push_back(std::move(wall));
    if (report.outcome.newly_jammed > 0)
        for (Incident& press : find_presses(network, state, model)) report.bodies.incidents.push_back(std::move(press));
    return report;
}

} // namespace talus
