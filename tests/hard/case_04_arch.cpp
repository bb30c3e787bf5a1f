// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"

#include "tests/support/world.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double d = 2 * standard_radius;
const double h = automatic_step();
const double push_out_speed = automatic_push_out_speed();
constexpr double pi = std::numbers::pi;

constexpr int stones = 7;
constexpr int keystone = stones / 2;
constexpr double turn = pi / stones; ///< from stone to stone

/// Seven spheres on a half-circle, each touching the next; the first and the last stand on the floor, the abutments.
World arch(double friction, Stabilisation law, bool rotation)
{
    World world = production_world({.friction = friction}, law);
    world.model.physics.spin = rotation && friction > 0;
    world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    const double radius = standard_radius / std::sin(0.5 * turn);
    for (int k = 0; k < stones; ++k) {
        const double angle = (k + 0.5) * turn;
        world.add_sphere(radius * Vec3(std::cos(angle), 0, std::sin(angle)));
    }
    return world;
}

/// The least friction with which the arch can stand when its stones do not turn. A contact j = 1/2, 3/2, 5/2, 7/2 away
/// from the keystone's middle carries j weights and the thrust H; its normal lies j turns below the horizontal. The
/// force must be within the angle of friction of the normal everywhere, for the best H.
double critical_friction()
{
    const auto worst_angle = [](double thrust) {
        double worst = 0.0;
        for (const double j : {0.5, 1.5, 2.5, 3.5}) worst = std::max(worst, std::abs(std::atan2(j, thrust) - j * turn));
        return worst;
    };
    double least = infinity;
    for (int k = 1; k < 100000; ++k) least = std::min(least, worst_angle(1e-4 * k));
    return std::tan(least);
}

struct ArchRun {
    double fall = 0.0;       ///< of the keystone [d]
    double drift = 0.0;      ///< largest of a stone after the first tenth of the run [d]
    double load_error = 0.0; ///< worst of the floor's force after the first tenth [weight]
    double stood = 0.0;      ///< until the keystone was half a diameter down, or the end [s]
};

/// @param cold every step begins without impulses
ArchRun run_arch(double friction, Stabilisation law, bool rotation, int steps, bool cold = false)
{
    World world = arch(friction, law, rotation);
    const double top = world.position(keystone).z();
    const double weight = stones * world.mass() * standard_gravity;
    ArchRun run;
    std::vector<Vec3> settled;
    for (int k = 0; k < steps; ++k) {
        if (cold) world.network = {};
        world.step();
        run.fall = (top - world.position(keystone).z()) / d;
        if (run.fall < 0.5) run.stood = world.state.time;
        if (k < steps / 10) continue;
        if (settled.empty())
            for (int id = 0; id < stones; ++id) settled.push_back(world.position(id));
        for (int id = 0; id < stones; ++id)
            run.drift = std::max(run.drift, (world.position(id) - settled[id]).norm() / d);
        run.load_error =
            std::max(run.load_error, std::abs(world.report.outcome.from_walls.impulse.z() / h / weight - 1.0));
    }
    return run;
}

/// A sphere between two planes that rise at 90° − ψ from the horizontal and meet below it.
World wedge(double half_angle, double friction, Stabilisation law)
{
    World world = production_world({.friction = friction}, law);
    for (const double side : {-1.0, 1.0})
        world.add_plane(Vec3::Zero(), Vec3(side * std::cos(half_angle), 0, std::sin(half_angle)));
    world.add_sphere(standard_radius / std::sin(half_angle) * Vec3::UnitZ());
    return world;
}

} // namespace

