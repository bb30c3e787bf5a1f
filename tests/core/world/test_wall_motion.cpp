// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/world/wall_motion.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace talus;

namespace
{

constexpr double pi = std::numbers::pi;

/// How far two poses put the corners of a cube of ±1 m from each other at most [m].
double apart(const Pose& a, const Pose& b)
{
    double worst = 0.0;
    for (const double x : {-1.0, 1.0})
        for (const double y : {-1.0, 1.0})
            for (const double z : {-1.0, 1.0}) worst = std::max(worst, (a(Vec3(x, y, z)) - b(Vec3(x, y, z))).norm());
    return worst;
}

/// Where a pose is carried by a constant twist in a time, by many small steps of the classical Runge–Kutta method: an
/// oracle that knows nothing of exponentials.
Pose carried(const Pose& from, const Twist& twist, double time)
{
    constexpr int steps = 200;
    const double h = time / steps;
    const auto move = [&](Vec3 x) {
        for (int k = 0; k < steps; ++k) {
            const Vec3 k1 = twist.at(x), k2 = twist.at(x + 0.5 * h * k1), k3 = twist.at(x + 0.5 * h * k2);
            const Vec3 k4 = twist.at(x + h * k3);
            x += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
        }
        return x;
    };
    Pose to;
    to.shift = move(from(Vec3::Zero()));
    for (int d = 0; d < 3; ++d) to.rotation.col(d) = move(from(Vec3::Unit(d))) - to.shift;
    return to;
}

const Vec3 some_axis = Vec3(1, -2, 0.5).normalized();
const Vec3 some_point(0.3, 0.1, -0.7);

} // namespace

TEST_CASE("the inverse of a pose undoes it, and one after another is both", "[pose]")
{
    const Pose a = turned_about(some_point, some_axis, 1.1);
    const Pose b = Pose{Eigen::Matrix3d::Identity(), Vec3(1, 2, 3)}.after(turned_about(-some_point, Vec3::UnitX(), -2));
    CHECK(apart(a.after(a.inverse()), Pose{}) < 1e-14);
    CHECK(apart(a.inverse().after(a), Pose{}) < 1e-14);
    const Vec3 x(0.2, -0.4, 0.9);
    CHECK((a.after(b)(x) - a(b(x))).norm() < 1e-14);
}

TEST_CASE("a turn leaves its axis where it is and is right-handed", "[pose]")
{
    const Pose turn = turned_about(some_point, some_axis, 0.7);
    CHECK((turn(some_point + 3.0 * some_axis) - some_point - 3.0 * some_axis).norm() < 1e-14);
    const Pose quarter = turned_about(Vec3(1, 0, 0), Vec3::UnitZ(), 0.5 * pi);
    CHECK((quarter(Vec3(2, 0, 5)) - Vec3(1, 1, 5)).norm() < 1e-15);
}

TEST_CASE("the box round a placed box holds it and touches it on every side", "[pose]")
{
    const Pose pose = Pose{Eigen::Matrix3d::Identity(), Vec3(1, 2, 3)}.after(turned_about(some_point, some_axis, 2.1));
    const Box box{Vec3(-1, 0, 2), Vec3(0.5, 0.2, 4)};
    Box corners;
    for (const double x : {-1.0, 0.5})
        for (const double y : {0.0, 0.2})
            for (const double z : {2.0, 4.0}) corners.extend(pose(Vec3(x, y, z)));
    CHECK((placed(pose, box).min - corners.min).norm() < 1e-14);
    CHECK((placed(pose, box).max - corners.max).norm() < 1e-14);
}

TEST_CASE("the twist of a turn about a fixed axis is ω × (x − c), however small or large the turn", "[pose]")
{
    // From a pose that is turned and shifted itself. A rotation matrix holds its angle to 1e-16: that over the angle is
    // the relative error of ω. A velocity field with a part along x − c would make grains in a round drum bounce.
    const double angle = GENERATE(1e-7, 1e-5, 0.9999e-3, 1.0001e-3, 0.01, 0.5, 2.0, 3.1);
    const double h = 1e-4;
    const Pose from =
        Pose{Eigen::Matrix3d::Identity(), Vec3(5, 0, -2)}.after(turned_about(Vec3(1, 1, 1), some_axis, 4));
    const Pose to = turned_about(some_point, some_axis, angle).after(from);
    const Twist twist = twist_between(from, to, h);
    const Vec3 w = angle / h * some_axis;
    const double tolerance = 1e-14 / angle + 1e-12;
    CAPTURE(angle);
    CHECK((twist.spin - w).norm() < tolerance * w.norm());
    for (const Vec3& x : {Vec3(0, 0, 0), some_point, Vec3(0.3, -0.8, 2.0)})
        CHECK((twist.at(x) - w.cross(x - some_point)).norm() < 3.0 * tolerance * w.norm());
}

