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

TEST_CASE("a fill by mass or by the share of its region has as many spheres as that is", "[fills]")
{
    auto scene = roomy_scene();
    scene.fill[0].diameter = {.distribution = "uniform", .min = 0.008, .max = 0.012};
    scene.fill[0].mass = 1.0;
    CHECK(mass_of(build_scene(scene).simulation.state) == Approx(1.0).epsilon(0.05)); // of 735 spheres
    scene.fill[0].mass = 0.0;
    scene.fill[0].filling = 0.2;
    const auto simulation = build_scene(scene).simulation;
    CHECK(mass_of(simulation.state) / 2500.0 == Approx(0.2 * 0.008).epsilon(0.03)); // of 2937
    scene.fill[0].count = 3;
    CHECK_THROWS_WITH(build_scene(scene), "give 'count', 'mass' or 'filling', only one of them");
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
    const Region tip = require_region(shaft, "");
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
    scene.fill[0].filling = 0.59; // as the mean sphere has it: a draw of few large ones differs by 4 %
    const auto simulation = build_scene(scene).simulation;
    const auto& state = simulation.state;
    const Region filled = require_region(region, "");
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
    CHECK_THROWS_WITH(build_scene(scene), "nothing is inside of 'bin.stl': 3 of its edges have one triangle only");
}
