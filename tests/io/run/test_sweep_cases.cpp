// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/sweep_cases.hpp"

#include "io/text/input_error.hpp"

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>

using namespace talus;

namespace
{

namespace fs = std::filesystem;

/// The folder of a sweep of two cases, removed with it.
struct Sweep {
    fs::path path = fs::temp_directory_path() / "talus_test_sweep_cases";

    Sweep()
    {
        fs::create_directories(path / "scene");
        write("scene/bed.toml", "seed = 1");
        write("sweep.json", R"({"version": "1", "scene": "scene/bed.toml", "threads": 3, "reports": false,
            "files": {"bed.toml": "e2239859"}})");
        write("cases.csv", "case,contact.a-b.friction,title,world.min\n"
                           "1,0.5,bare,\n"
                           "2,,\"\"\"say \"\"yes\"\", no\"\"\",\"[-1, 0, inf]\"\n");
    }
    ~Sweep() { fs::remove_all(path); }

    void write(const std::string& name, const std::string& text) const { std::ofstream(path / name) << text; }
};

} // namespace

TEST_CASE("a case of a sweep has the settings of its row, without fields that are empty", "[sweep]")
{
    const Sweep sweep;
    const SweepCase first = read_sweep_case(sweep.path, 1, "1");
    CHECK(first.scene == sweep.path / "scene/bed.toml");
    CHECK(first.folder == sweep.path / "cases/0001");
    CHECK(first.threads == 3);
    CHECK_FALSE(first.report);
    CHECK(first.overrides == std::vector<std::string>{"contact.a-b.friction=0.5", "title=bare"});
    CHECK(first.identity == "contact.a-b.friction=0.5\ntitle=bare\nbed.toml e2239859\n");
    const SweepCase second = read_sweep_case(sweep.path, 2, "1");
    CHECK(second.overrides == std::vector<std::string>{"title=\"say \"yes\", no\"", "world.min=[-1, 0, inf]"});
}

TEST_CASE("a case that cannot be read is refused", "[sweep]")
{
    const Sweep sweep;
    CHECK_THROWS_WITH(read_sweep_case(sweep.path, 3, "1"), Catch::Contains("there is no case 3 among its 2"));
    CHECK_THROWS_WITH(read_sweep_case(sweep.path, 1, "2"), Catch::Contains("begun with Talus 1, and this is 2"));
    CHECK_THROWS_WITH(read_sweep_case(sweep.path / "scene", 1, "1"), Catch::Contains("holds no sweep"));
    sweep.write("scene/bed.toml", "seed = 2");
    CHECK_THROWS_WITH(read_sweep_case(sweep.path, 1, "1"),
        Catch::Contains("bed.toml: the file is not what it was when the sweep was made"));
    sweep.write("scene/bed.toml", "seed = 1");
    sweep.write("cases.csv", "case,a\n1,2,3\n");
    CHECK_THROWS_WITH(
        read_sweep_case(sweep.path, 1, "1"), Catch::Contains("cases.csv:2: the line has 3 fields and the header 2"));
    sweep.write("sweep.json", "{");
    CHECK_THROWS_AS(read_sweep_case(sweep.path, 1, "1"), InputError);
}

TEST_CASE("what became of a case is in its folder", "[sweep]")
{
    const Sweep sweep;
    const fs::path folder = sweep.path / "cases/0001";
    CHECK(status_of_run(folder).empty());
    CHECK(kept_refusal(folder).empty());
    keep_refusal(folder, "a sentence");
    CHECK(kept_refusal(folder) == "a sentence");
    keep_identity(folder, "a=1\n");
    CHECK(kept_identity(folder) == "a=1\n");
    forget_refusal(folder);
    CHECK(kept_refusal(folder).empty());
    sweep.write("cases/0001/summary.json", R"({"status": "done"})");
    CHECK(status_of_run(folder) == "done");
    sweep.write("cases/0001/summary.json", R"({"status": "do)");
    CHECK(status_of_run(folder).empty());
}
