// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/scene_file.hpp"
#include "io/text/input_error.hpp"
#include "tests/io/scene_folder.hpp"

#include <catch2/catch.hpp>

using namespace talus;
using namespace talus::test;

namespace
{

std::string refusal_of(const std::string& scene)
{
    const SceneFolder folder;
    const auto path = folder.write("scene.toml", scene);
    return folder.without_folder(error_of<InputError>([&] { read_scene(path); }));
}

} // namespace

TEST_CASE("an unknown key is refused with the nearest known one", "[scene_reader]")
{
    CHECK(refusal_of("[[contact]]\nbetween = ['a', 'a']\nfrictoin = 0.5\n") ==
          "scene.toml:3:1: unknown key 'frictoin' in [[contact]]; did you mean 'friction'?");
    CHECK(refusal_of("sed = 3\n") == "scene.toml:1:1: unknown key 'sed' in the scene; did you mean 'seed'?");
    CHECK(refusal_of("[tme]\nstep = 1e-4\n") == "scene.toml:1:2: unknown key 'tme' in the scene; did you mean 'time'?");
    CHECK(refusal_of("[materials.glass]\ndensty = 2500\n") ==
          "scene.toml:2:1: unknown key 'densty' in [materials.glass]; did you mean 'density'?");
}

TEST_CASE("an unknown key that is like none is refused with all keys of its table", "[scene_reader]")
{
    CHECK(refusal_of("[output]\ncolour = 1\n") ==
          "scene.toml:2:1: unknown key 'colour' in [output]; its keys are 'particle_arrays', 'contact_arrays', "
          "'contact_interval', 'contact_threshold' and 'region'");
}

TEST_CASE("a value of the wrong type is refused with what is wanted", "[scene_reader]")
{
    CHECK(refusal_of("[time]\nduration = 'long'\n") ==
          "scene.toml:2:12: 'duration' must be a number of at least 0 [s], not the string 'long'");
    CHECK(refusal_of("seed = 1.5\n") == "scene.toml:1:8: 'seed' must be a whole number of at least 0, not 1.5");
    CHECK(refusal_of("title = 3\n") == "scene.toml:1:9: 'title' must be a string, not 3");
    CHECK(refusal_of("time = 3\n") == "scene.toml:1:8: 'time' must be a table, not 3");
    CHECK(refusal_of("wall = true\n") == "scene.toml:1:8: 'wall' must be a list of tables [[wall]], not true");
    CHECK(refusal_of("wall = [1]\n") == "scene.toml:1:9: 'wall' must be a list of tables [[wall]], not 1");
    CHECK(refusal_of("materials = 1\n") ==
          "scene.toml:1:13: 'materials' must be a table of tables [materials.NAME], not 1");
    CHECK(refusal_of("materials.glass = 1979-05-27\n") ==
          "scene.toml:1:19: 'glass' must be a table [materials.NAME], not a date or time");
    CHECK(refusal_of("[[contact]]\nbetween = 'glass'\n") ==
          "scene.toml:2:11: 'between' must be an array of strings, not the string 'glass'");
    CHECK(refusal_of("[[contact]]\nbetween = ['glass', 2]\n") ==
          "scene.toml:2:21: 'between' must be an array of strings, not 2");
    CHECK(refusal_of("title = {}\n") == "scene.toml:1:9: 'title' must be a string, not a table");
    CHECK(refusal_of("[time]\nduration = '" + std::string(70, 'x') + "'\n") ==
          "scene.toml:2:12: 'duration' must be a number of at least 0 [s], not a string of 70 bytes");
}

TEST_CASE("a vector is three numbers", "[scene_reader]")
{
    const std::string wanted = "'gravity' must be three numbers [m/s2], not ";
    CHECK(refusal_of("[world]\ngravity = 9.81\n") == "scene.toml:2:11: " + wanted + "9.81");
    CHECK(refusal_of("[world]\ngravity = [0, -9.81]\n") == "scene.toml:2:11: " + wanted + "an array of 2");
    CHECK(refusal_of("[world]\ngravity = [0, 'x', 0]\n") == "scene.toml:2:15: " + wanted + "the string 'x'");
    CHECK(refusal_of("[world]\ngravity = [0, 0, inf]\n") == "scene.toml:2:18: " + wanted + "inf");
    CHECK(refusal_of("[world]\nmin = [0, 0, nan]\n") ==
          "scene.toml:2:14: 'min' must be three numbers [m] or inf, not nan");
}

