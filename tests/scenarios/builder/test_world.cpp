// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/builder/build_report.hpp"
#include "scenarios/builder/build_scene.hpp"
#include "tests/scenarios/small_scene.hpp"

#include <catch2/catch.hpp>

using namespace talus;
using namespace talus::test;

namespace
{

scene::WallTable plane(const Vec3& point, const Vec3& normal)
{
    scene::WallTable wall;
    wall.name = "plane";
    wall.shape = "plane";
    wall.material = "glass";
    wall.point = point;
    wall.normal = normal;
    return wall;
}

Box world_of(const scene::Scene& scene)
{
    return build_scene(scene).simulation.model.world;
}

} // namespace

TEST_CASE("a world with a floor that is a plane has no end to its sides, and begins below the plane", "[world]")
{
    auto scene = small_scene();
    scene.wall[0] = plane(Vec3(0, 0, -1), Vec3(0, 0, 2));
    const Box world = world_of(scene);
    CHECK(world.min.x() == -infinity);
    CHECK(world.min.y() == -infinity);
    CHECK(world.min.z() == Approx(-1.05));
    CHECK(world.max == Vec3::Constant(infinity));
    scene.world.max.x() = 3.0;
    CHECK(world_of(scene).max.x() == 3.0);
}

TEST_CASE("a world between upright planes ends a little behind them", "[world]")
{
    auto scene = small_scene();
    scene.wall.push_back(plane(Vec3(-2, 0, 0), Vec3::UnitX()));
    auto& motion = scene.wall.back().motion.emplace_back();
    motion.kind = "translate";
    motion.velocity = Vec3(-1, 0, 0);
    motion.to = 0.5;
    CHECK(world_of(scene).min.x() == Approx(-2.55));
    CHECK(std::isfinite(world_of(scene).max.y()));
}

TEST_CASE("the bounds of a world are reported axis by axis", "[world]")
{
    CHECK(explain_world({Vec3(0, -infinity, -infinity), Vec3(infinity, 1.5, infinity)}) ==
          "x from 0 up, y up to 1.5, z without end, in m");
}
