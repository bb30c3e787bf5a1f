// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"

#include "tests/support/world.hpp"
#include "tests/validation/run_scene.hpp"

#include "core/contacts/loads.hpp"

#include <algorithm>
#include <cmath>
#include <map>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr int steps = 100000;

/// Numbers of loaded contacts, by id.
std::map<std::int64_t, int> loaded_contacts(const Simulation& simulation)
{
    const auto& id = simulation.state.id;
    std::map<std::int64_t, int> count;
    for_each_loaded_sphere_contact(simulation.network, [&](const Contact& contact) {
        ++count[id[contact.a]];
        ++count[id[contact.b]];
    });
    for_each_loaded_wall_contact(simulation.network, [&](const Contact& contact) { ++count[id[contact.a]]; });
    return count;
}

struct Drift {
    double center = 0.0;  ///< of the centre of mass of the supported spheres, at most [d]
    double largest = 0.0; ///< of a supported sphere [d]
    double loose = 0.0;   ///< of any other [d]
    double height = 0.0;  ///< of the centre of mass of all, downwards [d]
    int loose_count = 0;
};

/// How far spheres come from where they are in 1e5 steps, seen every thousand.
Drift drift(Simulation& simulation)
{
    const State& state = simulation.state;
    const double d = simulation.model.mean_diameter;
    advance(simulation);
    auto contacts = loaded_contacts(simulation);
    std::map<std::int64_t, Vec3> place;
    for (std::size_t i = 0; i < state.count(); ++i) place[state.id[i]] = state.position[i];
    Drift result;
    for (const auto& [id, x] : place) result.loose_count += contacts[id] < 3;
    for (int k = 1; k <= steps; ++k) {
        advance(simulation);
        if (k % 1000 != 0) continue;
        Vec3 moment = Vec3::Zero();
        double mass = 0.0, mass_of_all = 0.0;
        result.height = 0.0;
        for (std::size_t i = 0; i < state.count(); ++i) {
            const Vec3 way = (state.position[i] - place.at(state.id[i])) / d;
            const bool supported = contacts[state.id[i]] >= 3;
            double& largest = supported ? result.largest : result.loose;
            largest = std::max(largest, way.norm());
            result.height -= state.mass(i) * way.z();
            mass_of_all += state.mass(i);
            if (!supported) continue;
            moment += state.mass(i) * way;
            mass += state.mass(i);
        }
        result.center = std::max(result.center, moment.norm() / mass);
        result.height /= mass_of_all;
    }
    return result;
}

} // namespace

TEST_CASE("19 rest of a pile of 1000", "[hard]")
{
    // A pile that has come to rest must stay where it is. A bead without rolling resistance that touches the plate, or
    // two others, only is not held by anything: it rolls on for ever with whatever speed it has, as it should. So the
    // horizontal drift is asked of those that rest on three contacts or more, and that of the others is reported; a
    // pile that sinks, all beads included, would show in the height of its centre.
    HardCase hard("19 rest of a pile of 1000");
    for (const std::string law : {"matched", "projected"}) {
        auto s = open_scene("pile_plain",
            {"pour.source.count=1000", "wall.plate.radius=0.1", "wall.lip.radius=0.1", "solver.stabilisation=" + law});
        run_until(s, 6.0); // the last bead rolls into its place between 4 and 6 s
        const Drift found = drift(s);
        hard.below(law + ": drift of the centre of mass [d]", found.center, 1e-4);
        hard.below(law + ": its way down, loose beads included [d]", std::abs(found.height), 1e-4);
        hard.below(law + ": drift of a bead [d]", found.largest, 1e-2);
        hard.below(law + ": beads on one or two contacts", found.loose_count, 250);
        hard.tell(law + ": drift of one of these [d]", found.loose);
    }
}

TEST_CASE("19 no creep on an incline", "[hard]")
{
    // Spheres that do not turn, at tan θ = 0.9 μ: one alone, and a pyramid. Friction with a compliance would let them
    // creep by Σ_t m g h sin θ; a cold start would let them slip a little in each step.
    HardCase hard("19 no creep on an incline");
    constexpr double d = 2 * standard_radius, r = standard_radius, friction = 0.5;
    const double angle = std::atan(0.9 * friction);
    for (const auto law : {Stabilisation::matched, Stabilisation::projected}) {
        World world = production_world({.friction = friction}, law);
        world.model.physics.spin = false;
        world.model.gravity = standard_gravity * Vec3(std::sin(angle), 0, -std::cos(angle));
        world.add_plane(Vec3::Zero(), Vec3::UnitZ());
        world.add_sphere(Vec3(0, 0.1, r));
        world.add_sphere(Vec3(1.25 * r, 0, r));
        world.add_sphere(Vec3(-0.6 * r, 1.1 * r, r));
        world.add_sphere(Vec3(-0.65 * r, -1.12 * r, r));
        world.add_sphere(Vec3(0, 0, 2.6 * r));
        world.step(2000);
        const World before = world;
        const auto creep = [&](int first, int last) {
            double largest = 0.0;
            for (int id = first; id <= last; ++id)
                largest = std::max(largest, (world.position(id) - before.position(id)).norm() / d);
            return largest;
        };
        const std::string name = name_of(law) + ": ";
        world.step(steps);
        hard.below(name + "creep of a sphere in 1e5 steps [d]", creep(0, 0), 1e-9);
        hard.below(name + "creep of a pyramid in 1e5 steps [d]", creep(1, 4), 1e-9);
        hard.above(name + "height of its top [d]", world.position(4).z() / d, 1.0);
        world = before;
        for (int k = 0; k < steps / 10; ++k) {
            world.network = {};
            world.step();
        }
        hard.tell(name + "no warm start: creep of a sphere in 1e4 steps [d]", creep(0, 0));
        hard.tell(name + "no warm start: creep of a pyramid in 1e4 steps [d]", creep(1, 4));
    }
}
