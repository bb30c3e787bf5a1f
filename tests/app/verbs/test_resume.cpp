// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/scene_file.hpp"
#include "tests/app/program.hpp"
#include "tests/app/run_folder.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

namespace fs = std::filesystem;
using Catch::Matchers::Contains;

namespace
{

const std::vector<std::string> none;

std::vector<fs::path> supplied_scenes()
{
    std::vector<fs::path> scenes;
    for (const auto& entry : fs::directory_iterator(TALUS_SOURCE_DIR "/scenarios"))
        if (entry.path().extension() == ".toml") scenes.push_back(entry.path());
    std::ranges::sort(scenes);
    return scenes;
}

/// What makes any scene short: few spheres, frames and samples now and then.
std::string shrinking_options(const fs::path& path)
{
    constexpr std::int64_t most = 200;
    const talus::scene::Scene scene = talus::read_scene(path).scene;
    std::string options = " --quiet --set time.frame_interval=0.013 --set time.metrics_interval=0.004"
                          " --set output.contact_interval=0.02";
    for (std::size_t k = 0; k < scene.fill.size(); ++k)
        if (scene.fill[k].count > most)
            options += " --set fill." + std::to_string(k) + ".count=" + std::to_string(most);
    for (std::size_t k = 0; k < scene.pour.size(); ++k)
        if (scene.pour[k].count > most)
            options += " --set pour." + std::to_string(k) + ".count=" + std::to_string(most);
    for (std::size_t k = 0; k < scene.wall.size(); ++k)
        if (scene.wall[k].released_at > 0.0) options += " --set wall." + std::to_string(k) + ".released_at=0.01";
    for (std::size_t k = 0; k < scene.wall.size(); ++k)
        for (std::size_t part = 0; part < scene.wall[k].motion.size(); ++part)
            if (scene.wall[k].motion[part].kind != "table")
                options += " --set wall." + std::to_string(k) + ".motion." + std::to_string(part) + ".from=0.01";
    return options;
}

void break_file(const fs::path& path, std::streamoff at)
{
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(at);
    file.put('\x55');
}

} // namespace

TEST_CASE(
    "every scene in scenarios/, resumed half-way, equals the run that never stopped, for any threads", "[app][resume]")
{
    for (const fs::path& path : supplied_scenes()) {
        DYNAMIC_SECTION(path.stem().string())
        {
            const Workplace place;
            const std::string run = "run " + path.stem().string() + shrinking_options(path);
            REQUIRE(place.talus(run + " --until 0.08 -o whole --threads 1").exit_code == 0);
            REQUIRE(place.talus(run + " --until 0.04 -o parts --threads 2").exit_code == 0);
            REQUIRE(place.talus("resume parts --until 0.08 --quiet --threads 2").exit_code == 0);
            CHECK(differences(place.path("whole"), place.path("parts")) == none);
        }
    }
}

TEST_CASE("pours, outlets, sensors, walls that go and spheres that escape go on where they were", "[app][resume]")
{
    const Workplace place;
    // without its outlet the stream leaves the world at the bottom
    std::string scene = replaced(stream_of_beads(), "name = \"tray\"", "name = \"tray\"\nremove_at = 0.25");
    if (GENERATE(false, true))
        scene = replaced(scene.substr(0, scene.find("[[outlet]]")) + scene.substr(scene.find("[[sensor]]")), "[[wall]]",
            "[world]\non_escape = \"remove\"\n[[wall]]");
    place.write("scene.toml", scene);
    REQUIRE(place.talus("run scene.toml -o whole --threads 2").exit_code == 0);
    REQUIRE(place.talus("run scene.toml -o parts --until 0.13 --threads 1").exit_code == 0);
    REQUIRE(place.talus("resume parts --until 0.3 --threads 1").exit_code == 0);
    REQUIRE(place.talus("resume parts --until 0.4 --threads 1").exit_code == 0);
    CHECK(differences(place.path("whole"), place.path("parts")) == none);
}

TEST_CASE("a plate of finite mass that presses on beads goes on where it was", "[app][resume]")
{
    const Workplace place;
    place.write("scene.toml", loaded_beads());
    REQUIRE(place.talus("run scene.toml -o whole --threads 2").exit_code == 0);
    REQUIRE(place.talus("run scene.toml -o parts --until 0.17 --threads 1").exit_code == 0);
    REQUIRE(place.talus("resume parts --until 0.21 --threads 2").exit_code == 0);
    REQUIRE(place.talus("resume parts --until 0.4 --threads 1").exit_code == 0);
    CHECK(differences(place.path("whole"), place.path("parts")) == none);
    const auto plate = nlohmann::json::parse(place.read("parts/summary.json"))["sensors"]["plate"];
    CHECK(plate["load"]["value"] == Approx(20.0));
    CHECK(plate["travel"]["value"] == Approx(0.05).epsilon(0.01)); // from 0.06 m down to one layer of beads
    CHECK(place.exists("parts/frames/moving_walls_000001.vtp"));
}