TEST_CASE("a value out of range is refused with the range and its unit", "[scene_reader]")
{
    CHECK(refusal_of("[time]\nframe_interval = 0\n") ==
          "scene.toml:2:18: 'frame_interval' must be a number above 0 [s] or inf, not 0");
    CHECK(refusal_of("[time]\nduration = inf\n") ==
          "scene.toml:2:12: 'duration' must be a number of at least 0 [s], not inf");
    CHECK(refusal_of("[time]\nduration = nan\n") ==
          "scene.toml:2:12: 'duration' must be a number of at least 0 [s], not nan");
    CHECK(refusal_of("[solver]\nmax_sweeps = 0\n") ==
          "scene.toml:2:14: 'max_sweeps' must be a whole number of at least 1 and at most 1000000, not 0");
    CHECK(refusal_of("[[contact]]\nbetween = ['a', 'a']\nrestitution = 1.5\n") ==
          "scene.toml:3:15: 'restitution' must be a number of at least 0 and at most 1, not 1.5");
    CHECK(refusal_of("[[fill]]\nmaterial = 'a'\ncount = 1\ndiameter = 0\n") ==
          "scene.toml:4:12: 'diameter' must be a number above 0 [m], not 0");
    CHECK(refusal_of("[[fill]]\nmaterial = 'a'\ncount = 1\ndiameter = 'big'\n") ==
          "scene.toml:4:12: 'diameter' must be a number [m] or a table with a distribution, not the string 'big'");
}

TEST_CASE("an unknown name of a choice is refused with the names and the nearest", "[scene_reader]")
{
    CHECK(refusal_of("[solver]\nstabilisation = 'projectd'\n") ==
          "scene.toml:2:17: 'stabilisation' must be 'auto', 'matched' or 'projected', not the string 'projectd'; did "
          "you mean "
          "'projected'?");
    CHECK(refusal_of("[solver]\ntolerance = 'standart'\n") ==
          "scene.toml:2:13: 'tolerance' must be a number above 0 and at most 1, or 'auto', 'draft', 'standard', 'fine' "
          "or "
          "'reference', not the string 'standart'; did you mean 'standard'?");
    CHECK(
        refusal_of("[time]\nstep = -1\n") == "scene.toml:2:8: 'step' must be a number above 0 [s], or 'auto', not -1");
    CHECK(refusal_of("[[wall]]\nname = 'w'\nmaterial = 'a'\nshape = 'box'\nmax = [1, 1, 1]\nopen = ['z*']\n") ==
          "scene.toml:6:9: 'open' must be an array of 'x-', 'x+', 'y-', 'y+', 'z-' and 'z+', not the string 'z*'; did "
          "you mean 'z-'?");
}

TEST_CASE("a key that must be there is asked for by name and meaning", "[scene_reader]")
{
    CHECK(refusal_of("[[fill]]\ncount = 3\n") ==
          "scene.toml:1:1: [[fill]] needs the key 'region' (where; spheres lie wholly inside, and on the side of "
          "closed walls where more of it lies)");
    CHECK(refusal_of("[[sensor]]\nname = 's'\n") == "scene.toml:1:1: [[sensor]] needs the key 'kind'");
}

