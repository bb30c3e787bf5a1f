// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/scene_file.hpp"
#include "io/text/input_error.hpp"
#include "tests/io/full_scene.hpp"
#include "tests/io/scene_folder.hpp"

#include <catch2/catch.hpp>

#include <numbers>

using namespace talus;
using namespace talus::test;
using Catch::Matchers::Contains;

namespace
{

std::string refusal_of_scene(const SceneFolder& folder, const std::string& text)
{
    const auto path = folder.write("scene.toml", text);
    return folder.without_folder(error_of<InputError>([&] { read_scene(path); }));
}

} // namespace

TEST_CASE("the values of a scene file arrive, the rest keeps its defaults", "[scene_file]")
{
    const SceneFolder folder;
    write_named_files(folder);
    const scene::Scene scene = read_scene(folder.write("scene.toml", full_scene)).scene;
    CHECK(scene.title == "A \"quoted\" title, a tab\t, a \\ and µ");
    CHECK(scene.time.step.name.empty());
    CHECK(scene.time.step.number == 1e-4);
    CHECK(scene.time.duration == 3.0);
    CHECK(scene.time.metrics_interval == scene::TimeTable().metrics_interval);
    CHECK(scene.world.max == Vec3(1, 1, infinity));
    CHECK(scene.solver.tolerance.name == "fine");
    REQUIRE(scene.materials.size() == 2);
    CHECK(scene.materials[0].name == "dark wood"); // in alphabetical order
    CHECK(scene.fill.at(0).count == 1000);
    CHECK(scene.fill[0].diameter.distribution == "constant");
    CHECK(scene.fill[0].diameter.value == 0.01);
    CHECK(scene.fill.at(1).species.size() == 2);
    CHECK(scene.pour.at(0).diameter.mean == 0.01);
    CHECK(scene.pour.at(1).diameter.max == 0.0105);
    CHECK(scene.wall.at(0).open == std::vector<std::string>{"z+", "x-"});
    CHECK(scene.sensor.at(0).to == infinity);
}

TEST_CASE("a wall's mesh is read from beside the scene, scaled and then moved", "[scene_file]")
{
    const SceneFolder folder;
    write_named_files(folder);
    const scene::WallTable funnel = read_scene(folder.write("scene.toml", full_scene)).scene.wall.at(1);
    REQUIRE(funnel.triangles.size() == 1);
    CHECK(funnel.vertices[static_cast<std::size_t>(funnel.triangles[0][1])].isApprox(Vec3(1, 0, 1)));
}

TEST_CASE("numbers may be texts with their unit, and are written in SI units", "[scene_file]")
{
    const SceneFolder folder;
    const auto path = folder.write("scene.toml", R"(
[time]
duration = "2 min"
step = "0.1 ms"
[materials.a]
density = "2.5 g/cm3"
[[fill]]
material = 'a'
count = 1
diameter = "5 mm"
region = { max = ["10 cm", 1, "1 km"] }
[[wall]]
name = "w"
shape = "plane"
material = "a"
[[wall.motion]]
kind = "turn"
axis = [0, 0, 1]
rate = "30 rpm"
[[wall.motion]]
kind = "table"
table = [["1 min", "1 mm", 0, 0]]
)");
    const auto scene =
        read_scene(path, {"fill.0.velocity=[0, 0, '-3.6 km/h']", "world.gravity=[0, 0, '-981 cm/s2']"}).scene;
    CHECK(scene.time.duration == Approx(120.0));
    CHECK(scene.time.step.number == Approx(1e-4));
    CHECK(scene.materials[0].density == Approx(2500.0));
    CHECK(scene.fill[0].diameter.value == Approx(0.005));
    CHECK(scene.fill[0].region.max.isApprox(Vec3(0.1, 1, 1000)));
    CHECK(scene.fill[0].velocity.z() == Approx(-1.0));
    CHECK(scene.world.gravity.z() == Approx(-9.81));
    CHECK(scene.wall[0].motion[0].rate == Approx(std::numbers::pi));
    CHECK(scene.wall[0].motion[1].table[0].time == Approx(60.0));
    CHECK(scene.wall[0].motion[1].table[0].shift.x() == Approx(0.001));
    CHECK_THAT(resolved_scene(scene), Contains("duration = 120.0  # s") && Contains("density = 2500.0  # kg/m3"));
}