TEST_CASE("spheres that stick to each other and to a plate go on where they were", "[app][resume]")
{
    const Workplace place;
    place.write("scene.toml", loaded_beads());
    const std::string sticky = " --set 'contact.0.cohesion={law=\"bond_number\", bond_number=5.0, range=1e-3}' --set "
                               "contact.0.twisting_friction=0.1";
    REQUIRE(place.talus("run scene.toml -o whole --threads 2" + sticky).exit_code == 0);
    REQUIRE(place.talus("run scene.toml -o parts --until 0.17 --threads 1" + sticky).exit_code == 0);
    REQUIRE(place.talus("resume parts --until 0.21 --threads 2").exit_code == 0);
    REQUIRE(place.talus("resume parts --until 0.4 --threads 1").exit_code == 0);
    CHECK(differences(place.path("whole"), place.path("parts")) == none);
    CHECK_THAT(place.read("whole/metrics.csv"), Contains("attraction_energy_J"));
}

TEST_CASE("a run says which of its frames are gone or cut short when it goes on", "[app][resume]")
{
    const Workplace place;
    place.write("scene.toml", beads_in_a_box);
    REQUIRE(place.talus("run scene.toml -o out --until 0.1").exit_code == 0);
    place.shell("rm out/frames/particles_000001.vtp; truncate -s -20 out/frames/particles_000002.vtp");
    const Outcome outcome = place.talus("resume out --until 0.12");
    CHECK(outcome.exit_code == 0);
    CHECK_THAT(outcome.err, Contains("out: 2 of the frames that were written are no longer there or cut short, first "
                                     "frames/particles_000001.vtp; the run goes on without"));
}

TEST_CASE("a run that was killed is resumed as if nothing had happened", "[app][resume]")
{
    const Workplace place;
    place.write("scene.toml", stream_of_beads());
    const std::string run = "run scene.toml --threads 1 --until 1 --set checkpoint.interval=0.05 -o ";
    REQUIRE(place.talus(run + "whole").exit_code == 0);
    REQUIRE(place.talus_until("killed/checkpoint.previous", "KILL", run + "killed").exit_code == 128 + 9);
    const Outcome outcome = place.talus("resume killed --threads 1");
    CHECK(outcome.exit_code == 0);
    CHECK_THAT(outcome.out, Contains("resumed from killed/checkpoint.latest at t = "));
    CHECK(differences(place.path("whole"), place.path("killed")) == none);
}

TEST_CASE("a signal stops a run after a checkpoint, with a summary and a line on how to go on", "[app][resume]")
{
    const auto [signal, exit_code] = GENERATE(table<std::string, int>({{"INT", 130}, {"TERM", 143}}));
    const Workplace place;
    place.write("scene.toml", stream_of_beads());
    const std::string run = "run scene.toml --threads 1 --until 1 -o ";
    REQUIRE(place.talus(run + "whole").exit_code == 0);
    const Outcome stopped = place.talus_until("parts/frames/particles_000010.vtp", signal, run + "parts");
    CHECK(stopped.exit_code == exit_code);
    CHECK_THAT(stopped.err, Contains("stopped by SIG" + signal) && Contains("talus resume parts"));
    CHECK(nlohmann::json::parse(place.read("parts/summary.json"))["status"] == "interrupted");
    CHECK(place.talus("resume parts --threads 1").exit_code == 0);
    CHECK(nlohmann::json::parse(place.read("parts/summary.json"))["status"] == "done");
    CHECK(differences(place.path("whole"), place.path("parts")) == none);
}

TEST_CASE("SIGUSR1 makes a run write a checkpoint and go on", "[app][resume]")
{
    const Workplace place;
    place.write("scene.toml", stream_of_beads());
    const Outcome outcome = place.talus_until(
        "out/frames/particles_000002.vtp", "USR1", "run scene.toml --threads 1 --until 1 -o out --verbose");
    CHECK(outcome.exit_code == 0);
    CHECK(place.exists("out/checkpoint.previous")); // beside that of the end
}

