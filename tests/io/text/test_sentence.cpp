// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/text/sentence.hpp"

#include <catch2/catch.hpp>

using namespace talus;

TEST_CASE("the nearest name is the one with the fewest changed letters", "[sentence]")
{
    const std::vector<std::string_view> names = {"friction", "restitution", "rolling_friction", "stiffness"};
    CHECK(nearest_name("frictoin", names) == "friction");
    CHECK(nearest_name("Restitution", names) == "restitution");
    CHECK(nearest_name("rolling_fricton", names) == "rolling_friction");
    CHECK(nearest_name("stifness", names) == "stiffness");
}

TEST_CASE("a word unlike all names has no nearest one", "[sentence]")
{
    CHECK(nearest_name("colour", {"friction", "density"}).empty());
    CHECK(nearest_name("x", {"to", "up"}).empty()); // every letter of either would change
    CHECK(nearest_name("friction", {}).empty());
    CHECK(did_you_mean("colour", {"friction"}).empty());
}

TEST_CASE("names are enumerated as a sentence does", "[sentence]")
{
    CHECK(enumerate_names({}, "or").empty());
    CHECK(enumerate_names({"box"}, "or") == "'box'");
    CHECK(enumerate_names({"box", "disk"}, "and") == "'box' and 'disk'");
    CHECK(enumerate_names({"box", "disk", "cone"}, "or") == "'box', 'disk' or 'cone'");
}
