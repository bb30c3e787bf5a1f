// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/region.hpp"
#include "core/contacts/assembly.hpp"
#include "core/contacts/loads.hpp"
#include "core/deep_beds/galerkin.hpp"
#include "core/deep_beds/pressure_scaling.hpp"
#include "core/solver/gauss_seidel.hpp"
#include "tests/support/contacts.hpp"
#include "tests/support/world.hpp"

#include <cmath>

namespace talus::test
{
namespace
{

constexpr double edge = 16 * standard_radius;

ContactLaw rough(double rolling_friction = 0.0)
{
    ContactLaw law;
    law.friction = 0.5;
    law.rolling_friction = rolling_friction;
    return law;
}

/// A bed of 400 grains, sizes 1 : 2, in a box, still settling. With a lid it carries a piston.
World settling_bed(const ContactLaw& law, bool with_lid = false, const WallMotion& motion = {})
{
    World world = make_world(law, production_settings(Stabilisation::projected), 2.5e-4);
    world.add_wall(box_panels({Vec3::Zero(), Vec3(edge, edge, 4 * edge)}, {"z+"}), motion);
    Random random(3);
    for (int k = 0; k < 400; ++k) {
        const Vec3 place(k % 7 + 0.6, k / 7 % 7 + 0.6, k / 49 + 0.6);
        const double radius = standard_radius * (0.6 + 0.6 * uniform(random));
        const double x = uniform(random), y = uniform(random);
        world.add_sphere(edge / 7 * (place + 0.05 * Vec3(x, y, uniform(random))), Vec3::Zero(), Vec3::Zero(), radius);
    }
    if (with_lid) {
        world.model.physics.pistons = true;
        const double foot = 9.5 * edge / 7;
        world.add_piston(box_panels({Vec3(0.01 * edge, 0.01 * edge, foot), Vec3(0.99 * edge, 0.99 * edge, foot + edge)},
                             {"x-", "x+", "y-", "y+", "z+"}),
            100 * world.mass(), -Vec3::UnitZ());
    }
    world.step(600);
    return world;
}

/// The variants of the sweep: each has other rows.
World variant(int k)
{
    switch (k) {
    case 0:
        return settling_bed({});
    case 1:
        return settling_bed(rough());
    case 2:
        return settling_bed(rough(0.1));
    case 3:
        return settling_bed(rough(0.1), false, {Shaking{{}, Vec3(0, 0, 1e-4), 20.0}});
    default:
        return settling_bed(rough(), true);
    }
}
constexpr int variants = 5;

/// A step up to where the pressure is scaled: after the warm start.
struct WarmStep {
    World world;
    PreparedStep begun;
    PistonGroup pistons;

    explicit WarmStep(World w)
        : world(std::move(w)), begun(prepare_step(world.state, world.network, world.model, {world.model.time_step})),
          pistons(world.network, world.state, world.model, world.model.time_step)
    {
        for (Body& m : world.state.bodies) m.velocity += world.model.time_step * world.model.gravity;
        apply_warm_start(world.network, pistons, world.state.bodies, world.model.physics);
    }

    /// Whatever is at rest gets a share of its load taken away, so that there is something to mend.
    void push_top(double speed)
    {
        for (std::size_t i = 0; i < world.state.count(); ++i)
            if (world.state.position[i].z() > 0.7 * edge) world.state.body(i).velocity.z() -= speed;
    }

    ScalingReport scale() { return scale_pressure(world.network, pistons, world.state, world.model); }

    HatGrid grid() const
    {
        return {4 * world.model.mean_diameter, Box{Vec3::Constant(-edge), Vec3::Constant(4 * edge)}};
    }
    Loads loads() { return find_loads(world.network, pistons, world.state, world.model, grid()); }
    CoarseEnergy energy() { return coarse_energy(loads(), grid(), world.state, world.model); }
};

/// A variant at a step that has something to mend. Where the energy would rise a correction is refused.
World variant_to_mend(int k)
{
    World world = variant(k);
    const auto is_refused = [&] {
        WarmStep step(world);
        step.push_top(0.01);
        return step.scale().refused > 0;
    };
    for (int tries = 0; tries < 100 && is_refused(); ++tries) world.step();
    return world;
}

/// ∫ min(q_n − Σ_n λ, u_p) dλ up to the contact's normal impulse.
double asked_work(const Contact& contact)
{
    const double impulse = contact.normal_impulse();
    const double bend = (contact.target - contact.parting) / contact.compliance; // up to there it may not part faster
    const double rigid = bend > 0.0 ? std::min(bend, impulse) : 0.0;
    const double spring = impulse - rigid;
    return (rigid > 0.0 ? contact.parting * rigid : 0.0) +
           spring * (contact.target - contact.compliance * (rigid + 0.5 * spring));
}

/// ½ Σ m |Δv|² + ½ Σ 2/5 m |Δa|² between two states of motion.
double energy_between(const State& before, const State& after)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < before.count(); ++i) {
        const Body &m = before.body(i), &n = after.body(i);
        sum += 0.5 * before.mass(i) *
               ((n.velocity - m.velocity).squaredNorm() +
                   (n.rim_velocity - m.rim_velocity).squaredNorm() / inverse_inertia_factor);
    }
    return sum;
}

} // namespace

