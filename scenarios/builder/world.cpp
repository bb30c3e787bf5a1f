// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/builder/world.hpp"

#include "core/supply/diameters.hpp"
#include "scenarios/builder/checks.hpp"

#include <algorithm>
#include <cmath>

namespace talus
{

void find_diameters(Model& model, const std::vector<Fill>& fills, const std::vector<Pour>& pours)
{
    Diameters diameters;
    for (const Fill& fill : fills) {
        for (const auto& [center, radius, material] : fill.listed) diameters.add(2.0 * radius);
        if (!fill.is_list()) diameters.add(fill.mixture, static_cast<double>(fill.count));
    }
    for (const Pour& pour : pours) diameters.add(pour.mixture, expected_count(pour, model.materials));
    if (diameters.count == 0.0)
        throw SceneError("fill", "the scene has no spheres: give a [[fill]] or a [[pour]] with a count above 0");
    diameters.put_into(model);
}

Periodicity build_periodicity(const scene::WorldTable& table, double max_diameter)
{
    // Diameters. At 2 a sphere would meet two images of another; some slack is for open contacts, and for the radii
    // that files of spheres round to 32 bits.
    constexpr double shortest = 2.2 * (1.0 - 1e-6);
    Periodicity periodicity;
    for (const auto& name : table.periodic) {
        if (std::ranges::count(table.periodic, name) > 1)
            throw SceneError("world.periodic", "the axis " + name + " is there twice");
        const int d = name[0] - 'x';
        const double length = table.max[d] - table.min[d];
        if (!std::isfinite(length))
            throw SceneError("world.periodic", "along the periodic axis " + name + " 'min' and 'max' must be given");
        if (length < shortest * max_diameter)
            throw SceneError("world.periodic",
                "along the periodic axis " + name + " the world must be at least 2.2 diameters of the largest sphere");
        periodicity.origin[d] = table.min[d];
        periodicity.length[d] = length;
    }
    return periodicity;
}

namespace
{

/// Where a wall is during the run.
std::vector<Pose> poses_of(const Wall& wall, double duration)
{
    if (wall.motion.empty()) return {Pose{}};
    constexpr int samples = 200;
    std::vector<Pose> poses;
    for (int k = 0; k <= samples; ++k) poses.push_back(pose_at(wall.motion, duration * k / samples));
    return poses;
}

/// Round all places of a wall during the run; a plane has none and gives an empty box.
Box swept_bounds(const Wall& wall, double duration)
{
    const Box still = bounds(wall.shape);
    Box swept;
    if (!still.empty())
        for (const Pose& pose : poses_of(wall, duration)) swept.extend(placed(pose, still));
    return swept;
}

/// Takes the levels of a plane in where it stands across an axis, and opens the sides to which spheres may roll on it.
void take_in(Box& box, const Wall& wall, const Vec3& gravity, double duration)
{
    const auto* plane = std::get_if<Plane>(&wall.shape);
    if (!plane) return;
    constexpr double across = 1.0 - 1e-9;
    const bool bears = plane->normal.dot(gravity) < 0.0;
    for (int d = 0; d < 3; ++d) {
        if (std::abs(plane->normal[d]) > across) {
            for (const Pose& pose : poses_of(wall, duration)) {
                const double level = pose(plane->point)[d];
                box.min[d] = std::min(box.min[d], level);
                box.max[d] = std::max(box.max[d], level);
            }
        } else if (bears && gravity[d] == 0.0) {
            box.min[d] = -infinity;
            box.max[d] = infinity;
        }
    }
}

/// Something that lies in the scene, and the key that says where.
struct Content {
    std::string key;
    Box bounds;
};

/// Walls, on their ways so far, fills, pours and outlets.
std::vector<Content> contents(
    const Model& model, const std::vector<Fill>& fills, const std::vector<Pour>& pours, double duration)
{
    std::vector<Content> list;
    for (std::size_t k = 0; k < model.walls.size(); ++k)
        if (const Box b = swept_bounds(model.walls[k], duration); !b.empty())
            list.push_back({key_path("wall", k, "name"), b});
    for (const Fill& fill : fills) {
        if (!fill.is_list()) list.push_back({fill.key + ".region", fill.region.bounds()});
        for (const PackedSphere& sphere : fill.listed)
            list.push_back({fill.key + ".file", Box{sphere.center, sphere.center}});
    }
    for (std::size_t k = 0; k < pours.size(); ++k)
        list.push_back({key_path("pour", k, "region"), pours[k].region.bounds()});
    for (std::size_t k = 0; k < model.outlets.size(); ++k)
        list.push_back({key_path("outlet", k, "region"), model.outlets[k].bounds()});
    return list;
}

Box around(const std::vector<Content>& list)
{
    Box box;
    for (const Content& content : list) box.extend(content.bounds);
    return box;
}

void require_within_reach(const std::vector<Content>& list, double diameter)
{
    for (const Content& content : list) {
        if (!is_within_reach(content.bounds.min, diameter) || !is_within_reach(content.bounds.max, diameter))
            throw SceneError(content.key, "it reaches more than 1e9 diameters from the origin, where numbers are too "
                                          "coarse for contacts; bring the scene nearer");
    }
}

} // namespace

bool is_within_reach(const Vec3& place, double diameter)
{
    constexpr double farthest = 1e9; // diameters: beyond, places are told apart by 1e-7 of them at best
    return place.cwiseAbs().maxCoeff() <= farthest * diameter;
}

Box build_contents(const Model& model, const std::vector<Fill>& fills, const std::vector<Pour>& pours)
{
    const auto list = contents(model, fills, pours, 0.0);
    require_within_reach(list, model.mean_diameter);
    return around(list);
}

Box build_world(
    const scene::Scene& scene, const Model& model, const std::vector<Fill>& fills, const std::vector<Pour>& pours)
{
    const Vec3 &min = scene.world.min, &max = scene.world.max;
    if (!((min.array() < max.array()).all()))
        throw SceneError("world.max", "the world is empty: every coordinate of 'min' must be below that of 'max'");
    Box box = around(contents(model, fills, pours, scene.time.duration));
    for (const Wall& wall : model.walls) take_in(box, wall, model.gravity, scene.time.duration);
    box = box.grown(5.0 * model.max_diameter);
    for (int d = 0; d < 3; ++d) {
        if (model.gravity[d] < 0.0) box.max[d] = infinity;
        if (model.gravity[d] > 0.0) box.min[d] = -infinity;
        if (std::isfinite(min[d])) box.min[d] = min[d];
        if (std::isfinite(max[d])) box.max[d] = max[d];
    }
    return box;
}

} // namespace talus
