// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/position_projection.hpp"

#include "core/solver/tile_crew.hpp"

#include <numeric>

namespace talus
{
namespace
{

constexpr double deepest_in_wall = 0.25; ///< smallest diameters

void separate_spheres(const Contact& c, State& state, const Periodicity& periodicity, double share)
{
    const Motion& a = state.motion[c.a];
    const Motion& b = state.motion[c.b];
    const Vec3 across = periodicity.nearest_image(state.position[c.a] - state.position[c.b]);
    const double distance = across.norm();
    const double overlap = a.radius + b.radius - distance;
    if (overlap <= 0.0) return;
    const Vec3 normal = distance > 0.0 ? Vec3(across / distance) : c.normal;
    const Vec3 shift = share * overlap / (a.inverse_mass + b.inverse_mass) * normal;
    state.position[c.a] += a.inverse_mass * shift;
    state.position[c.b] -= b.inverse_mass * shift;
}

/// The wall is taken for flat within a step: its gap is n·x less the level found when the step began. Returns by what
/// the sphere was moved [m].
Vec3 separate_from_wall(const Contact& c, double wall_level, State& state, double share)
{
    const double overlap = wall_level - c.normal.dot(state.position[c.a]);
    if (overlap <= 0.0) return Vec3::Zero();
    const Vec3 shift = share * overlap * c.normal;
    state.position[c.a] += shift;
    return shift;
}

/// How far a piston has come since the step began. @param began how its wall stood then
Vec3 way_of(const Piston& piston, const PlacedWall& began, const State& state)
{
    return state.pistons[began.wall().piston].pose(piston.center) - began.pose()(piston.center);
}

/// The level of a piston's surface goes with it. Returns what gravity and the piston's load hold more of both [J].
double separate_from_piston(const Vec3& gravity, const Contact& c, double wall_level, const Piston& piston,
    const PlacedWall& began, State& state, double share)
{
    const double overlap = wall_level + c.normal.dot(way_of(piston, began, state) - state.position[c.a]);
    if (overlap <= 0.0) return 0.0;
    const double along_guide = c.normal.dot(piston.guide);
    const double inverse_mass = state.motion[c.a].inverse_mass;
    const double piston_inverse_mass = piston.is_free(state.time) ? 1.0 / piston.mass : 0.0;
    const double shift = share * overlap / (inverse_mass + along_guide * along_guide * piston_inverse_mass);
    state.position[c.a] += inverse_mass * shift * c.normal;
    const Vec3 back = piston_inverse_mass * shift * along_guide * piston.guide;
    state.pistons[began.wall().piston].pose.shift -= back;
    return (piston.mass * gravity + piston.load_at(state.time) * piston.guide).dot(back) -
           shift * gravity.dot(c.normal);
}

} // namespace

double project_positions(
    const ContactNetwork& network, State& state, const Model& model, const std::vector<PlacedWall>& walls, double share)
{
    std::vector<double> lifted(network.contacts.walls.size()); // two spheres keep their centre of mass
    const auto separate = [&](std::size_t tile) {
        const TileContacts &spheres = network.contacts.spheres[tile], &at_walls = network.contacts.walls[tile];
        for (const std::size_t k : spheres.indices())
            separate_spheres(spheres.contact(k), state, model.periodicity, share);
        for (const std::size_t k : at_walls.indices()) {
            const Contact c = at_walls.contact(k);
            const Vec3 shift = separate_from_wall(c, at_walls.geometry(k).wall_level, state, share);
            lifted[tile] -= state.mass(c.a) * model.gravity.dot(shift);
        }
    };
    with_tile_crew(network.list.tiles, [&](TileCrew& crew) { crew.color_by_color(separate); });

    double sum = std::accumulate(lifted.begin(), lifted.end(), 0.0);
    const TileContacts& pistons = network.contacts.pistons;
    for (const std::size_t k : pistons.indices()) {
        const Contact c = pistons.contact(k);
        const PlacedWall& wall = walls[c.b];
        sum += separate_from_piston(
            model.gravity, c, pistons.geometry(k).wall_level, model.pistons[wall.wall().piston], wall, state, share);
    }
    return sum;
}

double hold_at_walls(
    const ContactNetwork& network, State& state, const Model& model, const std::vector<PlacedWall>& walls)
{
    double lifted = 0.0;
    const double deepest = deepest_in_wall * model.min_diameter;
    const auto hold = [&](const Contact& c, double wall_level) {
        const double overlap = wall_level - c.normal.dot(state.position[c.a]);
        if (overlap <= deepest) return;
        const Vec3 shift = (overlap - deepest) * c.normal;
        state.position[c.a] += shift;
        lifted -= state.mass(c.a) * model.gravity.dot(shift);
    };
    for (const TileContacts& at_walls : network.contacts.walls)
        for (const std::size_t k : at_walls.indices()) hold(at_walls.contact(k), at_walls.geometry(k).wall_level);
    const TileContacts& pistons = network.contacts.pistons;
    for (const std::size_t k : pistons.indices()) {
        const Contact c = pistons.contact(k);
        const PlacedWall& began = walls[c.b];
        const Vec3 way = way_of(model.pistons[began.wall().piston], began, state);
        hold(c, pistons.geometry(k).wall_level + c.normal.dot(way));
    }
    return lifted;
}

} // namespace talus