TEST_CASE("the coarse system has the curvature of the energy", "[pressure_scaling]")
{
    // If all loads grow by the same share c, the impulses on each body do so too, whatever the hats: with α = c
    // everywhere, which the hats add up to, ½ α·A α is the energy of c M⁻¹ Gᵀ λ.
    const int k = GENERATE(range(0, variants));
    CAPTURE(k);
    WarmStep step(variant(k));
    const auto loads = step.loads();
    const auto energy = step.energy();
    REQUIRE(loads.list.size() > 300);
    const Eigen::VectorXd alpha = Eigen::VectorXd::Constant(energy.power.size(), 0.3);

    double expected = 0.0, power = 0.0;
    std::vector<Vec3> push(step.world.state.count(), Vec3::Zero()), turn = push;
    std::vector<double> on_piston(step.world.model.pistons.size(), 0.0);
    for (const auto& load : loads.list) {
        push[load.a] += load.impulse;
        turn[load.a] += load.turn_a;
        if (load.b >= 0) push[load.b] -= load.impulse;
        if (load.b >= 0) turn[load.b] += load.turn_b;
        if (load.piston >= 0) on_piston[load.piston] -= load.impulse.dot(step.world.model.pistons[load.piston].guide);
        power += load.power;
    }
    for (std::size_t i = 0; i < push.size(); ++i)
        expected += 0.5 * step.world.state.body(i).inverse_mass *
                    (push[i].squaredNorm() + inverse_inertia_factor * turn[i].squaredNorm());
    for (std::size_t p = 0; p < on_piston.size(); ++p)
        expected += 0.5 / step.world.model.pistons[p].mass * on_piston[p] * on_piston[p];
    CHECK(0.5 * alpha.dot(energy.curvature * alpha) == within(1e-10, 0.09 * expected));
    CHECK(energy.power.dot(alpha) == within(1e-10, 0.3 * power));
}

TEST_CASE("a correction changes velocities by M⁻¹ Gᵀ of the impulses and keeps the cones", "[pressure_scaling]")
{
    const int k = GENERATE(range(0, variants));
    CAPTURE(k);
    WarmStep step(variant_to_mend(k));
    step.push_top(0.01);
    step.pistons.store(step.world.network, step.world.state);
    const State before = step.world.state;
    const Vec3 momentum = step.world.momentum();
    const auto wall_impulse = [&] {
        Vec3 sum = Vec3::Zero();
        for (const TileContacts& tile : step.world.network.contacts.walls)
            for (const std::size_t c : tile.indices()) sum += tile.impulse(c);
        return sum;
    };
    const Vec3 wall_before = wall_impulse();
    const auto report = step.scale();
    REQUIRE(report.corrections == 1);
    REQUIRE(report.refused == 0);
    CHECK(report.largest > 0.01);
    step.pistons.store(step.world.network, step.world.state);

    // What the walls gave more is what the spheres, and pistons, got; guides carry across and are left out.
    const double scale = momentum.norm() + wall_before.norm();
    CHECK((step.world.momentum() - momentum - (wall_impulse() - wall_before)).z() == Approx(0.0).margin(1e-12 * scale));

    double worst = 0.0;
    for_each_contact(step.world.network, [&](const TileContacts& contacts, std::size_t c, bool) {
        const Contact contact = contacts.contact(c);
        const double normal = contact.normal_impulse();
        CHECK(normal >= 0.0);
        worst = std::max(worst, (contact.impulse - normal * contact.normal).norm() - contact.friction * normal);
        if (contacts.has_rolling())
            worst = std::max(
                worst, (contacts.rolling_impulse(c).norm() - contacts.rolling(c).reach * normal) / standard_radius);
    });
    CHECK(worst < 1e-15 * step.world.mass());
    CHECK(energy_between(before, step.world.state) > 0.0);
}

