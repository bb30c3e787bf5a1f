// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contacts/attractions.hpp"

#include "core/candidates/tile_crew.hpp"
#include "core/law/attraction.hpp"
#include "core/law/thresholds.hpp"

#include <algorithm>

namespace talus
{
namespace
{

const Attraction& law_of(
    const TileContacts& contacts, std::size_t k, bool with_walls, const State& state, const Model& model)
{
    const std::int32_t b = contacts.b(k);
    return model.materials.attraction(
        state.material[contacts.a(k)], with_walls ? model.walls[b].material : state.material[b]);
}

AttractionOfPair pair_of(
    const TileContacts& contacts, std::size_t k, bool with_walls, const State& state, const Model& model)
{
    const std::int32_t a = contacts.a(k), b = contacts.b(k);
    const double r = state.radius[a], reduced_radius = with_walls ? r : r * state.radius[b] / (r + state.radius[b]);
    const double mass = with_walls ? state.mass(a) : std::min(state.mass(a), state.mass(b));
    return {law_of(contacts, k, with_walls, state, model), reduced_radius, mass * model.gravity.norm()};
}

/// Whether the two of a contact have touched, and not been out of range since.
bool is_attached(
    const TileContacts& contacts, std::size_t k, const CarriedContact& carried, double range, const Model& model)
{
    const bool have_touched = carried.attached || contacts.touch(k).last() != TouchRecord::unloaded ||
                              contacts.gap(k) <= touching_gap * model.min_diameter;
    return have_touched && contacts.gap(k) <= range;
}

} // namespace

double find_attractions(TileContacts& contacts, std::size_t pack, bool with_walls, const CarriedImpulses& carried,
    const State& state, const Model& model, double h)
{
    double energy = 0.0;
    for (std::size_t lane = 0; lane < pack_size; ++lane) {
        const std::size_t k = pack_size * pack + lane;
        contacts.set_attraction(k, 0.0);
        if (!contacts.record(pack).holds(lane)) continue;
        const double range = law_of(contacts, k, with_walls, state, model).range;
        if (range == 0.0 || !is_attached(contacts, k, carried.contact[contacts.slot(k)], range, model)) continue;
        const AttractionOfPair pair = pair_of(contacts, k, with_walls, state, model);
        contacts.set_attraction(k, h * pair.force(contacts.gap(k)));
        energy += pair.energy(contacts.gap(k));
    }
    return energy;
}

void apply_attractions(const ContactNetwork& network, std::vector<Body>& bodies)
{
    const auto attract = [&](const TileContacts& contacts, bool with_walls) {
        for (const std::size_t k : contacts.indices()) {
            const Vec3 impulse = contacts.attraction(k) * contacts.normal(k);
            Body& a = bodies[contacts.a(k)];
            a.velocity -= a.inverse_mass * impulse;
            if (with_walls) continue;
            Body& b = bodies[contacts.b(k)];
            b.velocity += b.inverse_mass * impulse;
        }
    };
    const StepContacts& contacts = network.contacts;
    with_tile_crew(network.list.tiles, [&](TileCrew& crew) {
        crew.color_by_color([&](std::size_t tile) {
            attract(contacts.spheres[tile], false);
            attract(contacts.walls[tile], true);
        });
    });
    attract(contacts.pistons, true);
}

std::vector<WallLoad> attractions_of_pistons(const ContactNetwork& network, const Model& model)
{
    std::vector<WallLoad> loads(model.pistons.size());
    const TileContacts& contacts = network.contacts.pistons;
    for (const std::size_t k : contacts.indices()) {
        const Vec3 impulse = contacts.attraction(k) * contacts.normal(k);
        WallLoad& load = loads[static_cast<std::size_t>(model.walls[contacts.b(k)].piston)];
        load.impulse += impulse;
        load.torque += network.contacts.piston_arms[k].cross(impulse);
    }
    return loads;
}

} // namespace talus