TEST_CASE("the twist of a shift is its velocity", "[pose]")
{
    const Pose from = turned_about(some_point, some_axis, 0.3);
    Pose to = from;
    to.shift += Vec3(1e-5, -2e-5, 0);
    const Twist twist = twist_between(from, to, 1e-3);
    CHECK(twist.spin.norm() < 1e-12);
    CHECK((twist.at(Vec3(7, 8, 9)) - Vec3(0.01, -0.02, 0)).norm() < 1e-12);
}

TEST_CASE("the twist between two poses carries the one to the other: a screw", "[pose]")
{
    const double angle = GENERATE(0.0, 1e-4, 0.02, 0.8, 3.0);
    const double along = GENERATE(0.0, 0.4);
    const Pose from = turned_about(Vec3(-1, 0, 2), Vec3::UnitY(), 1.0);
    Pose to = turned_about(some_point, some_axis, angle).after(from);
    to.shift += along * some_axis + 0.1 * along * Vec3::UnitX(); // so that the axis of the screw lies elsewhere
    CAPTURE(angle, along);
    CHECK(apart(carried(from, twist_between(from, to, 0.2), 0.2), to) < 1e-7); // of the integration
}

TEST_CASE("a wall without motion stays", "[wall_motion]")
{
    CHECK(apart(pose_at({}, 3.0), Pose{}) == 0.0);
}

TEST_CASE("a part of a motion goes on in its span only", "[wall_motion]")
{
    const MotionSpan span{1.0, 3.0};
    CHECK(span.elapsed(0.0) == 0.0);
    CHECK(span.elapsed(1.0) == 0.0);
    CHECK(span.elapsed(2.5) == 1.5);
    CHECK(span.elapsed(9.0) == 2.0);
    CHECK(MotionSpan{}.elapsed(7.0) == 7.0);

    const WallMotion lift = {Translation{span, Vec3(0, 0, 0.5)}};
    CHECK(pose_at(lift, 0.5).shift == Vec3::Zero());
    CHECK(pose_at(lift, 2.0).shift == Vec3(0, 0, 0.5));
    CHECK(pose_at(lift, 100.0).shift == Vec3(0, 0, 1.0));
}

TEST_CASE("a turning wall turns at its rate about its axis", "[wall_motion]")
{
    const WallMotion drum = {Turning{{0.5, infinity}, some_point, some_axis, -3.0}};
    CHECK(apart(pose_at(drum, 0.75), turned_about(some_point, some_axis, -0.75)) < 1e-14);
    const Twist twist = twist_between(pose_at(drum, 40.0), pose_at(drum, 40.0001), 1e-4);
    CHECK((twist.spin + 3.0 * some_axis).norm() < 1e-9);
}

TEST_CASE("a shaken wall swings as a sine and stops where its span ends", "[wall_motion]")
{
    const Vec3 amplitude(0, 0.01, 0.02);
    const WallMotion shaker = {Shaking{{1.0, 1.3}, amplitude, 2.0}};
    CHECK(pose_at(shaker, 0.9).shift == Vec3::Zero());
    CHECK((pose_at(shaker, 1.125).shift - amplitude).norm() < 1e-15); // a quarter of a period
    const Vec3 end = std::sin(2.0 * pi * 2.0 * 0.3) * amplitude;
    CHECK((pose_at(shaker, 1.3).shift - end).norm() < 1e-15);
    CHECK((pose_at(shaker, 5.0).shift - end).norm() < 1e-15);
}

TEST_CASE("a course goes straight from waypoint to waypoint and holds at its ends", "[wall_motion]")
{
    const WallMotion press = {
        Course{{{1.0, Vec3(0, 0, 1)}, {2.0, Vec3(0, 2, 1)}, {2.0, Vec3(5, 5, 5)}, {4.0, Vec3::Zero()}}}};
    const auto at = [&](double time) { return pose_at(press, time).shift; };
    CHECK(at(0.0) == Vec3(0, 0, 1));
    CHECK(at(1.25) == Vec3(0, 0.5, 1));
    CHECK(at(2.0) == Vec3(5, 5, 5)); // a jump
    CHECK(at(3.0) == Vec3(2.5, 2.5, 2.5));
    CHECK(at(4.0) == Vec3::Zero());
    CHECK(at(9.0) == Vec3::Zero());
    CHECK(pose_at({Course{{{1.0, Vec3(1, 2, 3)}}}}, 0.5).shift == Vec3(1, 2, 3));
}

TEST_CASE("of two parts the second moves what comes of the first", "[wall_motion]")
{
    const Turning turn{{}, Vec3::Zero(), Vec3::UnitZ(), 0.5 * pi};
    const Translation move{{}, Vec3(1, 0, 0)};
    CHECK((pose_at({turn, move}, 1.0)(Vec3(1, 0, 0)) - Vec3(1, 1, 0)).norm() < 1e-15);
    CHECK((pose_at({move, turn}, 1.0)(Vec3(1, 0, 0)) - Vec3(0, 2, 0)).norm() < 1e-15);
}
