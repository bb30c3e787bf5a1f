// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/app/program.hpp"

#include <catch2/catch.hpp>

using Catch::Matchers::Contains;

TEST_CASE("an export replaces its own files with --force, and no others", "[app][export]")
{
    const Workplace place;
    REQUIRE(place.run(beads_in_a_box).exit_code == 0);
    const std::string format = GENERATE(as<std::string>{}, "csv", "vtp", "lammps-dump");
    REQUIRE(place.talus("export out --format " + format + " -o there").exit_code == 0);
    place.write("there/notes.txt", "mine");

    const Outcome again = place.talus("export out --format " + format + " -o there");
    CHECK(again.exit_code == 2);
    CHECK_THAT(again.err, Contains("there") && Contains("--force"));
    CHECK(place.talus("export out --format csv -o there --force").exit_code == 0);
    CHECK(place.read("there/notes.txt") == "mine");
    CHECK(place.exists("there/particles_000000.csv"));
    if (format == "lammps-dump") CHECK_FALSE(place.exists("there/particles.lammpstrj"));
    if (format == "vtp") CHECK_FALSE(place.exists("there/particles_000000.vtp"));
}

TEST_CASE("an export keeps out of folders that are not its own", "[app][export]")
{
    const Workplace place;
    REQUIRE(place.run(beads_in_a_box).exit_code == 0);
    std::filesystem::create_directory(place.path("thesis"));
    place.write("thesis/thesis.tex", "ten years of work");
    const std::string arguments = GENERATE(as<std::string>{}, "export out --format csv", "export out --format vtp");
    const Outcome outcome = place.talus(arguments + " -o thesis --force");
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.err, Contains("thesis") && Contains("-o"));
    CHECK(place.read("thesis/thesis.tex") == "ten years of work");
}

TEST_CASE("the frames of a run go into its folder unless the user says otherwise", "[app][export]")
{
    const Workplace place;
    REQUIRE(place.run(beads_in_a_box).exit_code == 0);
    const Outcome outcome = place.talus("export out --format csv");
    CHECK(outcome.exit_code == 0);
    CHECK_THAT(outcome.out, Contains("out/csv: 6 frames"));
    CHECK_THAT(outcome.err, Contains("contact_interval") && Contains("walls are not in CSV files"));
    CHECK_THAT(place.read("out/csv/particles_000005.csv"), Contains("time_s,position_x_m") && Contains(",glass\n"));
}

TEST_CASE("wrong exports end with 2 and one sentence", "[app][export]")
{
    const Workplace place;
    place.write("scene.toml", beads_in_a_box);
    REQUIRE(place.talus("run scene.toml --quiet --threads 1 --until 0.01 -o out").exit_code == 0);
    std::filesystem::create_directory(place.path("empty"));
    const std::string arguments = GENERATE(as<std::string>{}, "export out", "export out --format stl",
        "export empty --format csv", "export nowhere --format vtp", "export nowhere --format lammps",
        "export out --format csv --until 2", "export out --format csv -o scene.toml");
    CAPTURE(arguments);
    const Outcome outcome = place.talus(arguments);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.out.empty());
    CHECK(line_of(outcome.err + "|", "|") == 2);
}

TEST_CASE("a frame that is damaged is reported by its name", "[app][export]")
{
    const Workplace place;
    REQUIRE(place.run(beads_in_a_box).exit_code == 0);
    place.write("out/frames/particles_000002.vtp", "no frame");
    const Outcome outcome = place.talus("export out --format csv");
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.err, Contains("out/frames/particles_000002.vtp"));
}
