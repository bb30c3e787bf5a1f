// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/app/program.hpp"

#include <catch2/catch.hpp>

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace
{

/// A mistake in the scene and what the complaint must tell.
struct Mistake {
    std::string what;
    std::string part, replacement; ///< how the good scene is spoilt
    std::string blamed;            ///< text in the line that is blamed
    std::vector<std::string> told; ///< words of the complaint
};

const std::vector<Mistake> mistakes = {
    {"a misspelt key", "friction = 0.5", "fricton = 0.5", "fricton", {"fricton", "friction"}},
    {"a misspelt table", "[time]", "[tine]", "[tine]", {"tine", "time"}},
    {"a wrong type", "duration = 0.05", "duration = \"long\"", "duration", {"duration"}},
    {"a value out of range", "density = 2500.0", "density = -1.0", "density", {"density", "-1", "0"}},
    {"a value that is not a number", "density = 2500.0", "density = nan", "density", {"density", "nan"}},
    {"a name that is not allowed", "shape = \"box\"\nmaterial", "shape = \"bowl\"\nmaterial", "\"bowl\"",
        {"bowl", "plane"}},
    {"an unknown material", "material = \"glass\"\ncount", "material = \"steel\"\ncount", "\"steel\"",
        {"steel", "glass"}},
    {"a fill region too small", "count = 8", "count = 800", "region", {"800"}},
    {"a key of another shape", "open = [", "hole_radius = 0.01\nopen = [", "hole_radius",
        {"'disk'", "'box'", "'open'"}},
    {"a missing key", "count = 8\n", "", "[[fill]]", {"count"}},
    {"text that is not TOML", "count = 8", "count = = 8", "count", {}},
};

void check_complaint(const Workplace& place, const Outcome& outcome, const std::string& beginning)
{
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.err, StartsWith(beginning));
    CHECK(line_of(outcome.err + "|", "|") == 2); // one sentence on one line
    CHECK_FALSE(place.exists("out"));
}

std::string blamed_line(const std::string& scene, const std::string& part)
{
    return "scene.toml:" + std::to_string(line_of(scene, part)) + ":";
}

} // namespace

TEST_CASE("a mistake in a scene is reported in one sentence with file, line and what is allowed, and leaves no folder",
    "[app][input]")
{
    for (const Mistake& mistake : mistakes) {
        DYNAMIC_SECTION(mistake.what)
        {
            const Workplace place;
            const std::string scene = replaced(beads_in_a_box, mistake.part, mistake.replacement);
            const Outcome outcome = place.run(scene);
            check_complaint(place, outcome, blamed_line(scene, mistake.blamed));
            for (const std::string& word : mistake.told) CHECK_THAT(outcome.err, Contains(word));
        }
    }
}

TEST_CASE("an STL file that is missing or broken is reported with the place that names it", "[app][input]")
{
    const Workplace place;
    const std::string scene = beads_in_a_box + "[[wall]]\nname = \"cup\"\nmaterial = \"glass\"\nmesh = \"cup.stl\"\n";

    SECTION("missing") {}
    SECTION("empty")
    {
        place.write("cup.stl", "");
    }
    SECTION("truncated")
    {
        place.write("cup.stl", "solid cup\nfacet normal 0 0 1\nouter loop\nvertex 0 0");
    }
    SECTION("something else")
    {
        place.write("cup.stl", "this is a letter to a friend\n");
    }

    const Outcome outcome = place.run(scene);
    check_complaint(place, outcome, blamed_line(scene, "mesh ="));
    CHECK_THAT(outcome.err, Contains("cup.stl"));
}

TEST_CASE("a mistake in --set is reported with what was given", "[app][input]")
{
    const Workplace place;
    const std::string option = GENERATE(as<std::string>{}, "time.duraton=1", "time.duration=-1", "time.duration=soon",
        "fill.7.count=1", "wall.gate.remove_at=1", "nonsense");
    CAPTURE(option);
    const Outcome outcome = place.run(beads_in_a_box, "--set " + option);
    check_complaint(place, outcome, "");
    CHECK_THAT(outcome.err, Contains(option));
}

TEST_CASE("of two walls with one name both places are reported", "[app][input]")
{
    const Workplace place;
    const std::string scene = beads_in_a_box + "[[wall]]\nname =   \"tray\"\nmaterial = \"glass\"\nshape = \"plane\"\n";
    const Outcome outcome = place.run(scene);
    check_complaint(place, outcome, blamed_line(scene, "name =   \"tray\""));
    CHECK_THAT(outcome.err, Contains("'tray'") && Contains("the first is at " + blamed_line(scene, "name = \"tray\"")));
}

TEST_CASE("check refuses what run refuses", "[app][input]")
{
    const Workplace place;
    place.write("scene.toml", replaced(beads_in_a_box, "count = 8", "count = 800"));
    const Outcome outcome = place.talus("check scene.toml");
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.out.empty());
    CHECK_THAT(outcome.err, StartsWith("scene.toml:"));
}