TEST_CASE("a correction takes energy out and ends where it is least", "[pressure_scaling]")
{
    // The energy is ½ v·Mv − Σ ∫ min(q − Σλ, u_p) dλ; along the direction taken it is a parabola, so that right after a
    // step that was not cut, its slope Σ growth λ·y vanishes. It is measured from the contacts, after the fact.
    const int k = GENERATE(range(0, variants));
    CAPTURE(k);
    WarmStep step(variant_to_mend(k));
    step.push_top(0.01);
    const auto potential = [&] {
        double sum = 0.0;
        for_each_contact(step.world.network, [&](const TileContacts& contacts, std::size_t c, bool) {
            const Contact contact = contacts.contact(c);
            sum += asked_work(contact);
            if (contacts.has_moving_walls()) sum += contacts.wall(c).velocity.dot(contact.impulse);
            if (contacts.has_moving_walls() && contacts.has_rolling())
                sum += contacts.wall(c).spin.dot(contacts.rolling_impulse(c));
        });
        return sum;
    };
    const auto total = [&] {
        step.pistons.store(step.world.network, step.world.state);
        double sum = energy_between(
            [&] {
                State rest = step.world.state;
                for (Body& m : rest.bodies) m.velocity = m.rim_velocity = Vec3::Zero();
                return rest;
            }(),
            step.world.state);
        for (std::size_t p = 0; p < step.world.model.pistons.size(); ++p)
            sum += kinetic_energy(step.world.model.pistons[p], step.world.state.pistons[p]);
        return sum - potential();
    };
    const double before = total();
    REQUIRE(step.scale().refused == 0);
    CHECK(total() < before);
    const double after = total();
    CHECK(step.scale().corrections == 1);
    CHECK(total() <= after + 1e-12 * std::abs(after));
}

TEST_CASE("a solution is left as it is", "[pressure_scaling]")
{
    // At a solution λ·y = 0 in every contact, so α = 0 whatever the hats.
    const int k = GENERATE(range(0, variants));
    CAPTURE(k);
    WarmStep step(variant(k));
    SolverSettings solver = step.world.model.solver;
    solver.tolerance = 1e-9;
    solver.max_sweeps = 100000;
    const auto solve =
        solve_contacts(step.world.network, step.pistons, step.world.state.bodies, step.world.model.physics, solver);
    REQUIRE(solve.residual < 1e-6);
    step.pistons.store(step.world.network, step.world.state);
    double largest = 0.0;
    std::vector<Vec3> impulses;
    for_each_contact(step.world.network, [&](const TileContacts& contacts, std::size_t c, bool) {
        impulses.push_back(contacts.impulse(c));
        largest = std::max(largest, impulses.back().norm());
    });
    step.scale();
    step.pistons.store(step.world.network, step.world.state);
    std::size_t next = 0;
    double change = 0.0;
    for_each_contact(step.world.network, [&](const TileContacts& contacts, std::size_t c, bool) {
        change = std::max(change, (contacts.impulse(c) - impulses[next++]).norm());
    });
    CHECK(change < 100.0 * std::max(solver.tolerance, solve.residual) * largest);
}

TEST_CASE("loads that hang together are one network, and what is small goes with the largest", "[pressure_scaling]")
{
    Loads loads;
    const auto add = [&](std::int32_t a, std::int32_t b, std::int32_t piston = -1) {
        loads.list.emplace_back();
        loads.list.back().a = a;
        loads.list.back().b = b;
        loads.list.back().piston = piston;
    };
    for (std::int32_t i = 0; i < 50; ++i) add(i, -1); // each on a wall, alone
    for (std::int32_t i = 100; i < 200; ++i) add(i, i + 1);
    for (std::int32_t i = 300; i < 400; i += 2) add(i, i + 1); // pairs …
    for (std::int32_t i = 500; i < 599; ++i) add(i, i + 1);
    loads.first = {loads.list.size()};
    for (std::int32_t i = 300; i < 400; ++i) add(i, -1, 0); // … under one piston
    const auto networks = networks_of(loads, 600, 1);
    REQUIRE(networks.size() == 2);
    CHECK(networks[0].size() == 50 + 150 + 99); // a wall connects nothing
    REQUIRE(networks[1].size() == 100);
    CHECK(networks[1].front() == 50);
    CHECK(networks[1].back() == 149);
    const Loads under_piston = part_of(loads, networks[0]);
    CHECK(under_piston.first_of_pistons() == 50 + 50 + 99);
    CHECK(under_piston.list[50 + 50 + 99].piston == 0);
    CHECK(networks_of({{0}, {}}, 600, 1).size() == 1);
}

} // namespace talus::test
