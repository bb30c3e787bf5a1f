// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/verbs/new_scene.hpp"

#include "app/system/own_files.hpp"
#include "io/run/run_files.hpp"
#include "io/text/input_error.hpp"
#include "io/text/input_file.hpp"

#include <filesystem>
#include <map>

namespace talus
{
namespace
{

namespace fs = std::filesystem;

/// What is to be written: each file, and the one that it is a copy of.
std::map<fs::path, fs::path> copies(const fs::path& scene, const fs::path& original)
{
    std::map<fs::path, fs::path> copies = {{scene, original}};
    for (const NamedFile& file : named_files(read_scene(original).scene))
        copies.emplace(scene.parent_path() / fs::path(file.path).filename(), file.path);
    return copies;
}

} // namespace

void new_scene(const CommandLine& line)
{
    fs::path scene = line.out;
    if (scene.extension() != ".toml") scene += ".toml";
    const fs::path original =
        line.scene.empty() ? own_files() / "scenarios" / "templates" / "new.toml" : supplied_scene(line.scene);

    const auto files = copies(scene, original);
    for (const auto& [copy, from] : files)
        if (std::error_code error; fs::exists(fs::symlink_status(copy, error)))
            throw InputError(fmt::format("{}: the file is there already; choose another name", copy.string()));
    for (const auto& [copy, from] : files) {
        require_writable(copy, false);
        write_atomically(copy, read_bytes(from, "a file"));
    }

    for (const auto& [copy, from] : files) say("wrote {}\n", copy.string());
    say("next: talus check {0}, then talus run {0}\n", scene.string());
}

} // namespace talus
