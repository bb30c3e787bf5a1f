// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/verbs/export_files.hpp"

#include "app/loop/open_scene.hpp"
#include "app/system/terminal.hpp"
#include "io/export/deck_export.hpp"
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

void say_done(const CommandLine& line, const fs::path& folder, const ExportNotes& notes, const std::string& next)
{
    for (const std::string& note : notes) warn("{}\n", note);
    if (line.verbosity != Verbosity::quiet) say("{}{}\n", folder.string(), next);
}

ExitCode export_run(const CommandLine& line, FrameFormat format)
{
    const RecordedRun run = read_run(line.scene);
    const fs::path folder = line.out.empty() ? run.folder / name_of(format) : line.out;
    const ExportNotes notes = export_frames(run, format, folder, line.force);
    say_done(line, folder, notes, fmt::format(": {} frames", run.particles.size()));
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

ExitCode export_scene(const CommandLine& line, DeckProgram program)
{
    const OpenedScene opened = open_scene(line);
    const std::string name = program_name(program);
    const fs::path folder = line.out.empty() ? fs::path("out") / fmt::format("{}-{}", opened.name, name) : line.out;
    require_outside(folder, inputs_of(opened, named_files(opened.scene)));
    const ExportNotes notes =
        export_deck(opened.scene, opened.simulation, {program, opened.name, TALUS_VERSION}, folder, line.force);
    say_done(line, folder, notes, fmt::format("; to run it: cd {} && {}", folder.string(), deck_command(program)));
    return ExitCode::done;
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
        return export_scene(line, DeckProgram::lammps);
    case ExportFormat::liggghts:
        return export_scene(line, DeckProgram::liggghts);
    }
    return ExitCode::done;
}

} // namespace talus