TEST_CASE("checkpoints come at simulated and at wall intervals", "[app][resume]")
{
    const Workplace place;
    place.write("scene.toml", stream_of_beads());
    const std::string option = GENERATE(as<std::string>{}, "checkpoint.interval=0.1", "checkpoint.wall_interval=1e-3");
    const Outcome outcome = place.talus("run scene.toml --threads 1 -o out --verbose --set " + option);
    REQUIRE(outcome.exit_code == 0);
    std::size_t told = 0;
    for (std::size_t at = 0; (at = outcome.err.find("checkpoint at t = ", at)) != std::string::npos; ++at) ++told;
    if (option.starts_with("checkpoint.interval"))
        CHECK(told == 3 + 1); // at 0.1, 0.2, 0.3 s, and before the last step
    else
        CHECK(told > 4);
}

TEST_CASE("when the newer checkpoint is broken the older one is used, and said so", "[app][resume]")
{
    const Workplace place;
    place.write("scene.toml", stream_of_beads());
    REQUIRE(place.talus("run scene.toml --threads 1 -o whole --set checkpoint.interval=0.1").exit_code == 0);
    fs::copy(place.path("whole"), place.path("out"), fs::copy_options::recursive);
    const fs::path latest = place.path("out/checkpoint.latest");
    std::string reason;
    SECTION("a wrong byte")
    {
        break_file(latest, static_cast<std::streamoff>(fs::file_size(latest) / 2));
        reason = "its checksum is wrong";
    }
    SECTION("a file that ends too early")
    {
        fs::resize_file(latest, fs::file_size(latest) - 1);
        reason = "it should hold";
    }
    SECTION("a file that ends in its header")
    {
        fs::resize_file(latest, 10);
        reason = "it ends in its header";
    }
    SECTION("another file")
    {
        place.write("out/checkpoint.latest", "my notes");
        reason = "it is no checkpoint";
    }
    const Outcome outcome = place.talus("resume out --threads 1");
    CHECK(outcome.exit_code == 0);
    CHECK_THAT(outcome.err, Contains("out/checkpoint.latest: " + reason) && Contains("out/checkpoint.previous"));
    CHECK(differences(place.path("whole"), place.path("out")) == none);
}

TEST_CASE("a run that is done can be closed again, or made longer with fewer frames", "[app][resume]")
{
    const Workplace place;
    REQUIRE(place.run(beads_in_a_box).exit_code == 0);
    fs::copy(place.path("out"), place.path("again"), fs::copy_options::recursive);
    CHECK(place.talus("resume again --threads 1").exit_code == 0);
    CHECK(differences(place.path("out"), place.path("again")) == none);
    CHECK(place.talus("resume again --until 0.06 --set time.frame_interval=inf --set solver.max_sweeps=50 --threads 1")
              .exit_code == 0);
    CHECK(place.exists("again/frames/particles_000005.vtp")); // that of the new end
    CHECK_THAT(place.read("again/scene.resolved.toml"), Contains("duration = 0.06 "));
}

TEST_CASE("a run's folder can be moved: it holds the files that its scene names", "[app][resume]")
{
    const Workplace place;
    const std::string facet = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 -1\nvertex 1 0 -1\nvertex 0 1 -1\n"
                              "endloop\nendfacet\nendsolid\n";
    place.shell("mkdir meshes others");
    place.write("meshes/cup.stl", facet);
    place.write("others/cup.stl", replaced(facet, "1 0 -1", "2 0 -1"));
    const auto mesh = [](const std::string& folder) {
        return "[[wall]]\nname = \"" + folder + "\"\nmaterial = \"glass\"\nmesh = \"" + folder + "/cup.stl\"\n";
    };
    place.write("scene.toml", std::string(beads_in_a_box) + mesh("meshes") + mesh("others"));
    REQUIRE(place.talus("run scene.toml --threads 1 -o whole --until 0.06").exit_code == 0);
    REQUIRE(place.talus("run scene.toml --threads 1 -o out").exit_code == 0);
    CHECK(place.read("out/files/cup.stl") == facet);
    CHECK_THAT(place.read("out/scene.resolved.toml"),
        Contains("mesh = \"files/cup.stl\"") && Contains("mesh = \"files/2_cup.stl\""));
    place.shell("mkdir elsewhere; mv out elsewhere/there; rm -r meshes others scene.toml");
    const Outcome outcome = place.talus("resume elsewhere/there --until 0.06 --threads 1");
    INFO(outcome.err);
    CHECK(outcome.exit_code == 0);
    CHECK(place.read("elsewhere/there/metrics.csv") == place.read("whole/metrics.csv"));
    CHECK(place.talus("run elsewhere/there/scene.resolved.toml -o again --until 0.01").exit_code == 0);
}
