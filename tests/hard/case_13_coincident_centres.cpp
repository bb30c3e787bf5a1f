// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"

#include "tests/support/world.hpp"

#include <algorithm>
#include <cmath>
#include <string>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double d = 2 * standard_radius;

/// Two spheres whose centres are this far apart, away from the origin, without gravity.
World pair_apart(double distance, Stabilisation stabilisation)
{
    World world = production_world({.friction = 0.5}, stabilisation);
    world.model.gravity.setZero();
    world.add_sphere(Vec3::Zero());
    world.add_sphere(distance * Vec3(2, -1, 2) / 3.0);
    return world;
}

double distance(const World& world)
{
    return (world.position(0) - world.position(1)).norm();
}

bool same_bits(const World& a, const World& b)
{
    return a.position(0) == b.position(0) && a.position(1) == b.position(1) && a.velocity(0) == b.velocity(0) &&
           a.velocity(1) == b.velocity(1);
}

} // namespace

TEST_CASE("13 coincident centres", "[hard][quick]")
{
    // A normal that is x/|x| is not a number at 0, and points anywhere at 1e-15 d. Asked for: parted within 20 steps,
    // which is the business of `projected`, by which --relax moves overlapping spheres apart before a run begins: each
    // step leaves 5/9 of the overlap, 20 of them 8e-6. `matched` must not: undoing a whole diameter in 20 steps would
    // be a shot of d/(20 h) = 2 m/s, 60 times the push-out speed; it parts them with that speed, in d over it.
    HardCase hard("13 coincident centres");
    const double p = automatic_push_out_speed();
    for (const double apart : {0.0, 1e-15 * d}) {
        const std::string where = apart == 0.0 ? "0 apart" : "1e-15 d apart";
        World moved = pair_apart(apart, Stabilisation::projected);
        moved.step(20);
        hard.below(where + ", projected: overlap after 20 steps [d]", 1.0 - distance(moved) / d, 1e-5);
        hard.below(where + ", projected: speed [m/s]", moved.velocity(0).norm(), 1e-15);
        hard.below(
            where + ", projected: drift of the middle [d]", (moved.position(0) + moved.position(1)).norm() / d, 1e-14);

        World pushed = pair_apart(apart, Stabilisation::matched);
        const int steps = advance_until(
            pushed, [](const World& w) { return distance(w) >= d; }, 10000);
        hard.below(where + ", matched: time until they are apart [d / push-out speed]",
            steps * pushed.model.time_step * p / d, 1.05);
        hard.between(where + ", matched: speed of parting [push-out speed]",
            (pushed.velocity(0) - pushed.velocity(1)).norm() / p, 1.0, 1.2);
        hard.below(where + ", matched: momentum [m x speed]",
            pushed.momentum().norm() / (pushed.mass() * pushed.velocity(0).norm()), 1e-14);

        for (const auto law : {Stabilisation::projected, Stabilisation::matched}) {
            World one = pair_apart(apart, law), other = pair_apart(apart, law);
            one.step(100);
            other.step(100);
            hard.holds(where + (law == Stabilisation::matched ? ", matched" : ", projected") + ": the same bits again",
                same_bits(one, other));
        }
    }
}

TEST_CASE("13 eight spheres with one centre, on a floor", "[hard][quick]")
{
    // All 28 pairs get the same arbitrary normal, here along gravity: they part into a tower in exact balance, whose
    // lowest contact then carries seven of them.
    HardCase hard("13 eight spheres with one centre, on a floor");
    World world = production_world({.friction = 0.5});
    world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    for (int k = 0; k < 8; ++k) world.add_sphere(Vec3(0.3, -0.2, standard_radius));
    double fastest = 0.0;
    const int steps = static_cast<int>(3.0 / world.model.time_step);
    for (int k = 0; k < steps; ++k) {
        world.step();
        fastest = std::max(fastest, world.report.bodies.fastest_speed);
    }
    hard.below("fastest speed [sqrt(2 g 8 d)]", fastest / std::sqrt(2 * standard_gravity * 8 * d), 1.0);
    hard.below("worst overlap after 3 s [d]", world.report.contacts.worst_overlap / d, 1e-3);
    double top = 0.0;
    for (const Vec3& x : world.state.position) top = std::max(top, x.z());
    hard.between("height of the uppermost [d]", top / d, 7.49, 7.5);
}
