// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/study/study_page.hpp"
#include "app/study/study_result.hpp"
#include "io/text/input_error.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace talus;
using Catch::Matchers::Contains;

namespace
{

StudyRow row(const std::string& setting, double cpu, double overlap, double height, double flow, double spread = 0.0)
{
    StudyRow made{.setting = setting, .seed = 1};
    made.cpu = cpu;
    made.findings = {
        {"overlap_95", overlap, 0.0, "d"}, {"height", height, 0.0, "d"}, {"outlet mass_flow", flow, spread, "kg/s"}};
    made.profile = {1.0, 0.5};
    return made;
}

const std::vector<Setting> four_settings = {{"reference", {}}, {"default", {}}, {"fast", {}}, {"slow", {}}};

std::size_t kind(const StudyResult& result, const std::string& name)
{
    const auto found = std::ranges::find(result.kinds, name, &ErrorKind::name);
    REQUIRE(found != result.kinds.end());
    return static_cast<std::size_t>(found - result.kinds.begin());
}

} // namespace

TEST_CASE("a row of a study reads back, with what is not a number in it", "[app][study]")
{
    StudyRow made = row("projected, tolerance=fine", 2.5, 1e-4, 8.0, 1.25, std::nan(""));
    made.seed = 7;
    made.status = "t = 1 s: a \"sentence\"\nwith a line break";
    const std::string text = row_text(made);
    CHECK(text.find('\n') == std::string::npos);
    const StudyRow read = read_row(text);
    CHECK(read.setting == made.setting);
    CHECK(read.seed == 7);
    CHECK(read.status == made.status);
    CHECK(read.cpu == 2.5);
    REQUIRE(read.findings.size() == 3);
    CHECK(read.findings[0].value == 1e-4);
    CHECK(std::isnan(read.findings[2].spread));
    CHECK(read.profile == made.profile);
    CHECK_THROWS_AS(read_row("{}"), InputError);
    CHECK_THROWS_AS(read_row("half a li"), InputError);
}

TEST_CASE("what a run tells of itself is its error, the rest is compared with the reference", "[app][study]")
{
    StudyRow other = row("fast", 1.0, 3e-4, 7.5, 1.9, 0.03);
    other.profile = {0.9, 0.7};
    const auto result = compare(
        four_settings, {row("reference", 100.0, 1e-6, 8.0, 2.0, 0.04), row("default", 2.0, 1e-4, 8.0, 2.0), other});
    const StudyPoint& fast = result.points[2];
    CHECK(fast.errors[kind(result, "overlap_95")].value == 3e-4);
    CHECK(fast.errors[kind(result, "height")].value == Approx(0.5));
    CHECK(fast.errors[kind(result, "force_profile")].value == Approx(0.2));
    const auto flow = kind(result, "outlet mass_flow");
    CHECK(result.kinds[flow].of_sensor);
    CHECK(fast.errors[flow].value == Approx(0.05));
    CHECK(fast.errors[flow].spread == Approx(0.025));
    CHECK(std::isnan(fast.errors[kind(result, "creep")].value));
    CHECK_FALSE(result.points[3].is_done()); // it was not run
}

TEST_CASE("differences are averaged over seeds before their sign is dropped, and their scatter is told", "[app][study]")
{
    std::vector<StudyRow> rows;
    for (std::int64_t seed = 1; seed <= 4; ++seed)
        for (const char* name : {"reference", "default"}) {
            const bool is_reference = std::string(name) == "reference";
            rows.push_back(row(name, 1.0, 1e-4, is_reference ? 8.0 : seed % 2 ? 8.1 : 7.9, 1.0));
            rows.back().seed = seed;
        }
    const auto result = compare({{"reference", {}}, {"default", {}}}, rows);
    const ErrorValue height = result.standard().errors[kind(result, "height")];
    CHECK(height.value == Approx(0.0).margin(1e-12));
    CHECK(height.spread == Approx(0.1 * 2.0 / std::sqrt(3.0) / 2.0)); // s/√4 of ±0.1
}

TEST_CASE("one seed that fails makes the setting fail, with its sentence", "[app][study]")
{
    std::vector<StudyRow> rows = {row("reference", 9.0, 1e-6, 8.0, 2.0), row("default", 2.0, 1e-4, 8.0, 2.0)};
    rows.push_back(row("fast", 1.0, 1e-3, 8.0, 2.0));
    rows.push_back(rows.back());
    rows.back().seed = 2;
    rows.back().status = "sphere 3 left the world";
    const auto result = compare(four_settings, rows);
    CHECK(result.points[2].status == "sphere 3 left the world");
    CHECK_THAT(study_csv(result), Contains("\"fast\",\"sphere 3 left the world\""));
    CHECK_THAT(study_page(result, {"A title", ""}), Contains("sphere 3 left the world"));
}