TEST_CASE("a key of another shape is refused with the shapes that have it and the keys of this one", "[scene_reader]")
{
    CHECK(refusal_of("[[wall]]\nname = 'w'\nmaterial = 'a'\nhole_radius = 1\nshape = 'plane'\n") ==
          "scene.toml:4:1: key 'hole_radius' in [[wall]] goes with shape 'disk', not 'plane', whose keys are 'name', "
          "'shape', 'material', 'appear_at', 'remove_at', 'motion', 'point' and 'normal'");
    CHECK(
        refusal_of("[[wall]]\nname = 'w'\nmaterial = 'a'\nradius = 1\n")
            .starts_with("scene.toml:4:1: key 'radius' in [[wall]] goes with shape 'cylinder' or 'disk', not 'mesh'"));
    CHECK(refusal_of("[[outlet]]\nregion = { max = [1, 1, 1], radius = 1 }\n") ==
          "scene.toml:2:29: key 'radius' in [region] goes with shape 'cylinder' or 'sphere', not 'box', whose keys are "
          "'shape', "
          "'min' and 'max'");
    CHECK(refusal_of("[[fill]]\nmaterial = 'a'\ncount = 1\ndiameter = { value = 1, max = 2 }\n") ==
          "scene.toml:4:25: key 'max' in [diameter] goes with distribution 'uniform', 'normal' or 'lognormal', not "
          "'constant', whose keys are "
          "'distribution' and 'value'");
    CHECK(refusal_of("[[fill]]\nspacing = 1.2\narrangement = 'random'\n")
              .starts_with("scene.toml:2:1: key 'spacing' in [[fill]] goes with arrangement 'lattice', not 'random'"));
    CHECK(refusal_of("[[sensor]]\nname = 's'\nkind = 'repose'\nfrom = 1.0\n") ==
          "scene.toml:4:1: key 'from' in [[sensor]] goes with kind 'mass_flow', 'slope', 'region', 'profile', "
          "'wall_force' or 'wall_position', not 'repose', whose keys are 'name', 'kind', 'base', 'inner_radius' and "
          "'outer_radius'");
}

TEST_CASE("a key that a shape must have is asked for where the table stands", "[scene_reader]")
{
    CHECK(refusal_of("seed = 1\n[[wall]]\nname = 'w'\nmaterial = 'a'\nshape = 'cylinder'\nheight = 1\n") ==
          "scene.toml:2:1: [[wall]] needs the key 'radius' (of the tube or plate)");
    CHECK(refusal_of("[[wall]]\nname = 'w'\nmaterial = 'a'\n") ==
          "scene.toml:1:1: [[wall]] needs the key 'mesh' (an STL file, beside the scene file)");
    CHECK(refusal_of("[[outlet]]\nregion = {}\n") == "scene.toml:2:10: [region] needs the key 'max' (upper corner)");
}

TEST_CASE("names have no control characters", "[scene_reader]")
{
    CHECK(refusal_of("[materials.\"a\\nb\"]\n") ==
          "scene.toml:1:12: the name of a material must be text without line breaks and control characters");
    CHECK(refusal_of("title = \"\\u009b31m\"\n") ==
          "scene.toml:1:9: 'title' must be text without line breaks and control characters, not a string of 5 bytes");
}

TEST_CASE("a key of one kind of table is asked for there, and refused in the others", "[scene_reader]")
{
    CHECK(refusal_of("[[fill]]\nmaterial = 'a'\ncount = 1\n") ==
          "scene.toml:1:1: [[fill]] needs the key 'region' (where; spheres lie wholly inside, and on the side of "
          "closed walls where more of it lies)");
    CHECK(
        refusal_of("[[fill]]\nmaterial = 'a'\narrangement = 'file'\n") ==
        "scene.toml:1:1: [[fill]] needs the key 'file' (a .vtp, .vtu or .csv file of spheres, beside the scene file)");
    CHECK(refusal_of("[[fill]]\narrangement = 'file'\nfile = 'a.csv'\nregion = { max = [1, 1, 1] }\n")
              .starts_with(
                  "scene.toml:4:1: key 'region' in [[fill]] goes with arrangement 'lattice', 'random' or 'dense', "
                  "not 'file', whose keys are "));
    CHECK(refusal_of("[[fill]]\narrangement = 'file'\nfile = 'a.csv'\nspecies = []\n")
              .starts_with("scene.toml:4:1: key 'species' in [[fill]] goes with arrangement"));
}

