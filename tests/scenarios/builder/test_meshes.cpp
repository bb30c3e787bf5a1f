// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/builder/build_scene.hpp"
#include "scenarios/builder/meshes.hpp"
#include "tests/scenarios/small_scene.hpp"

#include <catch2/catch.hpp>

using namespace talus;
using namespace talus::test;
using Catch::Matchers::Contains;

namespace
{

/// A tetrahedron, and a triangle on the line from its first corner to its second.
scene::WallTable tetrahedron()
{
    scene::WallTable wall;
    wall.name = "cup";
    wall.shape = "mesh";
    wall.material = "glass";
    wall.mesh = "cup.stl";
    wall.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(0.5, 0, 0)};
    wall.triangles = {{0, 1, 2}, {0, 1, 4}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
    return wall;
}

} // namespace

TEST_CASE("triangles without area are left out, and told with their file and number", "[meshes]")
{
    auto scene = small_scene();
    scene.wall.push_back(tetrahedron());
    const auto [simulation, report, output] = build_scene(scene);
    CHECK(std::get<Mesh>(simulation.model.walls[1].shape).triangles.size() == 4);
    REQUIRE(report.warnings.size() == 1);
    CHECK(report.warnings[0] ==
          "wall 'cup': 1 of 5 triangles have no area and are left out, first triangle 2 of 'cup.stl'");
    scene.wall[1].triangles = {{0, 1, 4}};
    CHECK_THROWS_WITH(build_scene(scene), "no triangle of 'cup.stl' has an area");
}

TEST_CASE("a triangle beyond all sense is refused with its file and number", "[meshes]")
{
    auto scene = small_scene();
    scene.wall.push_back(tetrahedron());
    const double far = GENERATE(1e8, 1e200);
    scene.wall[1].vertices[3].z() = far;
    CHECK_THROWS_WITH(build_scene(scene), Contains("triangle 3 of 'cup.stl' reaches more than 1e9 diameters"));
}

TEST_CASE("a mesh that is open says where", "[meshes]")
{
    auto table = tetrahedron();
    CHECK(holes_in_words(build_mesh(table, 0.01, ""), 0.01).empty());
    table.triangles.pop_back();
    CHECK(holes_in_words(build_mesh(table, 0.01, ""), 0.01) ==
          "a hole of 3 edges of one triangle only, 4.24 m in all, round (0.3333, 0.3333, 0.3333)");
}

TEST_CASE("a mesh of more than a thousand diameters is warned of", "[meshes]")
{
    auto scene = small_scene();
    scene.wall.push_back(tetrahedron());
    scene.wall[1].triangles.erase(scene.wall[1].triangles.begin() + 1);
    for (Vec3& vertex : scene.wall[1].vertices) vertex *= 11.0;
    const auto warnings = build_scene(scene).report.warnings;
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0], Contains("wall 'cup' is 11 m long, 1.1e+03 diameters") && Contains("scale = 0.001"));
}
