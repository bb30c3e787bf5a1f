// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/builder/build_scene.hpp"
#include "scenarios/builder/spheres.hpp"
#include "tests/scenarios/small_scene.hpp"

#include <catch2/catch.hpp>

#include <map>

using namespace talus;
using namespace talus::test;

namespace
{

scene::SpeciesTable species(const std::string& material, double diameter, double share)
{
    scene::SpeciesTable table;
    table.material = material;
    table.diameter.value = diameter;
    table.share = share;
    return table;
}

/// The small scene in a box of 0.3 m, with steel.
scene::Scene wide_scene()
{
    auto scene = small_scene();
    scene.materials.push_back({"steel", 7800.0});
    for (const auto& pair : {"glass", "steel"}) {
        scene::ContactTable contact;
        contact.between = {"steel", pair};
        scene.contact.push_back(contact);
    }
    scene.fill[0].region.max = scene.wall[0].max = Vec3::Constant(0.3);
    return scene;
}

/// The mass of the spheres of each material.
std::map<int, double> masses(const State& state)
{
    std::map<int, double> mass;
    for (std::size_t i = 0; i < state.count(); ++i) mass[state.material[i]] += state.mass(i);
    return mass;
}

} // namespace

TEST_CASE("a fill of two species has their shares of the mass, whatever their densities and sizes", "[insertion]")
{
    auto scene = wide_scene();
    auto& fill = scene.fill[0];
    fill.arrangement = GENERATE(as<std::string>{}, "lattice", "random");
    fill.count = 3000;
    fill.material.clear();
    fill.diameter = {};
    fill.species = {species("steel", 0.006, 1.0), species("glass", 0.009, 1.0)};
    const auto simulation = build_scene(scene).simulation;
    auto mass = masses(simulation.state);
    // By number nearly half are steel, so its share is uncertain by 1 %, and that of its mass as well.
    CHECK(mass[1] / (mass[0] + mass[1]) == Approx(0.5).margin(0.035));
    CHECK(simulation.model.min_diameter == 0.006);
    CHECK(simulation.model.max_diameter == 0.009);
    double sum = 0.0;
    for (std::size_t i = 0; i < simulation.state.count(); ++i) sum += 2.0 * simulation.state.radius[i];
    CHECK(simulation.model.mean_diameter == Approx(sum / 3000.0).epsilon(0.015));
}

TEST_CASE("a lattice has the mean volume of its sizes, in a region that cuts many of its places as well", "[insertion]")
{
    // A tube hardly two diameters wide: most places touch its wall, and small spheres would be less in the way.
    auto scene = wide_scene();
    auto& fill = scene.fill[0];
    fill.region.shape = "cylinder";
    fill.region.base = Vec3(0.15, 0.15, 0.0);
    fill.region.radius = 0.0175;
    fill.region.height = 20.0;
    scene.wall.clear();
    fill.diameter = {.distribution = "uniform", .min = 0.004, .max = 0.01};
    fill.count = 4000;
    const auto simulation = build_scene(scene).simulation;
    double volume = 0.0;
    for (std::size_t i = 0; i < simulation.state.count(); ++i) volume += simulation.state.mass(i) / 2500.0;
    const SizeDistribution sizes{.min = 0.004, .max = 0.01};
    // Relative spread of the volume of one sphere 0.75, so a standard error of 1.2 %.
    CHECK(volume / 4000.0 == Approx(sizes.mean_volume()).epsilon(0.036));
}

TEST_CASE("a pour by mass in the scene is one in the simulation", "[insertion]")
{
    auto scene = wide_scene();
    scene.pour.push_back(small_pour());
    auto& table = scene.pour[0];
    table.count = 0;
    table.rate = 0.0;
    table.mass = 0.02;
    table.mass_rate = 0.5;
    table.start = 0.03;
    table.material.clear();
    table.diameter = {};
    table.species = {species("steel", 0.006, 3.0), species("glass", 0.009, 1.0)};
    auto simulation = build_scene(scene).simulation;
    const auto& pour = simulation.pours.at(0);
    CHECK(pour.mixture.species.at(0).number > pour.mixture.species.at(1).number);
    while (simulation.state.time < 0.03) advance(simulation);
    CHECK(pour.poured == 0);
    while (simulation.state.time < 0.13) advance(simulation);
    CHECK(is_over(pour));
    CHECK(pour.poured_mass >= 0.02);
    CHECK(pour.poured_mass < 0.021);
    double mass = 0.0;
    for (std::size_t i = 0; i < simulation.state.count(); ++i)
        if (simulation.state.id[i] >= 20) mass += simulation.state.mass(i);
    CHECK(mass == Approx(pour.poured_mass));
}

TEST_CASE("spheres of a file get their places, sizes and velocities, and the fill's on top", "[insertion]")
{
    auto scene = wide_scene();
    auto& fill = scene.fill[0];
    fill.arrangement = "file";
    fill.count = GENERATE(0, 2);
    fill.diameter = {};
    fill.velocity = Vec3(0, 0, -1);
    fill.angular_velocity = Vec3(0, 1, 0);
    fill.spheres.positions = {Vec3(0.05, 0.05, 0.05), Vec3(0.1, 0.05, 0.05)};
    fill.spheres.radii = {0.004, 0.006};
    fill.spheres.velocities = {Vec3(1, 0, 0), Vec3(0, 1, 0)};
    const auto simulation = build_scene(scene).simulation;
    const auto& state = simulation.state;
    REQUIRE(state.count() == 2);
    CHECK(state.position[1] == Vec3(0.1, 0.05, 0.05));
    CHECK(state.radius[1] == Approx(0.006));
    CHECK(state.body(0).velocity == Vec3(1, 0, -1));
    CHECK(state.body(1).velocity == Vec3(0, 1, -1));
    CHECK(state.body(1).rim_velocity.isApprox(Vec3(0, 0.006, 0)));
    CHECK(simulation.model.min_diameter == 0.008);
    CHECK(simulation.model.max_diameter == 0.012);
    CHECK(simulation.model.mean_diameter == Approx(0.01));
}

TEST_CASE("a file without radii takes the fill's diameter, and later fills keep clear of its spheres", "[insertion]")
{
    auto scene = wide_scene();
    auto listed = scene.fill[0];
    listed.arrangement = "file";
    listed.count = 0;
    listed.diameter.value = 0.02;
    listed.spheres.positions = {Vec3(0.05, 0.05, 0.05), Vec3(0.1, 0.05, 0.01)};
    scene.fill[0].count = 1000;
    scene.fill.insert(scene.fill.begin(), listed);
    const auto simulation = build_scene(scene).simulation;
    CHECK(simulation.state.radius[1] == Approx(0.01));
    CHECK(simulation.state.count() == 1002);
    CHECK(check_overlaps(simulation).count == 0);
}

TEST_CASE("the world holds the spheres of a file", "[insertion]")
{
    auto scene = wide_scene();
    auto& fill = scene.fill[0];
    fill.arrangement = "file";
    fill.count = 0;
    fill.spheres.positions = {Vec3(-3.0, 0.05, 0.05)};
    const auto simulation = build_scene(scene).simulation;
    CHECK(simulation.model.world.min.x() == Approx(-3.05)); // five diameters
}
