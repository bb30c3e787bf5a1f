// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/deep_beds/position_pass.hpp"

#include "core/candidates/tile_crew.hpp"
#include "core/law/thresholds.hpp"

#include <numeric>

namespace talus
{
namespace
{

void separate_spheres(const Contact& c, State& state, const Periodicity& periodicity)
{
    const double a = state.body(c.a).inverse_mass, b = state.body(c.b).inverse_mass;
    const Vec3 across = periodicity.nearest_image(state.position[c.a] - state.position[c.b]);
    const double distance = across.norm();
    const double overlap = state.radius[c.a] + state.radius[c.b] - distance;
    if (overlap <= 0.0) return;
    const Vec3 normal = distance > 0.0 ? Vec3(across / distance) : c.normal;
    const Vec3 shift = projected_share * overlap / (a + b) * normal;
    state.position[c.a] += a * shift;
    state.position[c.b] -= b * shift;
}

/// The wall is taken for flat within a step: its gap is n·x less the level found when the step began. Returns by what
/// the sphere was moved [m].
Vec3 separate_from_wall(const Contact& c, State& state)
{
    const double overlap = c.wall_level - c.normal.dot(state.position[c.a]);
    if (overlap <= 0.0) return Vec3::Zero();
    const Vec3 shift = projected_share * overlap * c.normal;
    state.position[c.a] += shift;
    return shift;
}

/// The level of a piston's surface goes with it. Returns what gravity and the piston's load hold more of both [J].
double separate_from_piston(const Contact& c, const PlacedWall& began, const Model& model, State& state)
{
    const Piston& piston = model.pistons[began.wall().piston];
    const double overlap = c.wall_level + c.normal.dot(way_of(began, model, state) - state.position[c.a]);
    if (overlap <= 0.0) return 0.0;
    const double along_guide = c.normal.dot(piston.guide);
    const double inverse_mass = state.body(c.a).inverse_mass;
    const double piston_inverse_mass = piston.is_free(state.time) ? 1.0 / piston.mass : 0.0;
    const double shift = projected_share * overlap / (inverse_mass + along_guide * along_guide * piston_inverse_mass);
    state.position[c.a] += inverse_mass * shift * c.normal;
    const Vec3 back = piston_inverse_mass * shift * along_guide * piston.guide;
    state.pistons[began.wall().piston].pose.shift -= back;
    return (piston.mass * model.gravity + piston.load_at(state.time) * piston.guide).dot(back) -
           shift * model.gravity.dot(c.normal);
}

} // namespace

double project_positions(
    const ContactNetwork& network, State& state, const Model& model, const std::vector<PlacedWall>& walls)
{
    if (model.solver.stabilisation != Stabilisation::projected) return 0.0;
    std::vector<double> lifted(network.contacts.walls.size()); // two spheres keep their centre of mass
    const auto separate = [&](std::size_t tile) {
        const TileContacts &spheres = network.contacts.spheres[tile], &at_walls = network.contacts.walls[tile];
        for (const std::size_t k : spheres.indices()) separate_spheres(spheres.contact(k), state, model.periodicity);
        for (const std::size_t k : at_walls.indices()) {
            const Vec3 shift = separate_from_wall(at_walls.contact(k), state);
            lifted[tile] -= state.mass(at_walls.a(k)) * model.gravity.dot(shift);
        }
    };
    with_tile_crew(network.list.tiles, [&](TileCrew& crew) { crew.color_by_color(separate); });

    double sum = std::accumulate(lifted.begin(), lifted.end(), 0.0);
    const TileContacts& pistons = network.contacts.pistons;
    for (const std::size_t k : pistons.indices())
        sum += separate_from_piston(pistons.contact(k), walls[pistons.b(k)], model, state);
    return sum;
}

} // namespace talus
