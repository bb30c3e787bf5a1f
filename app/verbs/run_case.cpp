// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/verbs/run_case.hpp"

#include "app/verbs/run_page.hpp"
#include "app/verbs/run_scene.hpp"
#include "io/run/checkpoint.hpp"
#include "io/run/folder_lock.hpp"
#include "io/run/sweep_cases.hpp"
#include "io/text/input_error.hpp"

#include <chrono>
#include <fstream>
#include <iterator>
#include <thread>

namespace talus
{
namespace
{

namespace fs = std::filesystem;

constexpr std::chrono::seconds patience(1); ///< between two looks at a folder that another process has

/// A case as it is run.
struct Case {
    std::string name; ///< "case 7 of out/sweep"
    CommandLine line; ///< as if it were given to `run` or `resume`
    std::string identity;
};

/// The scene of the run that a folder holds; empty where it holds none.
std::string scene_there(const fs::path& folder)
{
    std::ifstream file(folder / "scene.resolved.toml", std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

bool has_checkpoint(const fs::path& folder)
{
    try {
        read_checkpoint(folder, TALUS_VERSION);
        return true;
    } catch (const InputError&) {
        return false;
    }
}

/// What the case is without a run of its own.
ExitCode refuse(const Case& one, const std::string& sentence)
{
    keep_refusal(one.line.out, sentence);
    keep_identity(one.line.out, one.identity);
    warn("{} failed: {}\n", one.name, sentence);
    return ExitCode::done;
}

InputError other_settings(const Case& one)
{
    return InputError(fmt::format("{}: the folder holds a run with other settings than {}; --force replaces it",
        one.line.out.string(), one.name));
}

ExitCode keep_settled(const Case& one, const std::string& status)
{
    keep_identity(one.line.out, one.identity);
    if (one.line.report && !fs::exists(one.line.out / "report.html")) make_page(one.line.out, one.line.verbosity);
    if (one.line.verbosity != Verbosity::quiet) say("{} is settled: {}\n", one.name, status);
    return ExitCode::done;
}

/// A run that an incident ended is the result of its case.
ExitCode settled(const Case& one, ExitCode end)
{
    if (end == ExitCode::done || end == ExitCode::physics) keep_identity(one.line.out, one.identity);
    if (end != ExitCode::physics) return end;
    warn("{} failed, as its summary says\n", one.name);
    return ExitCode::done;
}

ExitCode settle(Case one)
{
    CommandLine& line = one.line;
    if (fs::exists(line.out)) FolderLock wait_for_others(line.out);
    const std::string kept = line.force ? "" : kept_identity(line.out);
    if (!kept.empty() && kept != one.identity) throw other_settings(one);
    if (line.force) forget_refusal(line.out);
    if (const std::string sentence = kept_refusal(line.out); !sentence.empty()) return refuse(one, sentence);

    std::optional<SceneFile> file;
    try {
        file = read_scene_as_asked(line.scene, line);
    } catch (const InputError& error) {
        return refuse(one, error.what());
    }
    const std::string there = line.force ? "" : scene_there(line.out);
    if (!there.empty()) {
        if (there != resolved_scene(with_copies(file->scene, named_files(file->scene)))) throw other_settings(one);
        const std::string status = status_of_run(line.out);
        if (status == "done" || status == "failed") return keep_settled(one, status);
        if (has_checkpoint(line.out)) {
            line.overrides.clear(); // the run's own scene has them
            return settled(one, resume_run(line));
        }
    }
    std::optional<OpenedScene> opened;
    try {
        opened = build_opened(std::move(*file), fs::path(line.scene).stem());
    } catch (const InputError& error) {
        return refuse(one, error.what());
    }
    line.force = true; // what is there began, and did not come to a checkpoint
    return settled(one, run_opened(std::move(*opened), line));
}

} // namespace

ExitCode run_case(const CommandLine& line)
{
    SweepCase found = read_sweep_case(line.scene, *line.sweep_case, TALUS_VERSION);
    Case one{fmt::format("case {} of {}", *line.sweep_case, line.scene), line, found.identity};
    one.line.scene = found.scene;
    one.line.overrides = std::move(found.overrides);
    one.line.out = found.folder;
    if (line.threads == 0) one.line.threads = found.threads;
    one.line.report = line.report || found.report;
    for (bool told = false;; told = true) {
        try {
            return settle(one);
        } catch (const FolderBusy& busy) {
            if (!told) warn("{}: waiting for its end\n", busy.what());
            std::this_thread::sleep_for(patience);
        }
    }
}

} // namespace talus
