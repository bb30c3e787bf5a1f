// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/checkpoint.hpp"
#include "io/text/input_error.hpp"
#include "io/text/input_file.hpp"
#include "tests/io/scene_folder.hpp"

#include <catch2/catch.hpp>

using namespace talus;
using namespace talus::test;
namespace fs = std::filesystem;

TEST_CASE("the checksum is CRC-32", "[checkpoint]")
{
    CHECK(checksum("123456789") == 0xcbf43926); // its check value
    CHECK(checksum("") == 0);
}

TEST_CASE("the last two checkpoints are kept, and the newest is read", "[checkpoint]")
{
    const SceneFolder folder;
    for (const char* state : {"first", "second", "third"}) write_checkpoint(folder.path(), "0.1.0", state);
    CHECK(read_checkpoint(folder.path(), "0.1.0").state == "third");
    CHECK(read_checkpoint(folder.path(), "0.1.0").newer_is_broken.empty());
    CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 2);
    fs::remove(folder.path() / "checkpoint.latest");
    CHECK(read_checkpoint(folder.path(), "0.1.0").state == "second");
}

TEST_CASE("a checkpoint that is broken is passed over, whichever byte it is", "[checkpoint]")
{
    const SceneFolder folder;
    write_checkpoint(folder.path(), "0.1.0", "old");
    write_checkpoint(folder.path(), "0.1.0", "new");
    const std::string good = read_file(folder.path() / "checkpoint.latest");
    for (std::size_t k = 0; k < good.size(); ++k) {
        std::string bad = good;
        bad[k] = static_cast<char>(bad[k] ^ 1);
        folder.write("checkpoint.latest", bad);
        const Checkpoint checkpoint = read_checkpoint(folder.path(), "0.1.0");
        CHECK(checkpoint.state == "old");
        CHECK_FALSE(checkpoint.newer_is_broken.empty());
        folder.write("checkpoint.latest", good.substr(0, k));
        CHECK(read_checkpoint(folder.path(), "0.1.0").state == "old");
    }
}

TEST_CASE("a disk that is full costs no checkpoint that was there", "[checkpoint]")
{
    const SceneFolder folder;
    write_checkpoint(folder.path(), "0.1.0", "old");
    fs::create_symlink("/dev/full", folder.path() / "checkpoint.next.tmp");
    CHECK(error_of<OutputError>([&] { write_checkpoint(folder.path(), "0.1.0", "new"); }).find("No space left") !=
          std::string::npos);
    CHECK(read_checkpoint(folder.path(), "0.1.0").state == "old");
}
