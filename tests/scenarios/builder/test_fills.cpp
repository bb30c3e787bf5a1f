// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/builder/build_scene.hpp"
#include "scenarios/builder/checks.hpp"
#include "tests/scenarios/small_scene.hpp"
#include "tests/support/regions.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace talus;
using namespace talus::test;
using Catch::Matchers::Contains;

namespace
{

double mass_of(const State& state)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < state.count(); ++i) sum += state.mass(i);
    return sum;
}

/// The small scene in a room for thousands of its beads.
scene::Scene roomy_scene()
{
    auto scene = small_scene();
    scene.wall[0].min = scene.fill[0].region.min = Vec3::Zero();
    scene.wall[0].max = scene.fill[0].region.max = Vec3::Constant(0.2);
    scene.fill[0].count = 0;
    return scene;
}

scene::FillTable ball(double diameter, const Vec3& position)
{
    scene::FillTable fill;
    fill.arrangement = "single";
    fill.material = "glass";
    fill.diameter.value = diameter;
    fill.position = position;
    return fill;
}

} // namespace

TEST_CASE("a fill by mass or by the share of its region meets it to one sphere", "[fills]")
{
    auto scene = roomy_scene();
    scene.seed = GENERATE(range(1, 6));
    scene.fill[0].arrangement = GENERATE(as<std::string>{}, "lattice", "random", "dense");
    scene.fill[0].diameter = {.distribution = "normal", .mean = 0.01, .deviation = 0.004, .min = 0.004, .max = 0.018};
    scene.fill[0].mass = 1.0;
    const double largest = 2500.0 * std::numbers::pi / 6.0 * std::pow(0.018, 3);
    CHECK(mass_of(build_scene(scene).simulation.state) == Approx(1.0).margin(0.5 * largest));
    scene.fill[0].mass = 0.0;
    scene.fill[0].filling = 0.05;
    const auto simulation = build_scene(scene).simulation;
    CHECK(mass_of(simulation.state) == Approx(2500.0 * 0.05 * 0.008).margin(0.5 * largest));
    scene.fill[0].count = 3;
    CHECK_THROWS_WITH(build_scene(scene), "give 'count', 'mass' or 'filling', only one of them");
}

TEST_CASE("species and the classes of a sieve analysis have their shares of the mass to one sphere", "[fills]")
{
    auto scene = roomy_scene();
    scene.materials.push_back({"steel", 7800.0});
    for (const auto* other : {"glass", "steel"}) scene.contact.push_back({{"steel", other}});
    scene.seed = GENERATE(range(1, 6));
    const bool by_mass = GENERATE(false, true);
    scene::FillTable& fill = scene.fill[0];
    fill.material.clear();
    fill.diameter = {};
    fill.species = {{"glass", {.distribution = "uniform", .min = 0.004, .max = 0.012}, 3.0},
        {"steel",
            {.distribution = "sieve",
                .file = "s.csv",
                .sieve_sizes = {0.004, 0.008, 0.012},
                .sieve_passing = {0, 0.4, 1}},
            1.0}};
    fill.count = by_mass ? 0 : 561;
    fill.mass = by_mass ? 1.0 : 0.0;
    const State state = build_scene(scene).simulation.state;
    double glass = 0.0, fine = 0.0, coarse = 0.0;
    for (std::size_t i = 0; i < state.count(); ++i) {
        double& part = state.material[i] == 0 ? glass : state.radius[i] < 0.004 ? fine : coarse;
        part += state.mass(i);
    }
    const double all = mass_of(state), of_steel = 7800.0 * std::numbers::pi / 6.0;
    CHECK(glass == Approx(0.75 * all).margin(of_steel * std::pow(0.012, 3)));
    CHECK(fine == Approx(0.4 * 0.25 * all).margin(of_steel * std::pow(0.012, 3)));
    CHECK(coarse == Approx(0.6 * 0.25 * all).margin(of_steel * std::pow(0.012, 3)));
}

TEST_CASE("a fill of less than one sphere is refused, with what one has", "[fills]")
{
    auto scene = roomy_scene();
    scene.fill[0].diameter = {.distribution = "uniform", .min = 0.5, .max = 4.0}; // m for mm
    scene.fill[0].mass = 0.15;
    CHECK_THROWS_WITH(build_scene(scene), Contains("this is less than one sphere, which has") &&
                                              Contains("kg on average: check sizes, density and units"));
}

