// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/scene_file.hpp"
#include "tests/io/full_scene.hpp"
#include "tests/io/scene_folder.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace talus;
using namespace talus::test;

TEST_CASE("the resolved scene reads back to itself, from another folder too", "[scene_file]")
{
    const SceneFolder folder, elsewhere;
    write_named_files(folder);
    const std::string resolved = resolved_scene(read_scene(folder.write("scene.toml", full_scene)).scene);
    const scene::Scene again = read_scene(elsewhere.write("scene.resolved.toml", resolved)).scene;
    CHECK(resolved_scene(again) == resolved);
    CHECK(again.title == "A \"quoted\" title, a tab\t, a \\ and µ");
    CHECK(again.fill[0].region.radius == 0.3333333333333333); // to the last bit
    CHECK(again.time.frame_interval == infinity);
    CHECK(again.contact[0].between == std::vector<std::string>{"glass", "dark wood"});
    CHECK(again.wall[1].triangles.size() == 1);
    CHECK(again.world.periodic == std::vector<std::string>{"x"});
    CHECK_FALSE(again.world.rotation);
    REQUIRE(again.wall.size() == 6);
    CHECK(again.wall[2].spacing == 1.25);
    REQUIRE(again.wall[2].motion.size() == 2);
    CHECK(again.wall[2].motion[0].frequency == 30.0);
    CHECK(again.wall[2].motion[1].rate == -0.3333333333333333);
    CHECK(again.wall[2].motion[1].to == 2.0);
    REQUIRE(again.wall[3].motion.size() == 2);
    CHECK(again.wall[3].motion[0].velocity == Vec3(0, 0, -0.1));
    REQUIRE(again.wall[3].motion[1].table.size() == 2);
    CHECK(again.wall[3].motion[1].table[1].time == 0.1);
    CHECK(again.wall[3].motion[1].table[1].shift == Vec3(0, 0, 0.3333333333333333));
    CHECK(again.wall[3].mass == infinity);
    CHECK(again.wall[3].load.empty());
    REQUIRE(again.wall[4].load.size() == 2);
    CHECK(again.wall[4].load[1].time == 1.0);
    CHECK(again.wall[4].load[1].force == 0.3333333333333333);
    CHECK(again.wall[4].released_at == 0.25);
    CHECK(again.wall[5].mass == 0.3333333333333333);
    REQUIRE(again.wall[5].load.size() == 1);
    CHECK(again.wall[5].load[0].time == 0.0);
    CHECK(again.wall[5].load[0].force == -5.0);
    CHECK(again.fill.at(1).species.at(0).diameter.sieve_sizes.size() == 2);
    CHECK(again.fill[1].species.at(1).diameter.median == 0.01);
    CHECK(again.fill.at(2).spheres.positions.at(0).isApprox(Vec3(0, 0, 2.01)));
}

TEST_CASE("every key of the defaults is in the resolved scene", "[scene_file]")
{
    const std::string resolved = resolved_scene(scene::Scene());
    CHECK(resolved.starts_with(
        "title = \"\"\nseed = 1\naccuracy = \"\"\n\n[time]\nstep = \"auto\"  # s\nduration = 1.0  # s\n"));
    CHECK(resolved.find("[world]\ngravity = [0.0, 0.0, -9.81]  # m/s2\nmin = [-inf, -inf, -inf]  # m\n") !=
          std::string::npos);
}

TEST_CASE("the resolved scene has no key that its shapes lack", "[scene_file]")
{
    scene::Scene scene;
    scene.wall.emplace_back().shape = "plane";
    const std::string resolved = resolved_scene(scene);
    CHECK(resolved.find("\nnormal = ") != std::string::npos);
    CHECK(resolved.find("radius") == std::string::npos);
    CHECK(resolved.find("mesh") == std::string::npos);
}

TEST_CASE("the keys in which two scenes differ are named", "[scene_file]")
{
    const SceneFolder folder;
    write_named_files(folder);
    const scene::Scene before = read_scene(folder.write("scene.toml", full_scene)).scene;
    CHECK(changed_keys(before, parse_scene(resolved_scene(before))).empty());

    scene::Scene after = before;
    after.seed = 8;
    after.time.duration = 4.0;
    after.contact[0].friction = 0.2;
    after.fill[0].region.radius = 0.5;
    after.materials[0].density = 1.0;
    CHECK(changed_keys(before, after) == std::vector<std::string>{"seed", "time.duration",
                                             "materials.dark wood.density", "contact[0].friction", "fill[0].region"});
    after = before;
    after.wall[0].shape = "plane";
    after.sensor.clear();
    const std::vector<std::string> changed = changed_keys(before, after);
    for (const char* key : {"wall[0].shape", "wall[0].normal", "sensor", "wall[0].max", "sensor[0].kind"})
        CHECK(std::ranges::find(changed, key) != changed.end());
}
