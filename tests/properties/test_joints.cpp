// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/properties/as_a_scene.hpp"
#include "tests/properties/draws.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

// A joint where the surface is level is no obstacle: where pieces of a floor, of whatever kind, lie side by side, a
// sphere runs over it as over one piece. A real edge is one.

namespace talus::test
{
namespace
{

constexpr double d = 2 * standard_radius;
constexpr double half = 0.2; ///< of the floors' edges [m]

using Turn = Eigen::Matrix3d;

Stabilisation any_law(Draw& draw)
{
    return draw.chance(0.5) ? Stabilisation::matched : Stabilisation::projected;
}

/// The shape turned about the origin, and then shifted.
Shape placed(const Shape& shape, const Turn& turn, const Vec3& shift)
{
    struct Place {
        const Turn& turn;
        const Vec3& shift;
        Vec3 point(const Vec3& x) const { return turn * x + shift; }
        Shape operator()(const Plane& p) const { return Plane{point(p.point), turn * p.normal}; }
        Shape operator()(const Cylinder& c) const { return Cylinder{point(c.base), turn * c.axis, c.radius, c.height}; }
        Shape operator()(const Disk& k) const
        {
            return Disk{point(k.center), turn * k.normal, k.radius, k.hole_radius};
        }
        Shape operator()(const Panels& p) const
        {
            Panels panels;
            for (const auto& r : p.rectangles)
                panels.rectangles.push_back({point(r.corner), turn * r.edge_a, turn * r.edge_b});
            return panels;
        }
        Shape operator()(const Mesh& m) const
        {
            std::vector<Vec3> vertices;
            for (const Vec3& x : m.vertices) vertices.push_back(point(x));
            return make_mesh(vertices, m.triangles);
        }
        Shape operator()(const Cone& c) const { return c; }
        Shape operator()(const Grains& g) const { return g; }
    };
    return std::visit(Place{turn, shift}, shape);
}

Panels rectangle(double x0, double x1, double y0, double y1, double z = 0.0)
{
    return {{{Vec3(x0, y0, z), Vec3(x1 - x0, 0, 0), Vec3(0, y1 - y0, 0)}}};
}

/// Two triangles, cut along one diagonal or the other.
Mesh quad(double x0, double x1, double y0, double y1, double z, bool rising)
{
    const std::vector<Vec3> corners = {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
    if (rising) return make_mesh(corners, {{0, 1, 2}, {0, 2, 3}});
    return make_mesh(corners, {{0, 1, 3}, {1, 2, 3}});
}

/// One mesh in which a long edge on one side meets several short ones on the other, at corners that it does not have.
Mesh t_junction(Draw& draw)
{
    std::vector<Vec3> v = {{-half, -half, 0}, {0, -half, 0}, {0, half, 0}, {-half, half, 0}};
    std::vector<std::array<std::int32_t, 3>> t = {{0, 1, 2}, {0, 2, 3}};
    double y = -half;
    while (y < half) {
        const double next = std::min(half, y + draw.uniform(0.3, 5) * d);
        const auto k = static_cast<std::int32_t>(v.size());
        v.insert(v.end(), {{0, y, 0}, {half, y, 0}, {half, next, 0}, {0, next, 0}});
        t.push_back({k, k + 1, k + 2});
        t.push_back({k, k + 2, k + 3});
        y = next;
    }
    return make_mesh(v, t);
}

/// A floor z = 0 whose pieces meet at x = 0, or round the origin.
struct Floor {
    std::string name;
    std::vector<Shape> pieces;
    double period = 0.0; ///< along x; 0: it has none
    double down = 0.0;   ///< so much lower the floor is from x = 0 on [m]
};

Floor any_floor(Draw& draw)
{
    switch (draw.integer(0, 15)) {
    case 0: { // as a scene has them
        const Box left{Vec3(-half, -half, -0.1), Vec3(0, half, 0)}, right{Vec3(0, -half, -0.1), Vec3(half, half, 0)};
        return {"two boxes flush", {box_panels(left, {}), box_panels(right, {})}};
    }
    case 1:
        return {"two panels flush", {rectangle(-half, 0, -half, half), rectangle(0, half, -half, half)}};
    case 2: {
        Panels both = rectangle(-half, 0, -half, half);
        both.rectangles.push_back(rectangle(0, half, -half, half).rectangles[0]);
        return {"two panels of one wall", {both}};
    }
    case 3:
        return {"two meshes flush",
            {quad(-half, 0, -half, half, 0, draw.chance(0.5)), quad(0, half, -half, half, 0, draw.chance(0.5))}};
    case 4: {
        const double lap = draw.log_uniform(0.01, 3) * d;
        return {"two meshes that lap over each other",
            {quad(-half, lap, -half, half, 0, draw.chance(0.5)), quad(0, half, -half, half, 0, draw.chance(0.5))}};
    }
    case 5:
        return {"a mesh with T-junctions", {t_junction(draw)}};
    case 6: {
        const double radius = draw.log_uniform(0.3, 5) * d;
        const Vec3 center(radius, 0, 0);
        return {"a disk in the hole of another",
            {Disk{center, Vec3::UnitZ(), radius}, Disk{center, Vec3::UnitZ(), half, radius}}};
    }
    case 7: {
        const double radius = draw.log_uniform(0.3, 5) * d;
        return {"a disk in a plane", {Plane{}, Disk{Vec3(radius, 0, 0), Vec3::UnitZ(), radius}}};
    }
    case 8: {
        Floor floor{"a periodic border across a panel", {rectangle(-half, half, -half, half)}};
        floor.period = 2 * half;
        return floor;
    }
    case 9: {
        Floor floor{"many panels", {}};
        double x = -half;
        while (x < half) {
            const double next = std::min(half, x + draw.uniform(0.2, 2) * d);
            floor.pieces.push_back(rectangle(x, next, -half, half));
            x = next;
        }
        return floor;
    }
    case 10:
        return {"a panel beside a mesh", {rectangle(-half, 0, -half, half), quad(0, half, -half, half, 0, true)}};
    case 11:
        return {"a panel in a plane", {Plane{}, rectangle(0, half, -half, half)}};
    case 12: {
        const double y = draw.uniform(-1, 1) * d;
        return {"four panels round a corner", {rectangle(-half, 0, -half, y), rectangle(0, half, -half, y),
                                                  rectangle(-half, 0, y, half), rectangle(0, half, y, half)}};
    }
    case 13: {
        const double slit = draw.uniform(-1, 1) * 1e-7;
        Mesh both = quad(-half, 0, -half, half, 0, draw.chance(0.5));
        const Mesh right = quad(slit, half, -half, half, 0, draw.chance(0.5));
        for (auto t : right.triangles) both.triangles.push_back({t[0] + 4, t[1] + 4, t[2] + 4});
        both.vertices.insert(both.vertices.end(), right.vertices.begin(), right.vertices.end());
        return {"a mesh whose corners are 0.1 um apart", {make_mesh(both.vertices, both.triangles)}};
    }
    case 14: {
        Floor floor{"a periodic border across a mesh", {quad(-half, half, -half, half, 0, draw.chance(0.5))}};
        floor.period = 2 * half;
        return floor;
    }
    default: {
        const double down = draw.log_uniform(1e-8, 1e-6);
        return {
            "a step down", {quad(-half, 0, -half, half, 0, true), quad(0, half, -half, half, -down, true)}, 0, down};
    }
    }
}

/// How a sphere is sent over a joint.
struct Run {
    Stabilisation law = Stabilisation::matched;
    double e = 0.0, friction = 0.0, speed = 1.0;
    bool rolls = false;
    double angle = 0.0;      ///< of the way with x, from −80 to 80 degrees [rad]
    double swing = infinity; ///< across the pipe that it runs in [m/s]
    double start = 0.0;      ///< on x, before the joint [m]
    double aside = 0.0;      ///< along y, where it crosses the joint [m]
    Turn turn = Turn::Identity();
    Vec3 shift = Vec3::Zero();
};

Run any_run(Draw& draw, bool may_turn)
{
    Run run;
    run.law = any_law(draw);
    run.e = draw.chance(0.3) ? 0.0 : draw.uniform(0, 0.9);
    run.friction = draw.chance(0.3) ? 0.0 : draw.uniform(0.1, 1);
    run.speed = draw.log_uniform(0.2, 10);
    run.rolls = run.friction > 0.0 && draw.chance(0.7);
    run.angle = draw.chance(0.3) ? 0.0 : draw.uniform(-80, 80) * std::numbers::pi / 180;
    run.start = draw.uniform(0.6, 1.6) * d;
    run.aside = draw.uniform(-1, 1) * d;
    if (may_turn && draw.chance(0.5))
        run.turn = Eigen::AngleAxisd(draw.uniform(0, 3), draw.direction()).toRotationMatrix();
    if (may_turn && draw.chance(0.5)) run.shift = draw.uniform(0, 1) * draw.direction();
    return run;
}

std::string told(const Run& run)
{
    return text(
        "%s, e %.3g, friction %.3g, %s at %.4g m/s, %.4g degrees from the normal of the joint, from %.3g d before "
        "it%s%s",
        run.law == Stabilisation::matched ? "matched" : "projected", run.e, run.friction,
        run.rolls ? "rolling" : "sliding", run.speed, run.angle * 180 / std::numbers::pi, run.start / d,
        run.turn.isIdentity() ? "" : ", all turned", run.shift.isZero() ? "" : ", all shifted");
}

/// What a floor did to a sphere.
struct Ride {
    double leap = 0.0; ///< the highest it comes above its start, what it still rises included [d]
    Vec3 velocity;     ///< in the end, as if nothing were turned [m/s]
    Vec3 place;
    double step = 0.0;
};

/// @param from_middle it begins at y = 0, the bottom of a pipe; @param step if not the automatic one [s]
Ride ride(const Floor& floor, const Run& run, bool from_middle = false, double step = 0.0)
{
    World world = empty_world({.friction = run.friction, .restitution = run.e});
    world.model.gravity = run.turn * world.model.gravity;
    for (const Shape& piece : floor.pieces) world.add_wall(placed(piece, run.turn, run.shift));
    const Vec3 way(std::cos(run.angle), std::sin(run.angle), 0);
    // The joint is at x = 0; a periodic cell is shifted so that its border is there.
    if (floor.period > 0.0) {
        world.model.periodicity.length.x() = floor.period;
        world.model.periodicity.origin = Vec3(-half, 0, 0);
    }
    const double joint = floor.period > 0.0 ? half : 0.0;
    Vec3 begin = Vec3(joint, run.aside, standard_radius) - run.start / way.x() * way;
    if (from_middle) begin.y() = 0.0;
    const Vec3 spin = run.rolls ? Vec3(Vec3::UnitZ().cross(way) * run.speed / standard_radius) : Vec3::Zero();
    world.add_sphere(run.turn * begin + run.shift, run.speed * (run.turn * way), run.turn * spin);
    set_as_a_scene(world, run.law, run.swing);
    if (step > 0.0) world.model.time_step = step;
    Ride ride;
    ride.step = world.model.time_step;
    const double length = (run.start + 0.6 * d) / way.x();
    const int steps = static_cast<int>(length / (run.speed * ride.step)) + 10;
    for (int k = 0; k < steps; ++k) {
        world.step();
        const double height = (run.turn.transpose() * (world.position() - run.shift)).z() - standard_radius;
        const double rising = std::max(0.0, (run.turn.transpose() * world.velocity()).z());
        ride.leap = std::max(ride.leap, (height + rising * rising / (2 * standard_gravity)) / d);
    }
    ride.velocity = run.turn.transpose() * world.velocity();
    ride.place = run.turn.transpose() * (world.position() - run.shift);
    return ride;
}

constexpr double highest_leap = 1e-3, greatest_loss = 1e-4;

/// A level floor of pieces does to a sphere what a plane does.
Fault level_joint(Draw& draw)
{
    const Floor floor = any_floor(draw);
    const Run run = any_run(draw, floor.period == 0.0);
    const Ride over = ride(floor, run), plain = ride({"a plane", {Plane{}}}, run, false, over.step);
    // Down a step it gains what it falls.
    const double gain = standard_gravity * floor.down / (run.speed * run.speed);
    const double change = (over.velocity - plain.velocity).head<2>().norm() / run.speed;
    if (over.leap < highest_leap && change < greatest_loss + gain) return {};
    return text("%s%s, ", floor.name.c_str(), floor.down > 0.0 ? text(" of %.2g m", floor.down).c_str() : "") +
           told(run) +
           text("\n  leap %.3g d, velocity changed by %.2g of its speed: (%.6g, %.6g, %.6g) for (%.6g, %.6g, %.6g)",
               over.leap, change, over.velocity.x(), over.velocity.y(), over.velocity.z(), plain.velocity.x(),
               plain.velocity.y(), plain.velocity.z());
}

/// Pipe lengths end to end do what one pipe does to a sphere that runs along the bottom, and swings a little.
Fault pipe_joint(Draw& draw)
{
    const double radius = draw.log_uniform(0.6, 20) * d;
    Run run = any_run(draw, true);
    // It swings to the side, pressed to the wall by a few times its weight at most.
    const double swing = std::sqrt(draw.uniform(0, 3) * standard_gravity * (radius - standard_radius));
    run.angle = draw.chance(0.3) ? 0.0 : draw.sign() * std::asin(std::min(0.3, swing / run.speed));
    run.aside = 0.0;
    if (run.angle != 0.0) run.swing = run.speed * std::abs(std::sin(run.angle));
    const Vec3 axis = Vec3::UnitX();
    const auto pipe = [&](double from, double to) { return Cylinder{Vec3(from, 0, radius), axis, radius, to - from}; };
    const Floor lengths{"", {pipe(-half, 0), pipe(0, half)}}, whole{"", {pipe(-half, half)}};
    const Ride over = ride(lengths, run, true), plain = ride(whole, run, true, over.step);
    const double change = (over.velocity - plain.velocity).norm() / run.speed;
    if (std::abs(over.leap - plain.leap) < highest_leap && change < greatest_loss) return {};
    return text("pipe lengths of radius %.3g d, ", radius / d) + told(run) +
           text(
               "\n  leap %.3g d for %.3g d, velocity changed by %.2g of its speed: (%.6g, %.6g, %.6g) for (%.6g, %.6g, "
               "%.6g)",
               over.leap, plain.leap, change, over.velocity.x(), over.velocity.y(), over.velocity.z(),
               plain.velocity.x(), plain.velocity.y(), plain.velocity.z());
}

/// A step up of a millimetre is met at its edge, whose normal points back: 0.6 of the speed is along it, and what is
/// slow stays before it.
Fault real_edge(Draw& draw)
{
    Run run = any_run(draw, true);
    run.friction = 0.0;
    run.rolls = false;
    run.angle = draw.uniform(-30, 30) * std::numbers::pi / 180;
    run.speed = draw.log_uniform(0.03, 3);
    const double up = 1e-3, r = standard_radius;
    const Vec3 n = Vec3(-std::sqrt(up * (2 * r - up)), 0, r - up) / r;
    const bool meshes = draw.chance(0.5);
    std::vector<Shape> pieces;
    if (meshes)
        pieces = {quad(-half, 0, -half, half, 0, true), quad(0, half, -half, half, up, false)};
    else
        pieces = {box_panels({Vec3(-half, -half, -0.1), Vec3(0, half, 0)}, {}),
            box_panels({Vec3(0, -half, -0.1), Vec3(half, half, up)}, {})};

    World world = empty_world({.restitution = run.e});
    world.model.gravity = run.turn * world.model.gravity;
    for (const Shape& piece : pieces) world.add_wall(placed(piece, run.turn, run.shift));
    const Vec3 way(std::cos(run.angle), std::sin(run.angle), 0);
    const Vec3 begin = Vec3(0, run.aside, r) - run.start / way.x() * way;
    world.add_sphere(run.turn * begin + run.shift, run.speed * (run.turn * way));
    set_as_a_scene(world, run.law);
    const double h = world.model.time_step;
    if (-run.speed * way.dot(n) < 6 * h * standard_gravity) return {};
    const auto place = [&] { return Vec3(run.turn.transpose() * (world.position() - run.shift)); };
    const auto velocity = [&] { return Vec3(run.turn.transpose() * world.velocity()); };
    const Vec3 v = run.speed * way, after = v - (1 + run.e) * v.dot(n) * n;
    // Until the first blow, and some steps more; then as long as it would take to cross it.
    int k = 0;
    const int most = static_cast<int>(3 * run.start / (way.x() * run.speed * h)) + 20;
    while (k < most && velocity().x() > 0.999 * v.x()) world.step(), ++k;
    const Vec3 found = velocity();
    const double met_at = place().x(), at = n.x() * r, change = (found - after).norm() / run.speed;
    const double move = run.speed * h;
    std::string wrong;
    if (k == most)
        wrong = "it was never met";
    else if (std::abs(met_at - at) > 2 * move + 0.01 * d)
        wrong = text("met at %.4g d for %.4g d", met_at / d, at / d);
    // The place is good to a step, which turns the normal, and gravity acts in the step.
    else if (change > 0.02 + 2 * (1 + run.e) * move / r + 2 * h * standard_gravity / run.speed)
        wrong = text("velocity changed by %.2g of the speed from what the edge gives", change);
    // Over the edge goes only what has the energy for it: the part across it, with what a blow leaves.
    const double climbs = 0.5 * after.head<1>().squaredNorm() + 0.5 * after.z() * after.z();
    const bool passes = climbs > standard_gravity * up;
    double lowest = infinity;
    bool passed = false;
    for (int i = 0; i < 200; ++i) {
        world.step();
        if (place().x() > 0.0) lowest = std::min(lowest, place().z()), passed = true;
    }
    if (passed && !passes && climbs < 0.8 * standard_gravity * up) wrong = "it passed without the energy to do so";
    if (passed && lowest < r + up - 0.01 * d) wrong = text("it went through, %.3g d deep", (r + up - lowest) / d);
    if (wrong.empty()) return {};
    return text("an edge of 1 mm up, %s, ", meshes ? "meshes" : "boxes") + told(run) + "\n  " + wrong +
           text("; after it (%.4g, %.4g, %.4g), the edge gives (%.4g, %.4g, %.4g) m/s", found.x(), found.y(), found.z(),
               after.x(), after.y(), after.z());
}

} // namespace

TEST_CASE("a sphere runs over a level joint as over one piece", "[joints][level]")
{
    for_all_worlds(1.0, level_joint);
}

TEST_CASE("a sphere runs through pipe lengths as through one pipe", "[joints][pipe]")
{
    for_all_worlds(1.0 / 4, pipe_joint);
}

TEST_CASE("an edge that stands up stops what it should", "[joints][edge]")
{
    for_all_worlds(1.0 / 2, real_edge);
}

} // namespace talus::test
