// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/builder/closing_speed.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus
{
namespace
{

/// Velocities of a rigid body at an instant: V + Ω × (x − point).
struct RigidVelocity {
    Vec3 velocity = Vec3::Zero(); ///< [m/s]
    Vec3 spin = Vec3::Zero();     ///< [rad/s]
    Vec3 point = Vec3::Zero();    ///< [m]

    Vec3 at(const Vec3& x) const { return velocity + spin.cross(x - point); }
};

/// Those of a part of a motion at the instants at which it is fastest.
std::vector<RigidVelocity> velocities_of(const MotionPart& part)
{
    if (const auto* translation = std::get_if<Translation>(&part)) return {{translation->velocity}};
    if (const auto* turning = std::get_if<Turning>(&part))
        return {{Vec3::Zero(), turning->rate * turning->axis, turning->point}};
    if (const auto* shaking = std::get_if<Shaking>(&part))
        return {{2.0 * std::numbers::pi * shaking->frequency * shaking->amplitude}};
    std::vector<RigidVelocity> list;
    const auto& waypoints = std::get<Course>(part).waypoints;
    for (std::size_t k = 1; k < waypoints.size(); ++k)
        list.push_back({(waypoints[k].shift - waypoints[k - 1].shift) / (waypoints[k].time - waypoints[k - 1].time)});
    return list;
}

/// How fast a surface moves along its normal, at most [m/s].
struct NormalSpeed {
    const RigidVelocity& v;
    const Box& spheres; ///< where they are: a plane is looked at there

    double at_corners(const Box& box, const Vec3& normal) const
    {
        double fastest = 0.0;
        if (!box.empty())
            for (const Vec3& x : box.corners()) fastest = std::max(fastest, std::abs(normal.dot(v.at(x))));
        return fastest;
    }

    double operator()(const Plane& plane) const { return at_corners(spheres, plane.normal); }

    double operator()(const Disk& disk) const
    {
        return std::abs(disk.normal.dot(v.at(disk.center))) + disk.radius * disk.normal.cross(v.spin).norm();
    }

    /// A tube or funnel moves along its normals with its axis, and where the axis turns at its ends.
    double of_round(const Vec3& base, const Vec3& axis, double height, double radius, double slope) const
    {
        double fastest = 0.0;
        for (const double along : {0.0, height}) {
            const Vec3 w = v.at(base + along * axis), across = w - w.dot(axis) * axis;
            fastest = std::max(fastest, across.norm() + slope * std::abs(w.dot(axis)));
        }
        return fastest + slope * radius * axis.cross(v.spin).norm();
    }

    double operator()(const Cylinder& tube) const
    {
        return of_round(tube.base, tube.axis, tube.height, tube.radius, 0.0);
    }

    double operator()(const Cone& cone) const
    {
        const double narrowing = std::abs(cone.top_radius - cone.base_radius);
        return of_round(cone.base, cone.axis, cone.height, std::max(cone.base_radius, cone.top_radius),
            narrowing / std::hypot(narrowing, cone.height));
    }

    double operator()(const Panels& panels) const
    {
        double fastest = 0.0;
        for (const auto& [corner, a, b] : panels.rectangles) {
            const Vec3 normal = a.cross(b).normalized();
            for (const Vec3& x : {corner, Vec3(corner + a), Vec3(corner + b), Vec3(corner + a + b)})
                fastest = std::max(fastest, std::abs(normal.dot(v.at(x))));
        }
        return fastest;
    }

    double operator()(const Mesh& mesh) const
    {
        double fastest = 0.0;
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
            for (const auto k : mesh.triangles[t])
                fastest =
                    std::max(fastest, std::abs(mesh.normals[t].dot(v.at(mesh.vertices[static_cast<std::size_t>(k)]))));
        return fastest;
    }

    double operator()(const Grains& grains) const
    {
        double fastest = 0.0;
        for (const Vec3& x : grains.centers) fastest = std::max(fastest, v.at(x).norm());
        return fastest;
    }
};

/// What all walls share: the velocity with which the scene moves past its frame [m/s].
Vec3 common_velocity(const Model& model)
{
    const auto velocity_of = [](const Wall& wall) -> Vec3 {
        const auto* translation = wall.motion.size() == 1 ? std::get_if<Translation>(&wall.motion[0]) : nullptr;
        return translation ? translation->velocity : Vec3::Zero();
    };
    if (model.walls.empty()) return Vec3::Zero();
    const Vec3 first = velocity_of(model.walls[0]);
    const bool shared = std::ranges::all_of(model.walls, [&](const Wall& w) { return velocity_of(w) == first; });
    return shared ? first : Vec3::Zero();
}

/// Velocities of spheres and of what is poured as they begin.
struct Starts {
    Vec3 mean = Vec3::Zero(); ///< [m/s]
    double apart = 0.0;       ///< the most that one differs from the mean [m/s]
    double highest = 0.0;     ///< of a point of a sphere, its spin included [m/s]

    explicit Starts(const Simulation& simulation)
    {
        std::vector<Vec3> all;
        const auto add = [&](const Vec3& velocity, double rim) {
            all.push_back(velocity);
            mean += velocity;
            highest = std::max(highest, velocity.norm() + rim);
        };
        for (const Body& body : simulation.state.bodies) add(body.velocity, body.rim_velocity.norm());
        for (const Pour& pour : simulation.pours) add(pour.velocity, 0.0);
        mean /= std::max(1.0, static_cast<double>(all.size()));
        for (const Vec3& v : all) apart = std::max(apart, (v - mean).norm());
    }
};

/// What a piston would have if all it weighs and bears drove it across the whole scene [m/s].
double fastest_piston(const Simulation& simulation)
{
    const Model& model = simulation.model;
    Box scene;
    for (const Wall& wall : model.walls) scene.extend(bounds(wall.shape));
    for (const Vec3& x : simulation.state.position) scene.extend(x);
    double fastest = 0.0;
    for (const Piston& piston : model.pistons) {
        const double gain = piston.most_force(model.gravity) / piston.mass;
        fastest = std::max(fastest, std::sqrt(2.0 * gain * scene.extent().dot(piston.guide.cwiseAbs())));
    }
    return fastest;
}

/// How far anything can fall: along gravity through all that the scene has, outlets and bounds included [m].
double longest_fall(const Model& model)
{
    Box scene = model.contents;
    for (int d = 0; d < 3; ++d) {
        if (std::isfinite(model.world.min[d])) scene.min[d] = std::min(scene.min[d], model.world.min[d]);
        if (std::isfinite(model.world.max[d])) scene.max[d] = std::max(scene.max[d], model.world.max[d]);
    }
    return scene.extent().dot(model.up().cwiseAbs());
}

} // namespace

SceneSpeeds scene_speeds(const Simulation& simulation, const Bed& bed)
{
    const Model& model = simulation.model;
    const Starts starts(simulation);
    Box spheres;
    for (const Vec3& x : simulation.state.position) spheres.extend(x);
    for (const Pour& pour : simulation.pours) spheres.extend(pour.region.bounds());

    const Vec3 common = common_velocity(model);
    const RigidVelocity onto_walls{starts.mean - common};
    double together = 0.0, walls = 0.0, highest = starts.highest;
    for (const Wall& wall : model.walls) {
        together = std::max(together, std::visit(NormalSpeed{onto_walls, spheres}, wall.shape));
        const Box own_box = bounds(wall.shape);
        const Box& box = own_box.empty() ? spheres : own_box;
        for (const MotionPart& part : wall.motion)
            for (RigidVelocity v : velocities_of(part)) {
                for (const Vec3& x : box.empty() ? std::array<Vec3, 8>{} : box.corners())
                    highest = std::max(highest, v.at(x).norm());
                v.velocity -= common;
                walls = std::max(walls, std::visit(NormalSpeed{v, spheres}, wall.shape));
            }
    }

    const double gravity = std::abs(model.gravity.dot(model.up())), piston = fastest_piston(simulation);
    const auto after = [&](double speed, double fall) { return std::sqrt(speed * speed + 2.0 * gravity * fall); };
    // With gravity pistons are too fast for its step for moments only, in which steps are split.
    return {after(starts.apart + together, bed.landing) + walls + (model.gravity.isZero() ? piston : 0.0),
        after(highest, longest_fall(model)) + piston};
}

} // namespace talus