TEST_CASE("a fill that is given no spheres is warned of", "[fills]")
{
    auto scene = roomy_scene();
    scene.fill.push_back(ball(0.01, Vec3::Constant(0.1)));
    const auto warnings = build_scene(scene).report.warnings;
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0] == "fill[0] has no spheres: it has no 'count', 'mass' or 'filling'");
}

TEST_CASE("a single sphere is where the scene puts it, and others keep clear of it", "[fills]")
{
    auto scene = roomy_scene();
    scene.fill[0].count = 1000;
    scene.fill.insert(scene.fill.begin(), ball(0.05, Vec3(0.1, 0.1, 0.05)));
    scene.fill[0].velocity = Vec3(1, 2, 3);
    const auto simulation = build_scene(scene).simulation;
    CHECK(simulation.state.count() == 1001);
    CHECK(simulation.state.position[0] == Vec3(0.1, 0.1, 0.05));
    CHECK(simulation.state.radius[0] == 0.025);
    CHECK(simulation.state.body(0).velocity == Vec3(1, 2, 3));
    CHECK(simulation.model.max_diameter == 0.05);
    CHECK(check_overlaps(simulation).count == 0);
}

TEST_CASE("a temperature gives normal velocities of that mean square along each axis", "[fills]")
{
    auto scene = roomy_scene();
    scene.fill[0].count = 4000;
    scene.fill[0].velocity = Vec3(0, 0, 2);
    scene.fill[0].temperature = 0.25;
    const auto state = build_scene(scene).simulation.state;
    Vec3 sum = Vec3::Zero(), squares = Vec3::Zero(), fourths = Vec3::Zero();
    for (const Body& m : state.bodies) {
        const Vec3 v = m.velocity - Vec3(0, 0, 2);
        sum += v / 4000.0;
        squares += v.cwiseAbs2() / 4000.0;
        fourths += v.cwiseAbs2().cwiseAbs2() / 4000.0;
    }
    for (int d = 0; d < 3; ++d) {
        CHECK(std::abs(sum[d]) < 4 * 0.5 / std::sqrt(4000.0));
        CHECK(squares[d] == Approx(0.25).epsilon(4 * std::sqrt(2.0 / 4000.0)));
        CHECK(fourths[d] == Approx(3 * 0.0625).epsilon(0.25)); // three times the square of the variance
    }
}

TEST_CASE("each of two species may have all spheres of a fill, and needs a contact with its own kind", "[fills]")
{
    auto scene = roomy_scene();
    scene.materials.push_back({"lead", 11340.0});
    scene.contact.push_back(scene.contact[0]);
    scene.contact[1].between = {"glass", "lead"};
    scene.fill[0].material.clear();
    scene.fill[0].diameter = {};
    scene.fill[0].species = {{"glass", {.value = 0.01}, 1.0}, {"lead", {.value = 0.01}, 1.0}};
    scene.fill[0].count = 2;
    CHECK_THROWS_WITH(build_scene(scene), Contains("no [[contact]] between lead and lead"));
}

TEST_CASE("a sphere that is alone needs no contact with its own kind", "[fills]")
{
    auto scene = roomy_scene();
    scene.materials.push_back({"lead", 11340.0});
    scene.fill.push_back(ball(0.05, Vec3::Constant(0.1)));
    scene.fill[1].material = "lead";
    CHECK_THROWS_WITH(build_scene(scene), Contains("no [[contact]] between glass and lead"));
    scene.contact.push_back(scene.contact[0]);
    scene.contact[1].between = {"glass", "lead"};
    CHECK(build_scene(scene).simulation.state.count() == 1);
    scene.fill.push_back(ball(0.05, Vec3::Constant(0.05)));
    scene.fill[2].material = "lead";
    CHECK_THROWS_WITH(build_scene(scene), Contains("no [[contact]] between lead and lead"));
}