TEST_CASE("the place of a key is where it stands, or the table around it", "[scene_file]")
{
    const SceneFolder folder;
    const auto path = folder.write("scene.toml",
        "[materials.a]\n[[fill]]\nmaterial = 'a'\ncount = 1\ndiameter = 1\nregion = { max = [1, 1, 1] }\n");
    const SceneFile file = read_scene(path, {"fill.0.count=2"});
    const auto place = [&](const std::string& key) { return folder.without_folder(file.place_of(key)); };
    CHECK(place("fill[0].material") == "scene.toml:3:12");
    CHECK(place("fill[0].region.max") == "scene.toml:6:18");
    CHECK(place("fill[0].diameter.value") == "scene.toml:5:12");
    CHECK(place("fill[0].velocity") == "scene.toml:2:1");
    CHECK(place("materials.a.density") == "scene.toml:1:1");
    CHECK(place("fill[0].count") == "--set fill.0.count=2");
    CHECK(place("time.step") == "scene.toml");
}

TEST_CASE("a file that is no scene is refused in one sentence", "[scene_file]")
{
    const SceneFolder folder;
    CHECK(refusal_of_scene(folder, "seed = \n").starts_with("scene.toml:1:8: not TOML: "));
    CHECK(refusal_of_scene(folder, "seed = 1\nseed = 2\n").starts_with("scene.toml:2:"));
    CHECK(refusal_of_scene(folder, "seed = tru\n").find('\n') == std::string::npos);
    CHECK(refusal_of_scene(folder, std::string((1 << 20) + 1, '#')) ==
          "scene.toml: a scene file has at most 1048576 bytes, this one 1048577");
    CHECK(folder.without_folder(error_of<InputError>([&] { read_scene(folder.path() / "none.toml"); })) ==
          "none.toml: no such file");
    CHECK(error_of<InputError>([&] { read_scene(folder.path()); }) == folder.path().string() + ": not a scene file");
}

TEST_CASE("a missing or broken mesh is refused at the key that names it", "[scene_file]")
{
    const SceneFolder folder;
    const std::string scene = "[[wall]]\nname = 'w'\nmaterial = 'a'\nmesh = 'w.stl'\n";
    CHECK(refusal_of_scene(folder, scene) == "scene.toml:4:8: wall 'w': w.stl: no such file");
    folder.write("w.stl", "solid\nfacet\n");
    CHECK(
        refusal_of_scene(folder, scene) == "scene.toml:4:8: wall 'w': w.stl:3: the file ends where 'normal' is wanted");
}

TEST_CASE("spheres and sieves are read from beside the scene, scaled and then moved", "[scene_file]")
{
    const SceneFolder folder;
    write_named_files(folder);
    const scene::Scene scene = read_scene(folder.write("scene.toml", full_scene)).scene;
    const scene::DiameterTable& sieved = scene.fill.at(1).species.at(0).diameter;
    CHECK(sieved.sieve_sizes == std::vector<double>{0.005, 0.01});
    CHECK(sieved.sieve_passing == std::vector<double>{0.0, 1.0});
    const scene::SphereList& spheres = scene.fill.at(2).spheres;
    REQUIRE(spheres.positions.size() == 2);
    CHECK(spheres.positions[1].isApprox(Vec3(0.02, 0, 2.01)));
    CHECK(spheres.radii == std::vector<double>{0.005, 0.01});
    CHECK(spheres.velocities.empty());
}

TEST_CASE("the velocities of scaled spheres are scaled too, and not moved", "[scene_file]")
{
    const SceneFolder folder;
    folder.write("s.csv", "x,y,z,radius,vx,vy,vz\n0,0,0,5,10,-20,30\n");
    const scene::Scene scene = read_scene(folder.write("scene.toml", "[[fill]]\nmaterial = 'a'\narrangement = 'file'\n"
                                                                     "file = 's.csv'\nscale = 1e-3\n"
                                                                     "translate = [0, 0, 2]\n"))
                                   .scene;
    const scene::SphereList& spheres = scene.fill.at(0).spheres;
    REQUIRE(spheres.velocities.size() == 1);
    CHECK(spheres.velocities[0].isApprox(Vec3(0.01, -0.02, 0.03)));
}

TEST_CASE("a broken file of spheres or sieves is refused at the key that names it", "[scene_file]")
{
    const SceneFolder folder;
    const std::string fill = "[[fill]]\nmaterial = 'a'\narrangement = 'file'\nfile = 's.csv'\n";
    CHECK(refusal_of_scene(folder, fill) == "scene.toml:4:8: s.csv: no such file");
    folder.write("s.csv", "x,y,z\n0,0\n");
    CHECK(refusal_of_scene(folder, fill) == "scene.toml:4:8: s.csv:2: the header names 3 columns, this line has 2");
    const std::string pour = "[[pour]]\nregion = { max = [1, 1, 1] }\n[[pour.species]]\nmaterial = 'a'\nshare = 1\n"
                             "diameter = { distribution = 'sieve', file = 's.csv' }\n";
    CHECK(refusal_of_scene(folder, pour) ==
          "scene.toml:6:45: s.csv:1: unknown column 'x'; the header may name 'size_mm', 'size_m' and "
          "'passing_percent'");
}
