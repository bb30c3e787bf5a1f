// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/run_files.hpp"
#include "io/text/input_error.hpp"
#include "tests/io/scene_folder.hpp"

#include <catch2/catch.hpp>

using namespace talus;
using namespace talus::test;
namespace fs = std::filesystem;

TEST_CASE("a new run folder holds the resolved scene", "[run_files]")
{
    const SceneFolder folder;
    const fs::path run = folder.path() / "out" / "hopper";
    make_run_folder(run, "seed = 1\n", false);
    CHECK(read_file(run / "scene.resolved.toml") == "seed = 1\n");
    CHECK(std::distance(fs::directory_iterator(run), {}) == 1); // no temporary file stays
}

TEST_CASE("a folder that Talus did not write is never touched", "[run_files]")
{
    const SceneFolder folder;
    folder.write("thesis.txt", "precious");
    for (const bool force : {false, true})
        CHECK(
            error_of<InputError>([&] { make_run_folder(folder.path(), "", force); }) ==
            folder.path().string() + ": the folder holds files that are not of a run of Talus; choose another with -o");
    CHECK(read_file(folder.path() / "thesis.txt") == "precious");
}

TEST_CASE("a run is replaced only when forced, and the user's own files in it stay", "[run_files]")
{
    const SceneFolder folder;
    make_run_folder(folder.path(), "old", false);
    fs::create_directory(folder.path() / "frames");
    for (const char* name : {"metrics.csv", "summary.json", "particles.pvd", "frames/walls_000003.vtp",
             "profile_bed.csv", "profile_bed.png", "notes.txt"})
        folder.write(name, "old");

    CHECK(error_of<InputError>([&] { make_run_folder(folder.path(), "new", false); }) ==
          folder.path().string() + ": the folder holds a run already; --force replaces it, -o chooses another");
    CHECK(read_file(folder.path() / "scene.resolved.toml") == "old");

    make_run_folder(folder.path(), "new", true);
    CHECK(read_file(folder.path() / "scene.resolved.toml") == "new");
    for (const char* name :
        {"metrics.csv", "summary.json", "particles.pvd", "frames/walls_000003.vtp", "profile_bed.csv"})
        CHECK_FALSE(fs::exists(folder.path() / name));
    for (const char* name : {"profile_bed.png", "notes.txt"}) CHECK(read_file(folder.path() / name) == "old");
}

TEST_CASE("a run folder that cannot be is refused", "[run_files]")
{
    const SceneFolder folder;
    const fs::path file = folder.write("file", "");
    CHECK(error_of<InputError>([&] { make_run_folder(file, "", false); }) ==
          file.string() + ": is a file, not a folder for a run's output");
    CHECK(error_of<OutputError>([&] { make_run_folder(file / "below", "", false); }) ==
          (file / "below").string() + ": cannot be written: Not a directory");
}

TEST_CASE("a file is replaced as a whole", "[run_files]")
{
    const SceneFolder folder;
    const fs::path path = folder.write("summary.json", "a long old text");
    write_atomically(path, "new");
    CHECK(read_file(path) == "new");
}

TEST_CASE("a full disk leaves the old file as it was", "[run_files]")
{
    const SceneFolder folder;
    const fs::path path = folder.write("summary.json", "old");
    fs::create_symlink("/dev/full", folder.path() / "summary.json.tmp");
    CHECK(error_of<OutputError>([&] { write_atomically(path, "new"); }) ==
          path.string() + ": cannot be written: No space left on device");
    CHECK(read_file(path) == "old");
    CHECK(error_of<OutputError>([&] { write_atomically(folder.path() / "none" / "file", "new"); }) ==
          (folder.path() / "none" / "file").string() + ": cannot be written: No such file or directory");
}

TEST_CASE("metrics are a header and a row a sample, there at once", "[run_files]")
{
    const SceneFolder folder;
    const fs::path path = folder.path() / "metrics.csv";
    MetricsFile metrics(path, {"time_s", "flow, of all_kg_per_s"});
    metrics.add_row({0.1, 1.0 / 3.0});
    CHECK(read_file(path) == "time_s,\"flow, of all_kg_per_s\"\n0.1,0.3333333333333333\n");
}

TEST_CASE("a table is a file of its own, with units in its header", "[run_files]")
{
    const SceneFolder folder;
    write_table(folder.path(), "bed",
        {{{"position", "m"}, {"torque", "N m"}, {"samples", "1"}}, {{0.5, 1e-3, 7}, {1.5, 2, 8}}});
    CHECK(read_file(folder.path() / "profile_bed.csv") == "position_m,torque_N_m,samples\n0.5,0.001,7\n1.5,2,8\n");
}

TEST_CASE("metrics on a full disk or in no folder are an output error", "[run_files]")
{
    CHECK(error_of<OutputError>([] { MetricsFile("/dev/full", {"time_s"}); }) ==
          "/dev/full: cannot be written: No space left on device");
    const SceneFolder folder;
    const fs::path path = folder.path() / "none" / "metrics.csv";
    CHECK(error_of<OutputError>([&] { MetricsFile(path, {"time_s"}); }) ==
          path.string() + ": cannot be written: No such file or directory");
}

TEST_CASE("metrics go on from where a checkpoint left them", "[run_files]")
{
    const SceneFolder folder;
    const fs::path path = folder.path() / "metrics.csv";
    WrittenFile written;
    {
        MetricsFile metrics(path, {"time_s"});
        metrics.add_row({0.1});
        metrics.sync();
        written = metrics.written();
        metrics.add_row({0.2});
    }
    MetricsFile(path, {"time_s"}, written).add_row({0.3});
    CHECK(read_file(path) == "time_s\n0.1\n0.3\n");

    const std::string changed = path.string() + ": the file is not as the run left it";
    CHECK(error_of<InputError>([&] { MetricsFile(path, {"time_s"}, {100, written.sum}); }) == changed);
    CHECK(error_of<InputError>([&] { MetricsFile(path, {"time_s", "flow"}, written); }) == changed);
    CHECK(read_file(path) == "time_s\n0.1\n0.3\n");
    std::ofstream(path) << "time_s\n0.2\n0.3\n"; // another number in a row that was there
    CHECK(error_of<InputError>([&] { MetricsFile(path, {"time_s"}, written); }) == changed);
    CHECK(read_file(path) == "time_s\n0.2\n0.3\n");
}