TEST_CASE("4 arch of seven spheres", "[hard]")
{
    // Spheres that turn are links between hinges, their contacts: with weight at every centre no thrust line goes
    // through all eight contacts of a half-circle, so it falls whatever the friction. Spheres that do not turn stand as
    // soon as the thrust can stay within all cones, at μ = 0.298; one weak contact, or a warm start that drifts out of
    // its cone, and they slide apart. They are laid down without any force, so that the thrust must build itself up.
    HardCase hard("4 arch of seven spheres");
    const double critical = critical_friction();
    hard.tell("least friction of an arch that does not turn", critical);
    for (const auto law : {Stabilisation::projected, Stabilisation::matched}) {
        const std::string name = name_of(law) + ": ";
        for (const double share : {1.01, 1.1, 0.5 / critical}) {
            const ArchRun run = run_arch(share * critical, law, false, 100000);
            const std::string what =
                name + "no rotation, friction " + std::to_string(share).substr(0, 4) + " of the least: ";
            hard.below(what + "fall of the keystone in 1e5 steps [d]", run.fall, 1e-3);
            hard.below(what + "drift from 1e4 steps on [d]", run.drift, 1e-9);
            hard.below(what + "error of the abutments' load [weight]", run.load_error, 1e-6);
        }
        const ArchRun cold = run_arch(0.5, law, false, 100000, true);
        hard.tell(name + "no rotation, friction 0.5, no warm start: fall of the keystone in 1e5 steps [d]", cold.fall);
        hard.tell(name + "no rotation, friction 0.5, no warm start: stood for [s]", cold.stood);
        for (const double share : {0.99, 0.0})
            hard.above(name + "no rotation, friction " + (share > 0 ? "0.99 of the least" : "0") +
                           ": fall of the keystone [d]",
                run_arch(share * critical, law, false, 5000).fall, 1.0);
        const ArchRun smooth = run_arch(0.0, law, true, 5000), rough = run_arch(0.5, law, true, 5000);
        hard.above(name + "rotation, friction 0: fall of the keystone [d]", smooth.fall, 1.0);
        hard.tell(name + "rotation, friction 0: stood for [s]", smooth.stood);
        hard.above(name + "rotation, friction 0.5: fall of the keystone [d]", rough.fall, 1.0);
        hard.tell(name + "rotation, friction 0.5: stood for [s]", rough.stood);
    }
}

TEST_CASE("4 sphere in a wedge", "[hard][quick]")
{
    // Pushed in by 0.01 to 1000 times its weight, and then let go, without weight. At μ = 1.1 tan ψ it locks itself,
    // whatever is left of the force inside. At 0.9 tan ψ the overlap stored by `matched` expels it; nothing is stored
    // in a rigid contact, but 3 sweeps a step do not take back all of the impulse at once, which must not make a shot
    // of it.
    HardCase hard("4 sphere in a wedge");
    for (const auto law : {Stabilisation::projected, Stabilisation::matched}) {
        const std::string name = name_of(law) + ": ";
        const bool compliant = law == Stabilisation::matched;
        double moved = 0.0, locked_speed = 0.0, expelled_least = infinity, expelled_most = 0.0, energy = 0.0;
        bool formula = true;
        for (const double degrees : {5.0, 15.0, 30.0})
            for (const double share : {1.1, 0.9})
                for (const double push : {0.01, 1.0, 10.0, 1000.0}) {
                    const double psi = degrees * pi / 180.0, friction = share * std::tan(psi);
                    World world = wedge(psi, friction, law);
                    world.model.gravity *= push;
                    world.step(2000);
                    const double load = world.mass() * standard_gravity * push;
                    formula = formula && world.contact_forces().size() == 2;
                    for (const auto& contact : world.contact_forces())
                        formula =
                            formula &&
                            contact.normal_force > 0.999 * load / 2 / (std::sin(psi) + friction * std::cos(psi)) &&
                            contact.normal_force < 1.001 * load / 2 / std::sin(psi);
                    const Vec3 place = world.position();
                    world.model.gravity.setZero();
                    world.step();
                    const double stored = world.report.contacts.stored_energy;
                    world.step(4999);
                    const double speed = world.velocity().norm() / (push * standard_gravity * h);
                    if (share > 1) {
                        moved = std::max(moved, (world.position() - place).norm() / d / push);
                        locked_speed = std::max(locked_speed, speed);
                    } else {
                        expelled_least = std::min(expelled_least, world.velocity().z() / (push * standard_gravity * h));
                        expelled_most = std::max(expelled_most, speed);
                        if (compliant) energy = std::max(energy, kinetic_energy(world.state) / stored);
                    }
                }
        hard.holds(name + "normal forces between P/2(sin + mu cos) and P/2 sin", formula);
        hard.below(name + "1.1 tan psi: way after the load is gone [d per weight of load]", moved, 2e-6);
        hard.below(name + "1.1 tan psi: speed 5000 steps later [P h/m]", locked_speed, 1e-5);
        if (compliant) {
            hard.above(name + "0.9 tan psi: least speed of expulsion [P h/m]", expelled_least, 1e-3);
            hard.below(name + "0.9 tan psi: energy of expulsion [stored]", energy, 1.0);
        }
        hard.below(name + "0.9 tan psi: largest speed of expulsion [P h/m]", expelled_most, 1.0);
    }
}
