// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/scene_file.hpp"
#include "io/text/input_error.hpp"
#include "tests/io/scene_folder.hpp"

#include <catch2/catch.hpp>

using namespace talus;
using namespace talus::test;

namespace
{

const char* const scene_text = R"(
[materials.glass]
[materials.steel]
[[contact]]
between = ["glass", "steel"]
[[fill]]
material = "glass"
count = 10
diameter = 0.01
region = { max = [1, 1, 1] }
[[fill]]
material = "steel"
count = 20
diameter = 0.01
region = { max = [1, 1, 1] }
[[wall]]
name = "gate"
shape = "plane"
material = "steel"
)";

scene::Scene scene_with(const std::vector<std::string>& overrides, const std::string& text = scene_text)
{
    const SceneFolder folder;
    return read_scene(folder.write("scene.toml", text), overrides).scene;
}

std::string refusal_of_override(const std::string& override_text)
{
    return error_of<InputError>([&] { scene_with({override_text}); });
}

} // namespace

TEST_CASE("an override reaches tables by name, by pair of materials and by index", "[overrides]")
{
    CHECK(scene_with({"wall.gate.remove_at=2"}).wall[0].remove_at == 2.0);
    CHECK(scene_with({"contact.glass-steel.friction=0.6"}).contact[0].friction == 0.6);
    CHECK(scene_with({"contact.steel-glass.friction=0.7"}).contact[0].friction == 0.7);
    CHECK(scene_with({"materials.steel.density=7800"}).materials[1].density == 7800.0);
    const scene::Scene by_index = scene_with({"fill.1.count=500", "wall.0.point=[0, 0, 1]"});
    CHECK(by_index.fill[0].count == 10);
    CHECK(by_index.fill[1].count == 500);
    CHECK(by_index.wall[0].point == Vec3(0, 0, 1));
}

TEST_CASE("an override reaches the species of a fill by index", "[overrides]")
{
    const std::string text = "[[fill]]\ncount = 1\nregion = { max = [1, 1, 1] }\n"
                             "[[fill.species]]\nmaterial = 'a'\ndiameter = 0.1\nshare = 1\n"
                             "[[fill.species]]\nmaterial = 'b'\ndiameter = 0.1\nshare = 1\n";
    const scene::Scene scene = scene_with({"fill.0.species.1.share=3", "fill.0.species.1.material=c"}, text);
    CHECK(scene.fill[0].species[0].share == 1.0);
    CHECK(scene.fill[0].species[1].share == 3.0);
    CHECK(scene.fill[0].species[1].material == "c");
    CHECK(error_of<InputError>([&] { scene_with({"fill.0.species.2.share=3"}, text); }) ==
          "--set fill.0.species.2.share=3: 'species' is an array of 2 and has no keys");
}

TEST_CASE("an override makes the plain tables that the file leaves out", "[overrides]")
{
    CHECK(scene_with({"time.duration=2.5"}).time.duration == 2.5);
    const scene::Scene two = scene_with({"solver.max_sweeps=7", "solver.min_sweeps = 4"});
    CHECK(two.solver.max_sweeps == 7);
    CHECK(two.solver.min_sweeps == 4);
    CHECK(scene_with({"fill.0.region.min=[0.5, 0, 0]"}).fill[0].region.min == Vec3(0.5, 0, 0));
}

TEST_CASE("a bare word is taken as a string", "[overrides]")
{
    CHECK(scene_with({"solver.stabilisation=projected"}).solver.stabilisation == "projected");
    CHECK(scene_with({"title=Beads on a plate"}).title == "Beads on a plate");
    CHECK(scene_with({"accuracy=1%"}).accuracy == "1%");
    CHECK(scene_with({"title='quoted, with = and #'"}).title == "quoted, with = and #");
}

TEST_CASE("the last override of a key counts", "[overrides]")
{
    CHECK(scene_with({"seed=2", "seed=3"}).seed == 3);
}

TEST_CASE("an override is checked like the file, and refused in its own words", "[overrides]")
{
    CHECK(refusal_of_override("wall.gate.remov_at=2") ==
          "--set wall.gate.remov_at=2: unknown key 'remov_at' in [[wall]]; did you mean 'remove_at'?");
    CHECK(
        refusal_of_override("tim.step=1") == "--set tim.step=1: unknown key 'tim' in the scene; did you mean 'time'?");
    CHECK(refusal_of_override("time.duration=-1") ==
          "--set time.duration=-1: 'duration' must be a number of at least 0 [s], not -1");
    CHECK(refusal_of_override("solver.stabilisation=match") ==
          "--set solver.stabilisation=match: 'stabilisation' must be 'auto', 'matched' or 'projected', not the string "
          "'match'; "
          "did you mean 'matched'?");
    CHECK(refusal_of_override("materials.steel=3") == "--set materials.steel=3: it must name one key of that table");
    CHECK(refusal_of_override("wall=3") == "--set wall=3: 'wall' must be a list of tables [[wall]], not 3");
}

TEST_CASE("an override of a table that is not there is refused with those that are", "[overrides]")
{
    CHECK(refusal_of_override("wall.gat.remove_at=2") ==
          "--set wall.gat.remove_at=2: the scene has no wall 'gat'; did you mean 'gate'?");
    CHECK(refusal_of_override("wall.hopper.remove_at=2") ==
          "--set wall.hopper.remove_at=2: the scene has no wall 'hopper'; there is 'gate'");
    CHECK(refusal_of_override("contact.glass-wood.friction=1") ==
          "--set contact.glass-wood.friction=1: the scene has no contact 'glass-wood'; there is 'glass-steel' and "
          "'steel-glass'");
    CHECK(refusal_of_override("materials.wood.density=500") ==
          "--set materials.wood.density=500: the scene has no materials 'wood'; there is 'glass' and 'steel'");
    CHECK(refusal_of_override("fill.2.count=1") ==
          "--set fill.2.count=1: the scene has no fill '2'; there is '0' and '1'");
    CHECK(refusal_of_override("sensor.flow.to=1") == "--set sensor.flow.to=1: the scene has no sensor 'flow'");
}

TEST_CASE("an override that is not key=value is refused", "[overrides]")
{
    CHECK(refusal_of_override("seed") == "--set seed: must be key=value on one line");
    CHECK(refusal_of_override("seed=\n3") == "--set seed= 3: must be key=value on one line");
    CHECK(refusal_of_override("=3") == "--set =3: must be key=value on one line");
    CHECK(refusal_of_override("time..step=3") == "--set time..step=3: its keys must be names joined by dots");
    CHECK(refusal_of_override("seed=[1") == "--set seed=[1: '[1' is not a TOML value");
    CHECK(refusal_of_override("title=\xff").starts_with("--set title=\xff: ")); // not UTF-8
    CHECK(refusal_of_override("seed=") == "--set seed=: '' is not a TOML value");
    CHECK(refusal_of_override("fill.0.count.x=1") == "--set fill.0.count.x=1: 'count' is 10 and has no keys");
    CHECK(
        refusal_of_override("seed.x=1") == "--set seed.x=1: 'seed' must be a whole number of at least 0, not a table");
}
