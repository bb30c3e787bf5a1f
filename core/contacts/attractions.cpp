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

/// @param law of its two
AttractionOfPair pair_of(const Attraction& law, const TileContacts& contacts, std::size_t k, bool with_walls,
    const State& state, const Model& model)
{
    const std::int32_t a = contacts.a(k), b = contacts.b(k);
    const double r = state.radius[a], reduced_radius = with_walls ? r : r * state.radius[b] / (r + state.radius[b]);
    const double mass = with_walls ? state.mass(a) : std::min(state.mass(a), state.mass(b));
    return {law, reduced_radius, mass * model.gravity.norm()};
}

/// How the two of a contact lie to each other now, wherever their free paths would meet.
struct Apart {
    Vec3 direction; ///< unit, from b to a
    double gap;     ///< [m]
};

Apart apart(const TileContacts& contacts, std::size_t k, bool with_walls, const State& state, const Model& model)
{
    if (with_walls) return {contacts.normal(k), contacts.gap(k)};
    const std::int32_t a = contacts.a(k), b = contacts.b(k);
    const Vec3 way = model.periodicity.nearest_image(state.position[a] - state.position[b]);
    const double distance = way.norm();
    return {distance > 0.0 ? Vec3(way / distance) : contacts.normal(k), distance - state.radius[a] - state.radius[b]};
}

/// Whether the two of a contact have touched before, or do.
bool have_touched(
    const TileContacts& contacts, std::size_t k, const CarriedContact& carried, double gap, const Model& model)
{
    return carried.attached || contacts.touch(k).last() != TouchRecord::unloaded ||
           gap <= touching_gap * model.min_diameter;
}

} // namespace

double find_attractions(TileContacts& contacts, std::size_t pack, bool with_walls, const CarriedImpulses& carried,
    const State& state, const Model& model, double h)
{
    double energy = 0.0;
    for (std::size_t lane = 0; lane < pack_size; ++lane) {
        const std::size_t k = pack_size * pack + lane;
        contacts.set_attraction(k, Vec3::Zero());
        if (!contacts.record(pack).holds(lane)) continue;
        const Attraction& law = law_of(contacts, k, with_walls, state, model);
        if (law.range == 0.0) continue;
        const Apart now = apart(contacts, k, with_walls, state, model);
        if (now.gap > law.range || !have_touched(contacts, k, carried.contact[contacts.slot(k)], now.gap, model))
            continue;
        const AttractionOfPair pair = pair_of(law, contacts, k, with_walls, state, model);
        contacts.set_attraction(k, -h * pair.force(now.gap) * now.direction);
        energy += pair.energy(now.gap);
    }
    return energy;
}

void apply_attractions(const ContactNetwork& network, std::vector<Body>& bodies)
{
    const auto attract = [&](const TileContacts& contacts, bool with_walls) {
        for (const std::size_t k : contacts.indices()) {
            const Vec3 impulse = contacts.attraction(k);
            Body& a = bodies[contacts.a(k)];
            a.velocity += a.inverse_mass * impulse;
            if (with_walls) continue;
            Body& b = bodies[contacts.b(k)];
            b.velocity -= b.inverse_mass * impulse;
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

double attraction_power(const ContactNetwork& network, const State& state, const Model& model)
{
    if (!model.physics.attraction) return 0.0;
    double sum = 0.0;
    const auto add = [&](const TileContacts& contacts, auto&& velocity_of_b) {
        for (const std::size_t k : contacts.indices())
            if (contacts.attracts(k))
                sum += contacts.attraction(k).dot(state.body(contacts.a(k)).velocity - velocity_of_b(k));
    };
    const StepContacts& all = network.contacts;
    for (const TileContacts& tile : all.spheres)
        add(tile, [&](std::size_t k) { return state.body(tile.b(k)).velocity; });
    for (const TileContacts& tile : all.walls)
        add(tile, [&](std::size_t k) { return tile.has_moving_walls() ? tile.wall(k).velocity : Vec3::Zero().eval(); });
    add(all.pistons, [&](std::size_t k) {
        const PistonState& own = state.pistons[static_cast<std::size_t>(model.walls[all.pistons.b(k)].piston)];
        return Vec3(own.velocity + own.spin.cross(all.piston_arms[k]));
    });
    return sum;
}

std::vector<WallLoad> attractions_of_pistons(const ContactNetwork& network, const Model& model)
{
    std::vector<WallLoad> loads(model.pistons.size());
    const TileContacts& contacts = network.contacts.pistons;
    for (const std::size_t k : contacts.indices()) {
        const Vec3 impulse = -contacts.attraction(k);
        WallLoad& load = loads[static_cast<std::size_t>(model.walls[contacts.b(k)].piston)];
        load.impulse += impulse;
        load.torque += network.contacts.piston_arms[k].cross(impulse);
    }
    return loads;
}

} // namespace talus
