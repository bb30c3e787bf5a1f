// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/builder/bed.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace talus
{
namespace
{

constexpr double heap_slope = 0.6;       ///< tangent of what a heap without walls stands at, at most
constexpr double lateral_pressure = 0.5; ///< K, of the vertical one
constexpr double snug = 1.5;             ///< times a bed's width: what is wider does not carry it

/// The axis along which gravity acts most; the other two are level.
int upright_axis(const Vec3& up)
{
    Eigen::Index axis = 2;
    up.cwiseAbs().maxCoeff(&axis);
    return static_cast<int>(axis);
}

/// The area of a box as seen from above [m²].
double area_across(const Box& box, const Vec3& up)
{
    const Vec3 u = up.cwiseAbs(), e = box.extent();
    return u.x() * e.y() * e.z() + u.y() * e.z() * e.x() + u.z() * e.x() * e.y();
}

double top_of(const Box& box, const Vec3& up)
{
    return box.center().dot(up) + 0.5 * box.extent().dot(up.cwiseAbs());
}

double bottom_of(const Box& box, const Vec3& up)
{
    return box.center().dot(up) - 0.5 * box.extent().dot(up.cwiseAbs());
}

/// Whether one box surrounds another but for its ends along an axis.
bool surrounds(const Box& outer, const Box& inner, int axis)
{
    for (int d = 0; d < 3; ++d)
        if (d != axis && (outer.min[d] > inner.min[d] || outer.max[d] < inner.max[d])) return false;
    return !outer.empty();
}

/// The volume of a scene's spheres, the room in which they are put, and their masses.
struct Contents {
    double filled = 0.0, poured = 0.0;          ///< volumes of spheres [m³]
    Box fills, pours;                           ///< [m]
    double lightest = infinity, heaviest = 0.0; ///< [kg]

    void add_mass(double mass)
    {
        lightest = std::min(lightest, mass);
        heaviest = std::max(heaviest, mass);
    }
};

Contents contents_of(const Simulation& simulation)
{
    const State& state = simulation.state;
    const Materials& materials = simulation.model.materials;
    Contents all;
    for (std::size_t i = 0; i < state.count(); ++i) {
        all.filled += volume_of_sphere(2.0 * state.radius[i]);
        all.fills.extend(Box{state.position[i], state.position[i]}.grown(state.radius[i]));
        all.add_mass(state.mass(i));
    }
    for (const Pour& source : simulation.pours) {
        all.poured += expected_count(source, materials) * volume_of_sphere(source.mixture.mean_diameter());
        all.pours.extend(source.region.bounds());
        for (const Species& species : source.mixture.species) {
            const double density = materials.list[static_cast<std::size_t>(species.material)].density;
            all.add_mass(density * volume_of_sphere(source.mixture.min_diameter()));
            all.add_mass(density * volume_of_sphere(source.mixture.max_diameter()));
        }
    }
    return all;
}

/// How high what is poured piles up: as a heap, or as high as the narrowest walls round the pour make it [m].
double poured_depth(const Contents& all, const Model& model)
{
    if (all.poured == 0.0) return 0.0;
    const Vec3 up = model.up();
    const double room = all.poured / packed_share;
    double depth = std::cbrt(3.0 * heap_slope * heap_slope / std::numbers::pi * room);
    for (const Wall& wall : model.walls) {
        const Box box = bounds(wall.shape);
        if (surrounds(box, all.pours, upright_axis(up)))
            depth = std::max(depth, std::min(room / area_across(box, up), box.extent().dot(up.cwiseAbs())));
    }
    return depth;
}

/// The least friction of any sphere of these materials with a wall.
double friction_with(const Wall& wall, const std::set<int>& spheres, const Materials& materials)
{
    double least = infinity;
    for (const int a : spheres) least = std::min(least, materials.between(a, wall.material).friction);
    return least;
}

/// Whether a wall stands beside a room across an axis, on either side, with a sphere's room to spare.
bool stands_beside(const Wall& wall, const Box& room, int axis, double diameter)
{
    if (const auto* plane = std::get_if<Plane>(&wall.shape)) return std::abs(plane->normal[axis]) > 0.7;
    const Box box = bounds(wall.shape);
    return !box.empty() && box.meets(room) && box.extent()[axis] <= snug * room.extent()[axis] + 2.0 * diameter;
}

/// Λ = D/(4 K μ) of a room with rough walls on all its sides that are not periodic, D four times its area by its
/// perimeter, in mean diameters; else infinite.
double screening_length(const Simulation& simulation, const Box& room)
{
    const Model& model = simulation.model;
    const std::set<int> spheres = sphere_materials(simulation);
    const int upright = upright_axis(model.up());
    double area = 1.0, perimeter = 0.0, friction = infinity;
    for (int d = 0; d < 3; ++d) {
        if (d == upright) continue;
        const int other = 3 - upright - d;
        area *= room.extent()[d];
        if (model.periodicity.along(d)) continue;
        double beside = 0.0;
        for (const Wall& wall : model.walls)
            if (!wall.is_piston() && stands_beside(wall, room, d, model.max_diameter))
                beside = std::max(beside, friction_with(wall, spheres, model.materials));
        friction = std::min(friction, beside);
        perimeter += 2.0 * room.extent()[other];
    }
    if (perimeter == 0.0 || friction == 0.0) return infinity;
    return area / (perimeter * lateral_pressure * friction) / model.mean_diameter;
}

/// Where a plane stands below a box, at the lowest.
double level_below(const Plane& plane, const Box& box, const Vec3& up)
{
    double level = infinity;
    for (const Vec3& x : box.corners())
        level = std::min(level, x.dot(up) - plane.normal.dot(x - plane.point) / plane.normal.dot(up));
    return level;
}

/// How far a sphere may fall until it lands on a wall or on what came before it [m]. Outlets and the end of the world
/// are no landing.
double landing_of(const Simulation& simulation, const Contents& all)
{
    const Model& model = simulation.model;
    if (model.gravity.isZero()) return 0.0;
    constexpr double level = 0.1; // cosine: what is steeper bears nothing
    const Vec3 up = model.up();
    Box spheres = all.fills, scene = all.fills;
    spheres.extend(all.pours);
    double lowest = infinity;
    for (const Wall& wall : model.walls) {
        const Box box = bounds(wall.shape);
        if (const auto* plane = std::get_if<Plane>(&wall.shape)) {
            if (plane->normal.dot(up) > level) lowest = std::min(lowest, level_below(*plane, spheres, up));
        } else {
            lowest = std::min(lowest, bottom_of(box, up));
            scene.extend(box);
        }
    }
    double fall = 0.0;
    if (!all.pours.empty()) fall = top_of(all.pours, up) - lowest;
    if (!all.fills.empty()) {
        const double bed = all.filled / packed_share / area_across(scene, up);
        fall = std::max({fall, top_of(all.fills, up) - lowest - bed, bottom_of(all.fills, up) - lowest});
    }
    return std::max(0.0, fall);
}

double acceleration_of(const MotionPart& part, const Box& box)
{
    if (const auto* shaking = std::get_if<Shaking>(&part))
        return shaking->amplitude.norm() * std::pow(2.0 * std::numbers::pi * shaking->frequency, 2);
    double arm = 0.0;
    const auto* turning = std::get_if<Turning>(&part);
    if (!turning || box.empty()) return 0.0;
    for (const Vec3& x : box.corners()) arm = std::max(arm, turning->axis.cross(x - turning->point).norm());
    return turning->rate * turning->rate * arm;
}

/// The most that a piston presses on what fills this room, with its weight and its load [Pa].
double surcharge_of(const Model& model, const Box& room)
{
    double pressure = 0.0;
    for (const Piston& piston : model.pistons)
        pressure = std::max(pressure, piston.most_force(model.gravity) / area_across(room, piston.guide));
    return pressure;
}

} // namespace

double volume_of_sphere(double diameter)
{
    return std::numbers::pi / 6.0 * std::pow(diameter, 3);
}

std::set<int> sphere_materials(const Simulation& simulation)
{
    std::set<int> materials(simulation.state.material.begin(), simulation.state.material.end());
    for (const auto& pour : simulation.pours)
        for (const auto& species : pour.mixture.species) materials.insert(species.material);
    return materials;
}

double Bed::borne_depth() const
{
    const double z = measures.depth / screening_length;
    return z < 1e-3 ? measures.depth : 2.0 * screening_length * (1.0 - (1.0 - std::exp(-z)) / z);
}

Bed measure_bed(const Simulation& simulation)
{
    const Model& model = simulation.model;
    const Vec3 up = model.up();
    const Contents all = contents_of(simulation);
    Box room = all.fills;
    room.extend(all.pours);
    Bed bed;
    if (room.empty()) return bed;
    if (!model.gravity.isZero()) {
        const double filled = all.fills.empty() ? 0.0 : all.filled / packed_share / area_across(all.fills, up);
        bed.measures.depth = (filled + poured_depth(all, model)) / model.mean_diameter;
        bed.measures.mass_ratio = all.heaviest / all.lightest;
        bed.landing = landing_of(simulation, all);
    }
    double heaviest = all.heaviest;
    for (const Piston& piston : model.pistons) heaviest = std::max(heaviest, piston.mass);
    bed.measures.body_ratio = heaviest / all.lightest;
    bed.screening_length = screening_length(simulation, room);
    bed.surcharge = surcharge_of(model, room);
    for (const Wall& wall : model.walls)
        for (const MotionPart& part : wall.motion)
            bed.wall_acceleration = std::max(bed.wall_acceleration, acceleration_of(part, room));
    return bed;
}

} // namespace talus