TEST_CASE("a distribution is asked for what it needs, and takes no more", "[scene_reader]")
{
    const auto refusal = [](const std::string& diameter) {
        return refusal_of("[[fill]]\ncount = 1\nregion = { max = [1, 1, 1] }\ndiameter = " + diameter + "\n");
    };
    CHECK(refusal("{ distribution = 'normal', mean = 1, deviation = 1, max = 1 }") ==
          "scene.toml:4:12: [diameter] needs the key 'min' (the smallest)");
    CHECK(refusal("{ distribution = 'lognormal', deviation = 1, min = 1, max = 1 }") ==
          "scene.toml:4:12: [diameter] needs the key 'median' (before min and max cut it)");
    CHECK(refusal("{ distribution = 'normal', mean = 1, deviation = 0, min = 1, max = 1 }") ==
          "scene.toml:4:61: 'deviation' must be a number above 0 [m], not 0");
    CHECK(refusal("{ distribution = 'lognormal', mean = 1 }") ==
          "scene.toml:4:42: key 'mean' in [diameter] goes with distribution 'normal', not 'lognormal', whose keys are "
          "'distribution', 'median', 'deviation', 'min' and 'max'");
    CHECK(refusal("{ distribution = 'sieve' }") ==
          "scene.toml:4:12: [diameter] needs the key 'file' (a CSV file, beside the scene file: size_mm or size_m, and "
          "passing_percent of the mass)");
    CHECK(refusal("{ distribution = 'sieve', file = 's.csv', min = 1 }")
              .starts_with("scene.toml:4:54: key 'min' in [diameter] goes with distribution 'uniform', 'normal' or"));
}

TEST_CASE("a species is a table with all its keys", "[scene_reader]")
{
    const auto refusal = [](const std::string& list, const std::string& species) {
        return refusal_of("[[" + list + "]]\ncount = 1\nregion = { max = [1, 1, 1] }\nspecies = " + species + "\n");
    };
    CHECK(
        refusal("fill", "[{ material = 'a', diameter = 0.1 }]") ==
        "scene.toml:4:12: [[fill.species]] needs the key 'share' (of the mass, in proportion to the sum of the shares "
        "of all species)");
    CHECK(refusal("pour", "[{ material = 'a', share = 0.1 }]") ==
          "scene.toml:4:12: [[pour.species]] needs the key 'diameter' (a number, or a table with a distribution)");
    CHECK(refusal("pour", "[{ material = 'a', diameter = 0.1, share = 0 }]") ==
          "scene.toml:4:54: 'share' must be a number above 0, not 0");
    CHECK(refusal("fill", "0.5") == "scene.toml:4:11: 'species' must be a list of tables [[fill.species]], not 0.5");
}

TEST_CASE("a load is a number, or rows of times and forces", "[scene_reader]")
{
    const std::string wall = "[[wall]]\nname = 'w'\nmaterial = 'a'\nshape = 'disk'\n";
    const std::string expected = "'load' must be a number [N] or rows of two numbers [time, force], not ";
    CHECK(refusal_of(wall + "load = 'heavy'\n") == "scene.toml:5:8: " + expected + "the string 'heavy'");
    CHECK(refusal_of(wall + "load = [1, 2]\n") == "scene.toml:5:9: " + expected + "1");
    CHECK(refusal_of(wall + "load = [[1, 2, 3]]\n") == "scene.toml:5:9: " + expected + "an array of 3");
    CHECK(refusal_of(wall + "mass = 0\n") == "scene.toml:5:8: 'mass' must be a number above 0 [kg] or inf, not 0");
}

TEST_CASE("a motion's kind, keys and table are checked where they stand", "[scene_reader]")
{
    const std::string wall = "[[wall]]\nname = 'w'\nmaterial = 'a'\nshape = 'plane'\n[[wall.motion]]\n";
    CHECK(refusal_of(wall + "kind = 'spin'\n") ==
          "scene.toml:6:8: 'kind' must be 'translate', 'turn', 'shake' or 'table', not the string 'spin'");
    CHECK(refusal_of(wall + "kind = 'turn'\nrate = 1\n") ==
          "scene.toml:5:1: [[wall.motion]] needs the key 'axis' (direction of the axis)");
    const std::string rows = "'table' must be rows of four numbers [time, x, y, z], not ";
    CHECK(refusal_of(wall + "kind = 'table'\ntable = [[0, 0, 0]]\n") == "scene.toml:7:10: " + rows + "an array of 3");
    CHECK(refusal_of(wall + "kind = 'table'\ntable = [[0, 0, 0, 'up']]\n") ==
          "scene.toml:7:20: " + rows + "the string 'up'");
    CHECK(refusal_of(wall + "kind = 'table'\ntable = 3\n") == "scene.toml:7:9: " + rows + "3");
    CHECK(refusal_of("[world]\nperiodic = ['w']\n").starts_with("scene.toml:2:13: 'periodic' must be "));
    CHECK(refusal_of("[world]\nrotation = 0\n").starts_with("scene.toml:2:12: 'rotation' must be "));
}
