// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/app/program.hpp"

#include <catch2/catch.hpp>

#include <fstream>
#include <sstream>

using Catch::Matchers::Contains;

namespace
{

std::string supplied(const std::string& name)
{
    std::ostringstream text;
    text << std::ifstream(TALUS_SOURCE_DIR "/scenarios/" + name, std::ios::binary).rdbuf();
    return text.str();
}

} // namespace

TEST_CASE("new writes a commented scene that runs", "[app][new]")
{
    const Workplace place;
    const Outcome outcome = place.talus("new mine");
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.out == "wrote mine.toml\nnext: talus check mine.toml, then talus run mine.toml\n");
    CHECK_THAT(place.read("mine.toml"), Contains("# kg/m3"));
    CHECK(place.talus("check mine.toml").exit_code == 0);
    REQUIRE(place.talus("run mine.toml --until 0.05 --quiet --threads 1").exit_code == 0);
    CHECK(place.exists("out/mine/summary.json"));
}

TEST_CASE("new copies a supplied scene with the files that it names", "[app][new]")
{
    const Workplace place;
    place.shell("mkdir there");
    CHECK(place.talus("new there/mine.toml --from hopper").exit_code == 0);
    CHECK(place.read("there/mine.toml") == supplied("hopper.toml"));
    CHECK(place.read("there/hopper.stl") == supplied("hopper.stl"));
    CHECK(place.talus("check there/mine.toml").exit_code == 0);
}

TEST_CASE("new replaces nothing, and writes nothing where one of its files is there", "[app][new]")
{
    const Workplace place;
    place.write("mine.toml", "notes");
    place.write("hopper.stl", "notes");
    CHECK(place.talus("new mine").exit_code == 2);
    CHECK(place.talus("new other --from hopper").exit_code == 2);
    CHECK(place.read("mine.toml") == "notes");
    CHECK(place.read("hopper.stl") == "notes");
    CHECK_FALSE(place.exists("other.toml"));
}
