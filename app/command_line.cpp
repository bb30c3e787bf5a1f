// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/command_line.hpp"

#include "app/system/threads.hpp"
#include "io/text/quantity.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>

namespace talus
{
namespace
{

const CLI::Validator from_zero_up(
    [](std::string& text) {
        double value = -1.0;
        const bool good = CLI::detail::lexical_cast(text, value) && value >= 0.0 && std::isfinite(value);
        return good ? std::string() : fmt::format("'{}' is not a finite number from 0 up", text);
    },
    "");

const CLI::Validator seed_numbers(
    [](std::string& text) {
        std::int64_t value = -1;
        const char* const end = text.data() + text.size();
        const auto read = std::from_chars(text.data(), end, value);
        const bool good = read.ec == std::errc() && read.ptr == end && value >= 0;
        return good ? std::string()
                    : fmt::format(
                          "'{}' is not a whole number from 0 to {}", text, std::numeric_limits<std::int64_t>::max());
    },
    "");

const CLI::Validator not_empty(
    [](std::string& text) { return text.empty() ? std::string("a name is wanted, not nothing") : std::string(); }, "");

void add_set_option(CLI::App& verb, CommandLine& line)
{
    verb.add_option("--set", line.overrides,
            "Replace a value of the scene: contact.glass-glass.friction=0.6, wall.drum.motion.0.rate=3; repeatable")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
}

void add_change_options(CLI::App& verb, CommandLine& line)
{
    add_set_option(verb, line);
    verb.add_option("--until", line.until, "Simulated time at which the run ends, in seconds")
        ->type_name("T")
        ->check(from_zero_up);
}

void add_scene_and_seed(CLI::App& verb, CommandLine& line)
{
    verb.add_option("SCENE", line.scene, "A scene file, or the name of a scene that 'talus list' shows")
        ->required()
        ->type_name("");
    verb.add_option("--seed", line.seed, "Seed of all random numbers")->type_name("N")->check(seed_numbers);
}

void add_scene_options(CLI::App& verb, CommandLine& line)
{
    add_scene_and_seed(verb, line);
    add_change_options(verb, line);
    verb.add_option_function<std::string>(
            "--accuracy",
            [&line](const std::string& text) { line.overrides.push_back(fmt::format("accuracy='{}'", text)); },
            "As the scene's key accuracy: the cheapest setting that is known to be no more wrong")
        ->type_name("PERCENT");
}

void add_threads_option(CLI::App& verb, CommandLine& line)
{
    verb.add_option("--threads", line.threads, "Threads [all cores]; they do not change the results")
        ->type_name("N")
        ->check(CLI::Range(1, most_threads));
}

CLI::Option* add_quiet_flag(CLI::App& verb, CommandLine& line)
{
    return verb.add_flag_callback(
        "--quiet", [&] { line.verbosity = Verbosity::quiet; }, "Print nothing but errors");
}

void add_run_options(CLI::App& verb, CommandLine& line)
{
    add_threads_option(verb, line);
    verb.add_option("--log-file", line.log, "Add everything that is printed to this file too, with the time of day")
        ->type_name("FILE");
    CLI::Option* quiet = add_quiet_flag(verb, line);
    verb.add_flag_callback(
            "--verbose", [&] { line.verbosity = Verbosity::verbose; },
            "Print the scene first, and a line for every frame and checkpoint")
        ->excludes(quiet);
}

void add_error_flag(CLI::App& verb, CommandLine& line)
{
    verb.add_flag("--error-estimate", line.error_estimate,
        "Tell what step and solver do to each result, by companions, and look closer at the error of the solver: "
        "the run takes about three times as long");
}

void add_page_flags(CLI::App& verb, CommandLine& line)
{
    verb.add_flag("--report", line.report, "When it is over or stopped, make report.html: a page that plays the run");
    verb.add_flag("--watch", line.watch, "Show the run in a browser while it goes on");
}

void add_force_flag(CLI::App& verb, CommandLine& line)
{
    verb.add_flag("--force", line.force, "Replace a file that is there already");
}

void add_new(CLI::App& app, CommandLine& line)
{
    CLI::App* verb = app.add_subcommand("new", "Write a commented scene to start from");
    verb->add_option("NAME", line.out, "The scene file; .toml is added")->required()->type_name("");
    verb->add_option("--from", line.scene, "Copy this scene that 'talus list' shows, and the files that it names")
        ->type_name("SCENE");
    verb->footer("Example: talus new my_hopper --from hopper\nNothing that is there is replaced.");
    verb->callback([&] { line.verb = CommandLine::Verb::new_scene; });
}

void add_run(CLI::App& app, CommandLine& line)
{
    CLI::App* verb = app.add_subcommand("run", "Run a scene and write frames, metrics and a summary");
    add_scene_options(*verb, line);
    verb->add_option("-o,--out", line.out, "Output folder [out/NAME]")->type_name("DIR")->take_last()->check(not_empty);
    verb->add_flag("--force", line.force, "Replace the output folder if it holds an earlier run of Talus");
    verb->add_flag("--relax", line.relax, "Move overlapping spheres apart before the run begins");
    add_run_options(*verb, line);
    add_error_flag(*verb, line);
    add_page_flags(*verb, line);
    verb->add_option("--case", line.sweep_case, "Bring this case of a sweep, whose folder is SCENE, to its end")
        ->type_name("N")
        ->check(CLI::Range(1, 1000000000));
    verb->footer("Example: talus run hopper --set contact.glass-glass.friction=0.6 --until 2 -o out/rough\n"
                 "Ctrl-C stops a run after a checkpoint, from which 'talus resume' goes on; twice, at once. "
                 "SIGUSR1 makes it write a checkpoint.");
    verb->callback([&line, verb] {
        line.verb = CommandLine::Verb::run;
        for (const char* own : {"--seed", "--set", "--until", "--accuracy", "--out", "--relax"})
            if (line.sweep_case && verb->count(own) > 0)
                throw UsageError(fmt::format("{} is not for a --case, which is as cases.csv of the sweep has it", own));
    });
}

void add_resume(CLI::App& app, CommandLine& line)
{
    CLI::App* verb = app.add_subcommand("resume", "Go on with a run from its last checkpoint, or make it longer");
    verb->add_option("DIR", line.out, "The run's output folder")->required()->type_name("");
    add_change_options(*verb, line);
    add_run_options(*verb, line);
    add_error_flag(*verb, line);
    add_page_flags(*verb, line);
    verb->footer("Example: talus resume out/hopper --until 5");
    verb->callback([&] { line.verb = CommandLine::Verb::resume; });
}

void add_check(CLI::App& app, CommandLine& line)
{
    CLI::App* verb = app.add_subcommand("check", "Validate a scene; say what it holds and what a run of it needs");
    add_scene_options(*verb, line);
    verb->add_flag("--resolved", line.resolved, "Print the scene too, with every key written out");
    verb->footer("Example: talus check hopper --set time.step=1e-4");
    verb->callback([&] { line.verb = CommandLine::Verb::check; });
}

void add_keys(CLI::App& app, CommandLine& line)
{
    CLI::App* verb = app.add_subcommand("keys", "List the keys of a scene file: range, default, unit, meaning");
    verb->add_option("TABLE", line.table, "One table only")->type_name("");
    verb->footer(
        "Example: talus keys wall\nA number may be a text with its unit, \"5 mm\". Units: " + known_units() + ".");
    verb->callback([&] { line.verb = CommandLine::Verb::keys; });
}

void add_list(CLI::App& app, CommandLine& line)
{
    CLI::App* verb = app.add_subcommand("list", "List the scenes that come with Talus");
    verb->footer("Example: talus list");
    verb->callback([&] { line.verb = CommandLine::Verb::list; });
}

void add_dump(CLI::App& app, CommandLine& line)
{
    CLI::App* verb = app.add_subcommand("dump", "Run a scene up to a time and write the contact problem of that step");
    add_scene_and_seed(*verb, line);
    add_set_option(*verb, line);
    verb->add_option("--at", line.at, "Simulated time of the step, in seconds")
        ->type_name("T")
        ->required()
        ->check(from_zero_up);
    verb->add_option("-o,--out", line.out, "The file, in FCLIB's format (HDF5)")
        ->type_name("FILE")
        ->required()
        ->check(not_empty);
    add_force_flag(*verb, line);
    add_threads_option(*verb, line);
    add_quiet_flag(*verb, line);
    verb->footer("Example: talus dump hopper --at 1.8 -o hopper.hdf5");
    verb->callback([&] { line.verb = CommandLine::Verb::dump; });
}

/// An option whose values have names.
template <class Enum>
void add_choice(CLI::App& verb, const char* name, Enum& value, const std::vector<std::pair<std::string, Enum>>& choices,
    const std::string& help)
{
    std::vector<std::string> names;
    for (const auto& choice : choices) names.push_back(choice.first);
    verb.add_option_function<std::string>(
            name,
            [&value, choices](const std::string& text) {
                for (const auto& [known, meaning] : choices)
                    if (known == text) value = meaning;
            },
            help)
        ->check(CLI::IsMember(names))
        ->type_name("NAME");
}

void add_method_options(CLI::App& verb, SolveRequest& solve)
{
    using multibody::LocalSolve;
    using multibody::Order;
    add_choice<Algorithm>(verb, "--algorithm", solve.algorithm,
        {{"2.1", Algorithm::residual_update}, {"2.2", Algorithm::local_residual}, {"3.1", Algorithm::projected}},
        "Of the lecture note, see core/multibody/README.md; 2.1 and 2.2 solve equalities only [3.1]");
    add_choice<LocalSolve>(verb, "--local", solve.settings.local,
        {{"sequential", LocalSolve::sequential}, {"block", LocalSolve::block}, {"sliding", LocalSolve::sliding},
            {"scalar", LocalSolve::scalar}},
        "How one contact is solved: normal first, or by the note's (18)-(19), (20)-(21), (22) [sequential]");
    add_choice<Order>(verb, "--order", solve.settings.order,
        {{"natural", Order::natural}, {"reversed", Order::reversed}, {"symmetric", Order::symmetric},
            {"shuffled", Order::shuffled}},
        "In which order a sweep goes through the contacts [natural]");
    verb.add_option("--seed", solve.settings.seed, "Seed of shuffled orders [1]")->type_name("N")->check(seed_numbers);
    verb.add_option("--omega", solve.settings.omega,
            "Relaxation, above 0 and below 2; as a list, of each sweep, the last of all that follow [1]")
        ->type_name("W[,W...]")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(CLI::Validator(
            [](std::string& text) {
                double value = 0.0;
                const bool good = CLI::detail::lexical_cast(text, value) && value > 0.0 && value < 2.0;
                return good ? std::string() : fmt::format("'{}' is not a number above 0 and below 2", text);
            },
            ""));
}

void add_solve(CLI::App& app, CommandLine& line)
{
    CLI::App* verb = app.add_subcommand("solve", "Solve a contact problem of a file and say how well");
    SolveRequest& solve = line.solve;
    verb->add_option("PROBLEM", solve.problem, "A contact problem in FCLIB's format (HDF5)")->required()->type_name("");
    add_method_options(*verb, solve);
    verb->add_option("--tolerance", solve.settings.tolerance,
            "On the residual, how far the impulses are from the laws: core/METHOD.md (9) [1e-4]")
        ->type_name("EPS")
        ->check(from_zero_up);
    verb->add_option("--max-sweeps", solve.settings.max_sweeps, "Cap on the sweeps [10000]")
        ->type_name("N")
        ->check(CLI::Range(0, 1000000000));
    verb->add_option("--guess", solve.guess, "Start from a guess of the file, counted from 1, instead of from zero")
        ->type_name("N")
        ->check(CLI::Range(1, 1000000));
    verb->add_option("--history", solve.history, "Write the errors after each sweep to this CSV file")
        ->type_name("FILE");
    verb->add_option("-o,--out", line.out, "Write problem and solution (r, u, v) to this file")
        ->type_name("FILE")
        ->check(not_empty);
    add_force_flag(*verb, line);
    add_quiet_flag(*verb, line);
    verb->footer("Example: talus solve hopper.hdf5 --tolerance 1e-6 --history history.csv -o solved.hdf5\n"
                 "Ends with 0 where the tolerance was met, 1 where it was not, 2 where the file is wrong.");
    verb->callback([&line, verb] {
        line.verb = CommandLine::Verb::solve;
        if (verb->count("--seed") > 0 && line.solve.settings.order != multibody::Order::shuffled)
            throw UsageError("--seed is for --order shuffled");
        if (verb->count("--local") > 0 && line.solve.algorithm != Algorithm::projected)
            throw UsageError("--local is for --algorithm 3.1; equalities are solved as blocks");
    });
}

void add_study(CLI::App& app, CommandLine& line)
{
    CLI::App* verb = app.add_subcommand("study", "Run a scene under many settings: error against cost, and advice");
    add_scene_and_seed(*verb, line);
    add_set_option(*verb, line);
    verb->add_option("--settings", line.study, "A study file, of what to try and from when on; 'talus keys study'")
        ->type_name("FILE");
    verb->add_option("-o,--out", line.out, "Output folder [out/study-NAME]")
        ->type_name("DIR")
        ->take_last()
        ->check(not_empty);
    verb->add_flag("--force", line.force, "Begin anew where the folder holds a study");
    verb->add_option("--threads", line.threads, "Runs at a time, each on one thread [all cores]")
        ->type_name("N")
        ->check(CLI::Range(1, most_threads));
    add_quiet_flag(*verb, line);
    verb->footer("Example: talus study hopper --set fill.0.count=2000\n"
                 "A study that was stopped goes on when the same command is given again.");
    verb->callback([&] { line.verb = CommandLine::Verb::study; });
}

void add_export(CLI::App& app, CommandLine& line)
{
    CLI::App* verb = app.add_subcommand(
        "export", "Write the frames of a run for other tools, or a scene as a deck for another program");
    verb->add_option("WHAT", line.scene, "The folder of a run; for a deck, a scene file or the name of a scene")
        ->required()
        ->type_name("");
    add_choice<ExportFormat>(*verb, "--format", line.format,
        {{"lammps-dump", ExportFormat::lammps_dump}, {"csv", ExportFormat::csv}, {"vtp", ExportFormat::vtp},
            {"lammps", ExportFormat::lammps}, {"liggghts", ExportFormat::liggghts}},
        "Of frames: lammps-dump (OVITO), csv, or vtp without LZ4; a deck: lammps or liggghts");
    verb->get_option("--format")->required();
    verb->add_option("-o,--out", line.out, "Output folder [OUT/FORMAT, for a deck out/NAME-FORMAT]")
        ->type_name("DIR")
        ->take_last()
        ->check(not_empty);
    verb->add_flag("--force", line.force, "Replace the files of an earlier export in that folder");
    CLI::Option* seed = verb->add_option("--seed", line.seed, "Of a deck: seed of all random numbers")
                            ->type_name("N")
                            ->check(seed_numbers);
    add_change_options(*verb, line);
    add_quiet_flag(*verb, line);
    verb->footer("Example: talus export out/hopper --format lammps-dump\n"
                 "         talus export silo --format liggghts --until 2 -o silo-deck");
    verb->callback([&line, verb, seed] {
        line.verb = CommandLine::Verb::export_files;
        const bool deck = line.format == ExportFormat::lammps || line.format == ExportFormat::liggghts;
        if (!deck && (seed->count() > 0 || verb->count("--set") > 0 || verb->count("--until") > 0))
            throw UsageError(
                "--set, --until and --seed are for the export of a scene: the frames of a run are as they are");
    });
}

void add_report(CLI::App& app, CommandLine& line)
{
    CLI::App* verb = app.add_subcommand("report", "Make a page that plays a run, for any browser, without a network");
    verb->add_option("DIR", line.out, "The run's output folder; it may be going on, or have been killed")
        ->required()
        ->type_name("");
    verb->add_option("-o,--output", line.page, "The page [DIR/report.html]")
        ->type_name("FILE")
        ->take_last()
        ->check(not_empty);
    verb->add_option("--frames", line.frames, "How many frames to play [60, fewer of many spheres]")
        ->type_name("N")
        ->check(CLI::Range(1, 10000));
    add_force_flag(*verb, line);
    verb->footer("Example: talus report out/hopper");
    verb->callback([&] { line.verb = CommandLine::Verb::report; });
}

void add_watch(CLI::App& app, CommandLine& line)
{
    CLI::App* verb = app.add_subcommand("watch", "Show a run in a browser of this machine, while it goes on");
    verb->add_option("DIR", line.out, "The run's output folder")->required()->type_name("");
    verb->footer(
        "Example: talus watch out/hopper\n"
        "Prints an address that only this machine answers, and opens it where there is a screen. Ctrl-C ends it.");
    verb->callback([&] { line.verb = CommandLine::Verb::watch; });
}

void add_pool_options(CLI::App& verb, CommandLine& line, const char* folder)
{
    verb.add_option("-o,--out", line.out, folder)->type_name("DIR")->take_last()->check(not_empty);
    verb.add_option("--jobs", line.jobs, "Run the cases here, so many at a time [none]")
        ->type_name("N")
        ->check(CLI::Range(1, most_threads));
    verb.add_flag("--force", line.force, "Begin anew where the folder holds another one");
    add_quiet_flag(verb, line);
}

void add_sweep(CLI::App& app, CommandLine& line)
{
    CLI::App* verb = app.add_subcommand("sweep", "Make the cases of a sweep of keys over a scene, and run them");
    verb->add_option("FILE", line.scene, "What to vary, see postprocess/README.md")->required()->type_name("");
    add_pool_options(*verb, line, "Folder of the sweep [out/NAME]");
    verb->footer("Example: talus sweep frictions.toml --jobs 2\n"
                 "Without --jobs it says how Slurm, GNU parallel, Snakemake or Dask run the cases. A sweep that was "
                 "stopped, anyhow, goes on when the same command is given again.");
    verb->callback([&] { line.verb = CommandLine::Verb::sweep; });
}

void add_gather(CLI::App& app, CommandLine& line)
{
    CLI::App* verb = app.add_subcommand("gather", "Gather the results of a sweep into a table and a page");
    verb->add_option("DIR", line.scene, "The folder of the sweep; it may be going on")->required()->type_name("");
    verb->footer("Example: talus gather out/frictions");
    verb->callback([&] { line.verb = CommandLine::Verb::gather; });
}

void add_calibrate(CLI::App& app, CommandLine& line)
{
    CLI::App* verb = app.add_subcommand("calibrate", "Find the values of keys that give what was measured");
    verb->add_option("FILE", line.scene, "What was measured, see postprocess/README.md")->required()->type_name("");
    add_pool_options(*verb, line, "Output folder [out/NAME]");
    verb->footer("Example: talus calibrate glass.toml --jobs 2\n"
                 "Without --jobs it says how the cases are run that are missing; it goes on when the same command is "
                 "given again.");
    verb->callback([&] { line.verb = CommandLine::Verb::calibrate; });
}

} // namespace

std::optional<CommandLine> parse_command_line(int argc, const char* const* argv)
{
    CommandLine line;
    CLI::App app("Granular dynamics: spheres in frictional contact.", "talus");
    app.set_version_flag("--version", "talus " TALUS_VERSION " (" TALUS_LIBRARIES ")");
    app.require_subcommand(0, 1); // none at all is reported below, better than by CLI11
    app.footer("Example: talus run hopper");
    add_new(app, line);
    add_run(app, line);
    add_resume(app, line);
    add_check(app, line);
    add_keys(app, line);
    add_list(app, line);
    add_dump(app, line);
    add_solve(app, line);
    add_study(app, line);
    add_export(app, line);
    add_report(app, line);
    add_watch(app, line);
    add_sweep(app, line);
    add_gather(app, line);
    add_calibrate(app, line);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& help_or_version) {
        app.exit(help_or_version);
        return std::nullopt;
    } catch (const CLI::ParseError& error) {
        const auto verbs = app.get_subcommands();
        throw UsageError(fmt::format(
            "{}; see 'talus {}--help'", error.what(), verbs.empty() ? "" : verbs.front()->get_name() + " "));
    }
    if (app.get_subcommands().empty())
        throw UsageError("say what to do: new, run, resume, report, watch, check, keys, list, export, dump, solve, "
                         "study, sweep, gather or calibrate; see 'talus --help'");
    return line;
}

} // namespace talus
