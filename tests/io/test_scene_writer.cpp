// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene_file.hpp"
#include "tests/io/full_scene.hpp"
#include "tests/io/scene_folder.hpp"

#include <catch2/catch.hpp>

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
    CHECK(again.fill.at(1).species.at(0).diameter.sieve_sizes.size() == 2);
    CHECK(again.fill[1].species.at(1).diameter.median == 0.01);
    CHECK(again.fill.at(2).spheres.positions.at(0).isApprox(Vec3(0, 0, 2.01)));
}

TEST_CASE("every key of the defaults is in the resolved scene", "[scene_file]")
{
    const std::string resolved = resolved_scene(scene::Scene());
    CHECK(resolved.starts_with("title = \"\"\nseed = 1\n\n[time]\nstep = \"auto\"  # s\nduration = 1.0  # s\n"));
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
