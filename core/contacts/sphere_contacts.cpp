// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contacts/sphere_contacts.hpp"

#include "core/contacts/attractions.hpp"
#include "core/contacts/rolling_rows.hpp"

#include <algorithm>
#include <bit>

namespace talus
{
namespace
{

SpherePlace place_of(const State& state, std::size_t i)
{
    const Vec3 &x = state.position[i], &v = state.body(i).velocity;
    return {{x.x(), x.y(), x.z()}, state.radius[i], {v.x(), v.y(), v.z()}, state.body(i).inverse_mass};
}

/// So far that two spheres of which one comes within reach of the other meet with it.
double reach_of(const State& state, std::size_t i, const StepConstants& step)
{
    return state.radius[i] + std::max(0.5 * step.reach, step.horizon * state.body(i).velocity.norm());
}

void note_impacts(
    const ContactPack& pack, PackImpacts impacts, const std::vector<Body>& bodies, std::vector<BodyImpacts>& of)
{
    for (; impacts.lanes != 0; impacts.lanes &= impacts.lanes - 1) {
        const int lane = std::countr_zero(impacts.lanes);
        const std::int32_t a = pack.a[lane], b = pack.b[lane];
        of[a].note(impacts.size[lane], bodies[b].mass());
        of[b].note(impacts.size[lane], bodies[a].mass());
    }
}

} // namespace

SphereAssembly::SphereAssembly(
    ContactNetwork& network, const State& state, const Model& model, const StepConstants& step)
    : network_(network), state_(state), model_(model), step_(step)
{
    std::vector<SpherePlace>& places = network.contacts.places;
    std::vector<double>& reaches = network.contacts.reaches;
#pragma omp parallel for schedule(static) if (state.count() > 1000)
    for (std::size_t i = 0; i < state.count(); ++i) {
        places[i] = place_of(state, i);
        reaches[i] = reach_of(state, i, step);
    }
    spheres_ = {places.data(), reaches.data(), state.material.data(),
        static_cast<std::int32_t>(model.materials.list.size()),
        reinterpret_cast<const double*>(model.materials.laws.data()), nullptr};
}

ContactSurvey SphereAssembly::assemble(std::size_t tile)
{
    const Tile& own = network_.list.tiles.tiles[tile];
    TileContacts& contacts = network_.contacts.spheres[tile];
    SphereNumbers spheres = spheres_;
    spheres.carried = reinterpret_cast<const double*>(own.carried.contact.data());
    place(own, spheres, contacts);
    return make(own, spheres, contacts);
}

/// Those within reach, and those that are loaded: these have something to forget.
void SphereAssembly::place(const Tile& tile, const SphereNumbers& spheres, TileContacts& contacts)
{
    AssemblyRoom& room = network_.contacts.room();
    room.near.resize(std::max<std::size_t>(room.near.size(), tile.pairs.size() + 1));
    const std::size_t count = kernel_.find_near(reinterpret_cast<const std::int32_t*>(tile.pairs.data()),
        static_cast<std::uint32_t>(tile.pairs.size()), spheres, step_, room.near.data());
    room.filler.begin(contacts, state_.count());
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t slot = room.near[i];
        const auto [a, b] = tile.pairs[slot];
        contacts.place(room.filler.place(a, b), a, b, slot);
    }
}

ContactSurvey SphereAssembly::make(const Tile& tile, const SphereNumbers& spheres, TileContacts& contacts)
{
    TouchSums sums;
    double attraction_energy = 0.0;
    for (std::size_t p = 0; p < contacts.packs(); ++p) {
        const PackImpacts impacts = kernel_.touch_spheres(contacts.pack(p), contacts.record(p), sums, spheres, step_);
        if (contacts.has_rolling()) make_rolling_rows(contacts, p, false, tile.carried.rolling_impulse, state_, model_);
        if (contacts.has_attraction())
            attraction_energy += find_attractions(contacts, p, false, tile.carried, state_, model_, step_.law.h);
        note_impacts(contacts.pack(p), impacts, state_.bodies, network_.contacts.impacts);
    }
    return survey_of(sums, attraction_energy);
}

} // namespace talus