TEST_CASE("the front has no setting that a cheaper one beats, and advice names the cheapest", "[app][study]")
{
    const std::vector<Setting> settings = {
        {"reference", {}}, {"default", {}}, {"fast", {}}, {"slow", {}}, {"worse", {}}, {"good", {}}};
    const auto result =
        compare(settings, {row("reference", 100.0, 1e-6, 8.0, 2.0), row("default", 2.0, 1e-4, 8.0, 1.99, 0.001),
                              row("fast", 1.0, 3e-3, 8.0, 1.5), row("slow", 8.0, 1e-5, 8.0, 2.0),
                              row("worse", 4.0, 2e-4, 8.0, 2.0), row("good", 1.5, 1e-4, 8.0, 1.995, 0.001)});
    CHECK(front(result, kind(result, "overlap_95")) == std::vector<std::size_t>{2, 5, 3});
    const auto sentences = advice(result);
    CHECK(std::ranges::count(sentences,
              "For no more overlap_95 than the default's 0.0001 d: use good: 1.3 × faster than the default.") == 1);
    CHECK(std::ranges::count(sentences, "For 1 % in outlet mass_flow: use good: 1.3 × faster than the default.") == 1);
}

TEST_CASE("where the measure's own spread is too large, no setting is recommended", "[app][study]")
{
    const auto result =
        compare(four_settings, {row("reference", 100.0, 1e-6, 8.0, 2.0), row("default", 2.0, 1e-4, 8.0, 2.01, 0.1)});
    const auto sentences = advice(result);
    CHECK(std::ranges::any_of(sentences, [](const std::string& sentence) {
        return sentence.starts_with("No setting is sure to be within 1 % in outlet mass_flow (the default differs by "
                                    "0.5 ± 9.8 %);");
    }));
}

TEST_CASE("a setting that costs as much as a default that is not good enough is named", "[app][study]")
{
    const auto result =
        compare(four_settings, {row("reference", 100.0, 1e-6, 8.0, 2.0), row("default", 2.0, 1e-4, 8.0, 2.1),
                                   row("fast", 1.97, 1e-4, 8.0, 2.001, 1e-4)});
    CHECK(std::ranges::count(
              advice(result), "For 1 % in outlet mass_flow: use fast: it takes as long as the default.") == 1);
}

TEST_CASE("measures that one setting is right for stand in one sentence, and of many the first", "[app][study]")
{
    const auto with_many = [](StudyRow made, double value, double spread) {
        for (int k = 0; k < 9; ++k) made.findings.push_back({"floor force_" + std::to_string(k), value, spread, "N"});
        return made;
    };
    const auto sentences_with = [&](double spread) {
        return advice(compare(four_settings, {with_many(row("reference", 100.0, 1e-6, 8.0, 2.0), 5.0, 0.0),
                                                 with_many(row("default", 2.0, 1e-4, 8.0, 2.0), 5.0, spread),
                                                 with_many(row("fast", 1.0, 1e-3, 8.0, 2.0), 5.0, spread)}));
    };
    CHECK(std::ranges::count(sentences_with(0.0), "For 1 % in outlet mass_flow, floor force_0, floor force_1, floor "
                                                  "force_2, floor force_3, floor force_4 and 4 "
                                                  "more: use fast: 2 × faster than the default.") == 1);
    const auto unsure = sentences_with(0.5);
    CHECK(std::ranges::count_if(unsure, [](const std::string& s) { return s.starts_with("No setting is sure"); }) == 1);
    CHECK_THAT(unsure.back(), Contains("floor force_0 (the default differs by 0 ± 20 %)") && Contains("and 3 more;"));
}

TEST_CASE("settings that came to the same run are one, with the mean of their CPU times", "[app][study]")
{
    const auto result =
        compare(four_settings, {row("reference", 100.0, 1e-6, 8.0, 2.0), row("default", 2.0, 1e-4, 8.0, 2.0),
                                   row("fast", 3.5, 1e-4, 8.0, 2.0), row("slow", 2.0, 1e-4, 8.0, 2.0)});
    CHECK(result.standard().cpu == Approx(2.5));
    CHECK(result.points[2].status == "the same run as default");
    CHECK(result.points[3].status == "the same run as default");
}
