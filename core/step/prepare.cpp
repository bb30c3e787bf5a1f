// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/step/prepare.hpp"

#include "core/candidates/candidate_search.hpp"
#include "core/candidates/curve_order.hpp"
#include "core/contacts/beside_impacts.hpp"

#include <utility>

namespace talus
{
namespace
{

constexpr std::int64_t renumbering_interval = 1000; ///< steps between renumberings along a curve
constexpr std::size_t few_keys = 1000;              ///< that one thread makes faster than several

/// Brings the spheres into the order of a space-filling curve now and then, for the sake of the cache.
void renumber_along_curve(State& state, ContactNetwork& network, const Model& model)
{
    if (state.steps % renumbering_interval != 0 || state.count() < 2) return;
    network.list.listed_box.resize(state.count());
    std::vector<std::uint64_t> key(state.count());
#pragma omp parallel for schedule(static) if (state.count() > few_keys)
    for (std::size_t i = 0; i < state.count(); ++i)
        key[i] = curve_key(state.position[i], model.contents.min, model.max_diameter);
    const auto order = curve_order(key, state.id);
    renumber_spheres(state, order, state.count());
    renumber_candidates(network.list, network.carried, state, model, order);
}

/// The carried impulses of contacts and guides for a step of this length: impulses go with it.
void scale_impulses(State& state, ContactNetwork& network, double h)
{
    const double before = std::exchange(network.carried.impulse_step, h);
    const double scale = before < infinity ? h / before : 1.0;
    if (scale == 1.0) return;
    for (Tile& tile : network.list.tiles.tiles) tile.carried.scale(scale);
    network.carried.walls.scale(scale);
    for (PistonState& piston : state.pistons) piston.guide_impulse *= scale;
}

} // namespace

void SearchReport::then(const SearchReport& next)
{
    candidates = next.candidates;
    searched += next.searched;
}

PreparedStep prepare_step(
    State& state, ContactNetwork& network, const Model& model, const StepLength& step, const PhaseObserver& observer)
{
    PreparedStep prepared;

    // Which spheres and walls can touch during this step?
    if (observer) observer(Phase::search);
    scale_impulses(state, network, step.h());
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

} // namespace talus
