// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/loop/open_scene.hpp"
#include "app/system/terminal.hpp"
#include "core/multibody/iteration.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace talus
{

/// The note's algorithms: 2.1, 2.2, 3.1.
enum class Algorithm { residual_update, local_residual, projected };

/// What `talus solve` is to do.
struct SolveRequest {
    std::filesystem::path problem;
    Algorithm algorithm = Algorithm::projected;
    multibody::SolveSettings settings;
    std::filesystem::path history; ///< empty: none
    int guess = 0;                 ///< of the file to start from, counted from 1; 0: start from zero
};

/// Formats of `talus export`: of the frames of a run, or of a scene as the input of another program.
enum class ExportFormat { lammps_dump, csv, vtp, lammps, liggghts };

/// What the user asked for, first of all of which scene.
struct CommandLine : SceneRequest {
    enum class Verb {
        new_scene,
        run,
        resume,
        report,
        watch,
        check,
        keys,
        list,
        export_files,
        dump,
        solve,
        study,
        sweep,
        gather,
        calibrate
    };
    Verb verb = Verb::list;
    std::string table; ///< of keys: the one to show; empty: all
    double at = 0.0;   ///< of dump [s]
    SolveRequest solve;
    ExportFormat format = ExportFormat::vtp; ///< of export, whose scene is a run's folder where frames are meant
    std::filesystem::path study;             ///< file of what to try; empty: the usual
    std::filesystem::path out;  ///< of run: empty for out/<scene name>; of resume, report and watch: the run's folder;
                                ///< of export: empty for one by its format; else a file
    std::filesystem::path log;  ///< empty: no log file
    std::filesystem::path page; ///< of report; empty: report.html in the run's folder
    int frames = 0;             ///< of report: how many to play; 0: as many as are usual
    std::optional<int> sweep_case; ///< of run, whose scene is then the folder of a sweep: the case to run
    int jobs = 0;                  ///< of sweep and calibrate: cases at a time; 0: run none
    bool force = false;
    bool relax = false;
    bool resolved = false;       ///< check prints the resolved scene
    bool report = false;         ///< a run ends with the page that plays it
    bool error_estimate = false; ///< a run spends more on what it says of its own error
    bool watch = false;          ///< a run is shown in a browser while it goes on
    int threads = 0;             ///< 0: as many as OpenMP takes, all cores unless its environment says otherwise
    Verbosity verbosity = Verbosity::normal;
};

/// Reads the arguments. Nothing is returned where they asked for help or the version, which has then been printed.
/// @throws UsageError
std::optional<CommandLine> parse_command_line(int argc, const char* const* argv);

} // namespace talus
