// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/summary.hpp"

#include "tests/app/program.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <limits>

using Catch::Matchers::Contains;
using talus::Incident;
using talus::Vec3;

TEST_CASE("a value that is not a number is null in the summary", "[app][summary]")
{
    const Workplace place;
    talus::RunSummary summary;
    summary.sensors = {
        {"heap", {{"angle", std::numeric_limits<double>::quiet_NaN(), talus::infinity, "degree"}}, "no heap"}};
    write_summary(place.path("summary.json"), summary);
    const auto angle = nlohmann::json::parse(place.read("summary.json"))["sensors"]["heap"]["angle"];
    CHECK(angle["value"].is_null());
    CHECK(angle["spread"].is_null());
    CHECK(angle["unit"] == "degree");
    CHECK(angle["silence"] == "no heap");
}

TEST_CASE("a ledger closes when every sphere is accounted for", "[app][summary]")
{
    const talus::ParticleLedger whole{.inserted = 10, .inside = 5, .left = 4, .escaped = 1};
    CHECK(whole.closes());
    const talus::ParticleLedger torn{.inserted = 10, .inside = 5, .left = 4, .escaped = 0};
    CHECK_FALSE(torn.closes());
}

TEST_CASE("an incident is reported with id, place, speed and the wall touched last", "[app][summary]")
{
    const std::vector<std::string> walls = {"floor", "funnel"};
    const Incident fast{Incident::Kind::blow_up, 42, Vec3(1.0, 2.0, 0.5), 123.0, 1};
    CHECK_THAT(describe(fast, walls), Contains("sphere 42") && Contains("faster") && Contains("(1, 2, 0.5) m") &&
                                          Contains("123 m/s") && Contains("'funnel'"));
    const Incident lost{Incident::Kind::not_a_number, 7, Vec3::Constant(std::nan("")), std::nan(""), -1};
    CHECK_THAT(describe(lost, walls), Contains("sphere 7") && Contains("not a number") && Contains("no wall"));
    const Incident piston{Incident::Kind::escaped, -1, Vec3(1.0, 2.0, 0.5), 3.0, 1};
    CHECK_THAT(describe(piston, walls),
        Contains("the wall 'funnel'") && Contains("left the world") && Contains("(1, 2, 0.5) m") && Contains("3 m/s"));
}
