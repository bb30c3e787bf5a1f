// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/contacts.hpp"
#include "tests/support/world.hpp"

#include "core/base/region.hpp"

#include <cmath>
#include <numbers>

// Smooth spheres in a periodic cell without gravity, at the automatic step, in which the fastest moves a tenth of a
// diameter.

namespace talus::test
{
namespace
{

constexpr double diameter = 2 * standard_radius;
constexpr int along = 10; // spheres along an edge
constexpr double count = along * along * along;
constexpr double fine = 1e-3; // the tolerance that a scene gets which has restitution and no gravity

/// As many as `count` at rest on a lattice, with the normal distribution of velocities, 1 m/s along an axis, and no
/// momentum.
World lattice(double solid_fraction, int seed)
{
    World world = production_world(ContactLaw{.restitution = 1.0});
    world.model.gravity.setZero();
    world.model.solver.tolerance = fine;
    const double spacing = diameter * std::cbrt(std::numbers::pi / 6 / solid_fraction);
    Random random(static_cast<std::uint64_t>(seed));
    const auto normal = [&] {
        return std::sqrt(-2 * std::log(1 - uniform(random))) * std::cos(2 * std::numbers::pi * uniform(random));
    };
    Vec3 mean = Vec3::Zero();
    double fastest = 0.0;
    for (int k = 0; k < count; ++k) {
        const double x = normal(), y = normal();
        const Vec3 place(k % along + 0.5, k / along % along + 0.5, k / (along * along) + 0.5), velocity(x, y, normal());
        world.add_sphere(spacing * place, velocity);
        mean += velocity / count;
        fastest = std::max(fastest, velocity.norm());
    }
    for (Body& m : world.state.bodies) m.velocity -= mean;
    world.model.periodicity.length.setConstant(along * spacing);
    world.model.world = {Vec3::Zero(), Vec3::Constant(along * spacing)};
    world.model.time_step = 0.1 * diameter / fastest;
    return world;
}

/// The gas with this restitution, after twenty impacts a sphere between elastic spheres.
World gas(double solid_fraction, double restitution, int seed)
{
    World stirred = lattice(solid_fraction, seed);
    double impacts = 0.0;
    while (impacts < 10 * count) {
        stirred.step();
        impacts += static_cast<double>(stirred.report.contacts.impacts);
    }
    World world;
    world.model = stirred.model;
    world.model.materials = production_world(ContactLaw{.restitution = restitution}).model.materials;
    world.state = stirred.state;
    world.state.time = 0.0;
    world.state.steps = 0;
    return world;
}

/// Impacts of a sphere in a second, Enskog's theory: 4 n g(d) d² √(π T/m), g(d) after Carnahan and Starling (1969).
double enskog_rate(const World& world, double solid_fraction)
{
    const double at_contact = (1 - solid_fraction / 2) / std::pow(1 - solid_fraction, 3);
    const double density = solid_fraction / (std::numbers::pi / 6 * std::pow(diameter, 3));
    const double temperature_over_mass = 2.0 / 3.0 * kinetic_energy(world.state) / (count * world.mass());
    return 4 * density * at_contact * diameter * diameter * std::sqrt(std::numbers::pi * temperature_over_mass);
}

} // namespace

TEST_CASE("an elastic gas of any density keeps its energy, and has the pressure and the impacts of theory",
    "[restitution][gas]")
{
    // Over 20 impacts a sphere. p V = N T (1 + Σ p_n d / (3 N T t)) against Carnahan & Starling (1969), good to 0.3 %.
    // Impacts are solved to the tolerance, which the energy sees; the rest, 3 and 4 %, is that several of a sphere in
    // one step are solved together.
    const double solid_fraction = GENERATE(0.05, 0.15, 0.29, 0.4);
    const int seed = GENERATE(1, 2, 3);
    World world = gas(solid_fraction, 1.0, seed);
    const double start = kinetic_energy(world.state), rate = enskog_rate(world, solid_fraction);
    double impacts = 0.0, virial = 0.0;
    while (world.state.time * rate < 20.0) {
        world.step();
        for (const ContactForce& contact : world.contact_forces()) {
            impacts += contact.normal_force > 0.0;
            virial += contact.normal_force * world.model.time_step * diameter;
        }
    }
    CAPTURE(solid_fraction, seed);
    CHECK(kinetic_energy(world.state) == within(5e-3, start));
    CHECK(2 * impacts / (count * world.state.time) == within(0.04, rate));
    const double contact_share = virial / (2 * start * world.state.time);
    const double at_contact = (1 - solid_fraction / 2) / std::pow(1 - solid_fraction, 3);
    CHECK(1 + contact_share == within(0.03, 1 + 4 * solid_fraction * at_contact));
    CHECK(world.momentum().norm() < 1e-12 * count * world.mass());
}

TEST_CASE("a gas cools by Haff's law", "[restitution][gas]")
{
    // E = E₀ (1 + t/t₀)⁻², t₀ = 6/((1 − e²) ν) (Haff 1983), over five impacts a sphere; mean of gases of which one
    // is good to 3 %. Inelastic spheres meet less often than Enskog has it: at a solid fraction of 0.1 and e = 0.7 an
    // eighth of the step has 0.980 ± 0.008 of his rate too, and what is missing goes with 1 − e².
    const double e = GENERATE(0.7, 0.8, 0.9, 0.95);
    const double of_enskog = 1.0 - 0.04 * (1.0 - e * e);
    constexpr double solid_fraction = 0.1;
    double sum = 0.0;
    constexpr int gases = 24;
    for (int seed = 1; seed <= gases; ++seed) {
        World world = gas(solid_fraction, e, seed);
        const double start = kinetic_energy(world.state), rate = enskog_rate(world, solid_fraction);
        while (world.state.time * rate < 5.0) world.step();
        const double cooled = std::sqrt(start / kinetic_energy(world.state)) - 1;
        sum += cooled / (world.state.time * (1 - e * e) * rate / 6);
    }
    CAPTURE(e);
    CHECK(sum / gases == within(0.02, of_enskog));
}

} // namespace talus::test
