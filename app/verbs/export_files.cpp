// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/verbs/export_files.hpp"

#include "app/loop/open_scene.hpp"
#include "app/system/own_files.hpp"
#include "app/system/script.hpp"
#include "app/system/terminal.hpp"
#include "io/export/frame_export.hpp"
#include "io/run/run_files.hpp"

namespace talus
{
namespace
{

namespace fs = std::filesystem;

/// The name of a format of frames, as its folder is called.
std::string name_of(FrameFormat format)
{
    return format == FrameFormat::csv ? "csv" : format == FrameFormat::vtp ? "vtp" : "lammps-dump";
}

ExitCode export_run(const CommandLine& line, FrameFormat format)
{
    const RecordedRun run = read_run(line.scene);
    const fs::path folder = line.out.empty() ? run.folder / name_of(format) : line.out;
    const ExportNotes notes = export_frames(run, format, folder, line.force);
    for (const std::string& note : notes) warn("{}\n", note);
    if (line.verbosity != Verbosity::quiet) say("{}: {} frames\n", folder.string(), run.particles.size());
    return ExitCode::done;
}

/// @throws InputError where a file lies in the folder of an export, which might replace it
void require_outside(const fs::path& folder, const std::vector<fs::path>& inputs)
{
    for (const fs::path& input : inputs)
        if (lies_in(folder, input))
            throw InputError(fmt::format(
                "{}: the deck is made from this file; choose another folder than its own with -o", input.string()));
}

/// Opens the scene, so that what is wrong with it is said as everywhere, and becomes the script that writes decks.
[[noreturn]] void export_scene(const CommandLine& line, const std::string& program)
{
    const OpenedScene opened = open_scene(line);
    const fs::path folder = line.out.empty() ? fs::path("out") / fmt::format("{}-{}", opened.name, program) : line.out;
    require_outside(folder, inputs_of(opened, named_files(opened.scene)));
    std::vector<std::string> words = {
        "--talus", own_program().string(), "--format", program, "--out=" + folder.string()};
    for (const std::string& text : line.overrides) words.push_back("--set=" + text);
    if (line.seed) words.push_back(fmt::format("--set=seed={}", *line.seed));
    if (line.until) words.push_back(fmt::format("--set=time.duration={}", *line.until));
    if (line.force) words.push_back("--force");
    if (line.verbosity == Verbosity::quiet) words.push_back("--quiet");
    words.insert(words.end(), {"--", line.scene});
    become_script("export_deck.py", words);
}

} // namespace

ExitCode export_files(const CommandLine& line)
{
    switch (line.format) {
    case ExportFormat::lammps_dump:
        return export_run(line, FrameFormat::lammps_dump);
    case ExportFormat::csv:
        return export_run(line, FrameFormat::csv);
    case ExportFormat::vtp:
        return export_run(line, FrameFormat::vtp);
    case ExportFormat::lammps:
        export_scene(line, "lammps");
    case ExportFormat::liggghts:
        export_scene(line, "liggghts");
    }
    return ExitCode::done;
}

} // namespace talus
