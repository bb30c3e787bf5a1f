// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"

#include "tests/app/program.hpp"
#include "tests/support/world.hpp"

#include <cmath>

using namespace talus;
using namespace talus::test;

namespace
{

bool finite(const World& world)
{
    bool all = std::isfinite(world.report.bodies.kinetic_energy) && std::isfinite(world.report.solve.residual);
    for (std::size_t i = 0; i < world.state.count(); ++i)
        all = all && world.state.position[i].allFinite() && world.state.body(i).velocity.allFinite();
    return all;
}

/// Whether the program refuses a scene with exit code 2 and one sentence that names file and line and has this word.
bool refused(const std::string& scene, const std::string& word)
{
    const Workplace place;
    const Outcome outcome = place.run(scene);
    INFO(outcome.err);
    const bool told = outcome.err.rfind("scene.toml:", 0) == 0 && outcome.err.find(word) != std::string::npos &&
                      outcome.err.find('\n') == outcome.err.size() - 1;
    CHECK(told);
    return told && outcome.exit_code == 2 && !place.exists("out");
}

/// Beads from a list of spheres, some of which cannot be.
bool list_refused(const std::string& row, const std::string& word)
{
    const Workplace place;
    place.write("beads.csv", "x,y,z,radius\n0.01,0.01,0.01,0.005\n" + row + "\n");
    place.write("scene.toml",
        replaced(beads_in_a_box,
            "count = 8\ndiameter = 0.01\nregion = { shape = \"box\", min = [0, 0, 0], max = [0.05, 0.05, 0.05] }",
            "arrangement = \"file\"\nfile = \"beads.csv\""));
    const Outcome outcome = place.talus("run scene.toml -o out --threads 1");
    INFO(outcome.err);
    const bool told = outcome.exit_code == 2 && outcome.err.find("beads.csv") != std::string::npos &&
                      outcome.err.find(word) != std::string::npos;
    CHECK(told);
    return told;
}

} // namespace

TEST_CASE("28 degenerate scenes", "[hard][quick]")
{
    // Nothing to do, and what cannot be. Sums over nothing, a residual of 0/0, a mean diameter without spheres and the
    // inverse of a mass of zero are where programs of this kind stop with a fault, or go on with what is not a number.
    HardCase hard("28 degenerate scenes");
    for (const auto law : {Stabilisation::matched, Stabilisation::projected}) {
        const std::string name = name_of(law) + ": ";
        const double h = 2.5e-4;
        World empty = make_world({.friction = 0.5, .rolling_friction = 0.1}, production_settings(law), h);
        empty.add_plane(Vec3::Zero(), Vec3::UnitZ());
        empty.step(10);
        hard.holds(name + "no spheres: ten steps of nothing",
            finite(empty) && empty.report.contacts.count == 0 && empty.report.solve.converged);

        World fixed = make_world({.friction = 0.5}, production_settings(law), h);
        fixed.add_wall(grain_bed({Vec3::Zero(), Vec3(0.05, 0.05, 0)}, 0.01, 0.009));
        fixed.add_plane(Vec3(0, 0, 0.003), Vec3::UnitZ());
        fixed.step(10);
        hard.holds(name + "all fixed: grains that overlap each other and a plane",
            finite(fixed) && fixed.report.contacts.count == 0);

        World alone = make_world({.friction = 0.5, .restitution = 0.5}, production_settings(law), h);
        alone.model.gravity.setZero();
        alone.add_sphere(Vec3::Zero(), Vec3(1, 2, 3), Vec3(10, 0, 0));
        alone.step(1000);
        hard.below(name + "one sphere without gravity: error of its place [d]",
            (alone.position() - 1000 * h * Vec3(1, 2, 3)).norm() / 0.01, 1e-12);
        hard.holds(name + "one sphere: converged, and no more sweeps than the least",
            alone.report.solve.sweeps <= 3 && alone.report.solve.converged);

        World dots = make_world({.friction = 0.5}, production_settings(law), h);
        for (int k = 0; k < 10; ++k) dots.add_sphere(Vec3(0.02 * k, 0, 0));
        dots.step(1000);
        hard.holds(name + "ten spheres that never touch fall alike",
            finite(dots) && dots.report.contacts.count == 0 && (dots.velocity(0) - dots.velocity(9)).norm() == 0.0);
    }

    const std::string& good = beads_in_a_box;
    hard.holds("program: no spheres is refused", refused(replaced(good, "count = 8", "count = 0"), "no spheres"));
    hard.holds("program: nothing but fixed grains is refused",
        refused(replaced(good, "count = 8", "count = 0") + "[[wall]]\nname = \"bed\"\nshape = \"grains\"\nmaterial = "
                                                           "\"glass\"\nmax = [0.05, 0.05, 0]\ndiameter = 0.01\n",
            "no spheres"));
    hard.holds(
        "program: density 0 is refused", refused(replaced(good, "density = 2500.0", "density = 0.0"), "density"));
    hard.holds("program: a diameter below 0 is refused",
        refused(replaced(good, "diameter = 0.01", "diameter = -0.01"), "diameter"));
    hard.holds("program: a diameter of 0 is refused",
        refused(replaced(good, "diameter = 0.01", "diameter = 0.0"), "diameter"));
    hard.holds("program: a count below 0 is refused", refused(replaced(good, "count = 8", "count = -8"), "count"));
    hard.holds("program: friction below 0 is refused",
        refused(replaced(good, "friction = 0.5", "friction = -0.5"), "friction"));
    hard.holds("program: a radius below 0 in a list is refused", list_refused("0.03,0.03,0.03,-0.005", "radius"));
    hard.holds("program: a radius of 0 in a list is refused", list_refused("0.03,0.03,0.03,0", "radius"));
    hard.holds(
        "program: a place that is not a number in a list is refused", list_refused("nan,0.03,0.03,0.005", "nan"));

    const Workplace place;
    const Outcome one = place.run(replaced(good, "count = 8", "count = 1"));
    hard.holds("program: one sphere runs", one.exit_code == 0);
    const Workplace still;
    const Outcome space = still.run(replaced(
        replaced(good, "[time]", "[world]\ngravity = [0, 0, 0]\n[time]\nstep = 1e-4"), "count = 8", "count = 1"));
    hard.holds("program: one sphere without gravity or speed runs", space.exit_code == 0);
}
