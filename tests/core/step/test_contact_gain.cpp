// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/step/contact_gain.hpp"
#include "tests/support/world.hpp"

#include <cmath>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double h = 1e-4, r = standard_radius;

World weightless(const ContactLaw& law, Stabilisation stabilisation)
{
    World world = make_world(law, production_settings(stabilisation), h);
    world.model.gravity.setZero();
    return world;
}

/// Two spheres that have just met with 1 m/s each.
World met(double restitution)
{
    World world = weightless({.restitution = restitution}, Stabilisation::matched);
    world.add_sphere(Vec3::Zero(), Vec3(1, 0, 0));
    world.add_sphere(Vec3(2 * r, 0, 0), Vec3(-1, 0, 0));
    world.step();
    return world;
}

} // namespace

TEST_CASE("an impact gains no energy, and one with too large an impulse what it adds", "[contact_gain]")
{
    const double restitution = GENERATE(0.5, 1.0);
    World world = met(restitution);
    const double mass = world.mass();
    CHECK(world.velocity(0).x() == Approx(-restitution));
    CHECK(world.report.contact_gain < 1e-12 * mass);

    // Had the impulse been such that the spheres met with half of the speed that they leave with.
    for (TileContacts& tile : world.network.contacts.spheres)
        for (const std::size_t k : tile.indices()) tile.set_impulse(k, 1.5 * restitution * mass * tile.normal(k));
    const double without = 0.5 * restitution;
    CHECK(contact_gain(world.network, world.state, world.model, h) ==
          Approx(mass * (restitution * restitution - without * without)));
}

TEST_CASE("what one contact gains is not set against what another loses", "[contact_gain]")
{
    World world = weightless({.restitution = 0.5}, Stabilisation::matched);
    for (const double x : {0.0, 1.0}) {
        world.add_sphere(Vec3(x, 0, 0), Vec3(1, 0, 0));
        world.add_sphere(Vec3(x + 2 * r, 0, 0), Vec3(-1, 0, 0));
    }
    world.step();
    bool first = true;
    for (TileContacts& tile : world.network.contacts.spheres)
        for (const std::size_t k : tile.indices()) {
            // One made them fly; the other took twice as much as it did.
            tile.set_impulse(k, (first ? 0.5 : 3.0) * world.mass() * tile.normal(k));
            first = false;
        }
    CHECK(contact_gain(world.network, world.state, world.model, h) == Approx(0.25 * world.mass()));
}

TEST_CASE("beds that come to rest, and springs that push out, gain nothing", "[contact_gain]")
{
    const auto law = GENERATE(Stabilisation::matched, Stabilisation::projected);
    World world = weightless({.friction = 0.5, .rolling_friction = 0.05}, law);
    world.model.solver.push_out_speed = automatic_push_out_speed();
    world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    world.add_sphere(Vec3(0, 0, 0.95 * r));
    world.add_sphere(Vec3(0.4 * r, 0, 2.8 * r), Vec3(0.1, 0, -0.2), Vec3(3, 5, 7));
    double gained = 0.0, most = 0.0;
    for (int k = 0; k < 320; ++k) {
        world.step();
        gained += world.report.contact_gain;
        most = std::max(most, kinetic_energy(world.state));
    }
    CHECK(most > 0.0);
    CHECK(gained < 1e-3 * most);
}
