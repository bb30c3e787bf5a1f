// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"

#include "core/law/impact.hpp"
#include "tests/support/world.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double d = 2 * standard_radius;
constexpr double closing_speed = 1e-3;                  // m/s, of the two walls together
constexpr double deepest = 0.1 * d;                     // of the sphere in each wall
constexpr double closing = 2 * deepest / closing_speed; // s

/// A sphere, without gravity, between two walls that close symmetrically for `closing` seconds and open again as long.
/// They are at right angles to x, or lean outwards towards +y by the angle.
World vice(double half_angle, double friction, bool converged = false)
{
    World world = production_world({.friction = friction});
    if (converged) world.model.solver = matched_settings();
    world.model.gravity.setZero();
    for (const double side : {-1.0, 1.0}) {
        const Vec3 normal(-side * std::cos(half_angle), std::sin(half_angle), 0);
        const Vec3 inwards = -0.5 * closing_speed * side * Vec3::UnitX();
        world.add_wall(Plane{-standard_radius * normal, normal},
            {Translation{{0, closing}, inwards}, Translation{{closing, 2 * closing}, -inwards}});
    }
    world.add_sphere(Vec3::Zero());
    return world;
}

struct Squeeze {
    double mean = 0.0, difference = 0.0; ///< of the normal forces of the two walls [N]
    double overlap = 0.0;                ///< the deeper [m]
};

Squeeze forces_of(const World& world)
{
    double force[2] = {0.0, 0.0};
    Squeeze squeeze;
    for (const auto& contact : world.contact_forces()) {
        force[contact.b] = contact.normal_force;
        squeeze.overlap = std::max(squeeze.overlap, -contact.gap);
    }
    squeeze.mean = 0.5 * (force[0] + force[1]);
    squeeze.difference = std::abs(force[0] - force[1]);
    return squeeze;
}

int steps(const World& world, double time)
{
    return static_cast<int>(std::lround(time / world.model.time_step));
}

} // namespace

TEST_CASE("5 a sphere squeezed between two walls", "[hard][quick]")
{
    // Walls move as prescribed, whatever pushes back: the sphere's overlap is dictated, and 10 % d in each of them is
    // thousands of times what weights do. The force must be that of the contact's stiffness, which for `matched` is the
    // one that the sweeps can carry (k = 4 Upsilon/(sigma W h^2)), rise and fall along one line, and be the same on
    // both sides; the energy that the walls put in must come back, and the sphere stay where it is.
    // Gauss-Seidel takes one wall first. Two sweeps a step leave the sphere behind by some of the steps of the wall
    // (1.3e-5 d each), whatever the tolerance: it is relative to the impulse, and the change from step to step is a
    // 4000th of that. The midplane to 1e-9 d is a matter of converged sweeps. Force and work are those of the overlap
    // at the beginning of each step: first order in the way of a step over the overlap, 1.3e-4. That walls begin to
    // move is an impact at both, which no velocity obeys: all this is looked at from a hundredth of the way on, and the
    // sphere may by then be a step of the wall from the midplane.
    HardCase hard("5 a sphere squeezed between two walls");
    World world = vice(0.0, 0.5), exact = vice(0.0, 0.5, true);
    const double h = world.model.time_step;
    const double stiffness = 4 * upsilon / (0.5 * sigma_per_sweep * h * h) * world.mass();
    const double full = stiffness * deepest * deepest; // 2 x 1/2 k g^2
    double force_error = 0.0, asymmetry = 0.0, aside = 0.0, exactly_aside = 0.0, exact_asymmetry = 0.0;
    double work = 0.0, most_work = 0.0, gain = 0.0, highest = 0.0;
    for (int k = 0; k < steps(world, 2.2 * closing); ++k) {
        world.step();
        exact.step();
        const bool begins = world.state.time < 0.01 * closing;
        if (begins) {
            work += world.report.outcome.wall_work;
            continue;
        }
        const Squeeze squeeze = forces_of(world);
        highest = std::max(highest, squeeze.mean);
        force_error =
            std::max(force_error, std::abs(squeeze.mean - stiffness * squeeze.overlap) / (stiffness * deepest));
        asymmetry = std::max(asymmetry, squeeze.difference / (stiffness * deepest));
        aside = std::max(aside, world.position().norm() / (0.5 * closing_speed * h));
        exact_asymmetry = std::max(exact_asymmetry, forces_of(exact).difference / (stiffness * deepest));
        exactly_aside = std::max(exactly_aside, exact.position().norm() / d);
        // What the walls have put in, against what there is.
        gain = std::max(gain, (world.report.contacts.stored_energy - work) / full);
        work += world.report.outcome.wall_work;
        most_work = std::max(most_work, work);
    }
    hard.below("highest force, error of k x 10 % d", std::abs(highest / (stiffness * deepest) - 1.0), 1e-3);
    hard.below("force over its whole way, error of k x overlap [highest]", force_error, 1e-3);
    hard.below("difference of the two forces [highest]", asymmetry, 1e-3);
    hard.below("way from the midplane [steps of a wall]", aside, 5);
    hard.below("converged: difference of the two forces [highest]", exact_asymmetry, 1e-9);
    hard.below("converged: way from the midplane [d]", exactly_aside, 3e-5);
    hard.below("energy stored beyond what the walls put in [all]", gain, 1e-3);
    hard.below("work of the walls, error of k g^2", std::abs(most_work / full - 1.0), 1e-3);
    hard.between("work of the walls until they are open again [all]", work / full, -1e-3, 1e-3);
    hard.below("speed of the sphere afterwards [m/s]", world.velocity().norm(), 1e-6);
    hard.tell("highest force [weight]", highest / (world.mass() * standard_gravity));
}