TEST_CASE("a fill stays on one side of a closed wall: in a drum, and not in a shaft", "[fills]")
{
    auto scene = roomy_scene();
    const bool is_mesh = GENERATE(true, false), is_drum = GENERATE(true, false);
    const Vec3 half = is_drum ? Vec3::Constant(0.09) : Vec3(0.03, 0.03, 0.1), middle = Vec3::Constant(0.1);
    scene::WallTable wall;
    wall.name = "closed";
    wall.material = "glass";
    wall.shape = is_mesh ? "mesh" : "box";
    wall.min = middle - half;
    wall.max = middle + half;
    const Mesh mesh = box_mesh({wall.min, wall.max});
    wall.vertices = mesh.vertices;
    wall.triangles = mesh.triangles;
    scene.wall.push_back(wall);
    scene.fill[0].arrangement = GENERATE(as<std::string>{}, "lattice", "random", "dense");
    scene.fill[0].count = is_drum ? 1000 : 2000;
    const auto simulation = build_scene(scene).simulation;
    REQUIRE(simulation.state.count() == static_cast<std::size_t>(scene.fill[0].count));
    for (const Vec3& x : simulation.state.position) CHECK(Box{wall.min, wall.max}.contains(x) == is_drum);
}

TEST_CASE("a fill leaves free what it is told to", "[fills]")
{
    auto scene = roomy_scene();
    scene.fill[0].arrangement = GENERATE(as<std::string>{}, "lattice", "random", "dense");
    scene.fill[0].count = 1000;
    scene::RegionTable ball{.shape = "sphere", .center = Vec3::Constant(0.1), .radius = 0.06};
    scene::RegionTable shaft{.shape = "cone", .base_radius = 0.05, .top_radius = 0.02, .height = 0.2};
    scene.fill[0].except = {ball, shaft};
    const auto state = build_scene(scene).simulation.state;
    REQUIRE(state.count() == 1000);
    const Region tip = require_region(shaft, 0.01, "");
    for (std::size_t i = 0; i < state.count(); ++i) {
        CHECK((state.position[i] - ball.center).norm() >= ball.radius + state.radius[i]);
        CHECK(tip.depth(state.position[i]) <= -state.radius[i]);
    }
}

TEST_CASE("a dense fill of mixed sizes takes 0.55 of its region before it settles", "[fills]")
{
    auto scene = roomy_scene();
    scene.fill[0].arrangement = "dense";
    scene.fill[0].material.clear();
    scene.fill[0].diameter = {};
    scene.fill[0].species = {{"glass", {.value = 0.004}, 1.0}, {"glass", {.value = 0.01}, 1.0}};
    const auto shape = GENERATE(as<std::string>{}, "box", "cylinder", "cone", "sphere");
    scene::RegionTable& region = scene.fill[0].region;
    region.shape = shape;
    region.max = Vec3::Constant(0.08);
    region.base = Vec3(0.1, 0.1, 0.0);
    region.height = 0.08;
    region.base_radius = 0.04;
    region.top_radius = 0.06;
    region.center = Vec3::Constant(0.1);
    region.radius = 0.05;
    scene.fill[0].filling = 0.56;
    const auto simulation = build_scene(scene).simulation;
    const auto& state = simulation.state;
    const Region filled = require_region(region, 0.01, "");
    CHECK(mass_of(state) / 2500.0 / filled.volume() >= 0.55);
    for (std::size_t i = 0; i < state.count(); ++i) CHECK(filled.contains(state.position[i], state.radius[i]));
    CHECK(check_overlaps(simulation).count == 0);
    scene.fill[0].filling = 0.7;
    CHECK_THROWS_WITH(build_scene(scene), Contains("0.70 of its region"));
}

TEST_CASE("a region inside a mesh is refused where the mesh is open", "[fills]")
{
    auto scene = roomy_scene();
    const Mesh mesh = box_mesh({Vec3::Constant(0.05), Vec3::Constant(0.15)});
    scene.fill[0].region = {.shape = "mesh", .mesh = "bin.stl", .vertices = mesh.vertices, .triangles = mesh.triangles};
    scene.fill[0].count = 300;
    for (const Vec3& x : build_scene(scene).simulation.state.position)
        CHECK(Box{Vec3::Constant(0.05), Vec3::Constant(0.15)}.contains(x));
    scene.fill[0].region.triangles.pop_back();
    CHECK_THROWS_WITH(build_scene(scene),
        Contains(
            "nothing is inside of 'bin.stl': it has a hole of 3 edges of one triangle only, 0.341 m in all, round ("));
}