TEST_CASE("5 a sphere squeezed between two walls that lean outwards", "[hard][quick]")
{
    // Half-angle psi = 15 degrees. Above tan psi friction holds: the sphere sticks to both walls, which takes it
    // inwards by their way times tan psi, and it is not expelled however much is stored (thousands of times its
    // weight). Below, it slips out. Energy decides neither: only the cone does. With two sweeps a step what sticks
    // yields elastically: the sphere comes out by T/k_t with k_t = 0.3 k_n, for any friction, step and number of sweeps
    // (whose product with the compliance is fixed), and goes back when the walls open. With converged sweeps k_t is
    // infinite.
    HardCase hard("5 a sphere squeezed between two walls that lean outwards");
    const double half_angle = std::numbers::pi / 12, critical = std::tan(half_angle);
    const double inwards = -0.5 * closing_speed * closing * critical;

    World exact = vice(half_angle, 1.05 * critical, true);
    exact.step(steps(exact, closing));
    hard.below("1.05 tan psi, converged: way from the midplane [d]", std::abs(exact.position().x()) / d, 1e-9);
    hard.below("1.05 tan psi, converged: way inwards, error [d]", std::abs(exact.position().y() - inwards) / d, 3e-5);
    hard.below("1.05 tan psi, converged: spin [rad/s]", exact.angular_velocity().norm(), 1e-6);

    World held = vice(half_angle, 1.05 * critical);
    held.step(steps(held, closing));
    hard.below("1.05 tan psi: way outwards [d]", held.position().y() / d, 0.1);
    hard.below("1.05 tan psi: way from the midplane [d]", std::abs(held.position().x()) / d, 1e-4);
    held.step(steps(held, closing));
    hard.below("1.05 tan psi, open again: way from where it was [d]", held.position().norm() / d, 1e-3);

    World slipping = vice(half_angle, 0.95 * critical);
    slipping.step(steps(slipping, closing));
    hard.above("0.95 tan psi: way outwards [d]", slipping.position().y() / d, 0.3);
    hard.below("0.95 tan psi: way from the midplane [d]", std::abs(slipping.position().x()) / d, 0.01);
    hard.below("0.95 tan psi: speed [speed of closing]", slipping.velocity().norm() / closing_speed, 10);
}
