// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/command_line.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>

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

void add_change_options(CLI::App& verb, CommandLine& line)
{
    verb.add_option(
            "--set", line.overrides, "Replace a value of the scene, e.g. contact.glass-glass.friction=0.6; repeatable")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    verb.add_option("--until", line.until, "Simulated time at which the run ends, in seconds")
        ->type_name("T")
        ->check(from_zero_up);
}

void add_scene_options(CLI::App& verb, CommandLine& line)
{
    verb.add_option("SCENE", line.scene, "A scene file, or the name of a scene that 'talus list' shows")
        ->required()
        ->type_name("");
    add_change_options(verb, line);
    verb.add_option("--seed", line.seed, "Seed of all random numbers")->type_name("N")->check(from_zero_up);
}

void add_run_options(CLI::App& verb, CommandLine& line)
{
    verb.add_option("--threads", line.threads, "Threads [all cores]; they do not change the results")
        ->type_name("N")
        ->check(CLI::Range(1, 1024));
    verb.add_option("--log-file", line.log, "Add everything that is printed to this file too, with the time of day")
        ->type_name("FILE");
    CLI::Option* quiet = verb.add_flag_callback(
        "--quiet", [&] { line.verbosity = Verbosity::quiet; }, "Print nothing but errors");
    verb.add_flag_callback(
            "--verbose", [&] { line.verbosity = Verbosity::verbose; },
            "Print the scene first, and a line for every frame and checkpoint")
        ->excludes(quiet);
}

void add_run(CLI::App& app, CommandLine& line)
{
    CLI::App* verb = app.add_subcommand("run", "Run a scene and write frames, metrics and a summary");
    add_scene_options(*verb, line);
    verb->add_option("-o,--out", line.out, "Output folder [out/NAME]")->type_name("DIR")->take_last();
    verb->add_flag("--force", line.force, "Replace the output folder if it holds an earlier run of Talus");
    verb->add_flag("--relax", line.relax, "Move overlapping spheres apart before the run begins");
    add_run_options(*verb, line);
    verb->footer("Example: talus run hopper --set contact.glass-glass.friction=0.6 --until 2 -o out/rough\n"
                 "Ctrl-C stops a run after a checkpoint, from which 'talus resume' goes on; twice, at once. "
                 "SIGUSR1 makes it write a checkpoint.");
    verb->callback([&] { line.verb = CommandLine::Verb::run; });
}

void add_resume(CLI::App& app, CommandLine& line)
{
    CLI::App* verb = app.add_subcommand("resume", "Go on with a run from its last checkpoint, or make it longer");
    verb->add_option("DIR", line.out, "The run's output folder")->required()->type_name("");
    add_change_options(*verb, line);
    add_run_options(*verb, line);
    verb->footer("Example: talus resume out/hopper --until 5");
    verb->callback([&] { line.verb = CommandLine::Verb::resume; });
}

void add_check(CLI::App& app, CommandLine& line)
{
    CLI::App* verb = app.add_subcommand("check", "Validate a scene; say what it holds and what a run of it needs");
    add_scene_options(*verb, line);
    verb->footer("Example: talus check hopper --set time.step=1e-4");
    verb->callback([&] { line.verb = CommandLine::Verb::check; });
}

void add_keys(CLI::App& app, CommandLine& line)
{
    CLI::App* verb = app.add_subcommand("keys", "List the keys of a scene file: range, default, unit, meaning");
    verb->add_option("TABLE", line.table, "One table only")->type_name("");
    verb->footer("Example: talus keys wall");
    verb->callback([&] { line.verb = CommandLine::Verb::keys; });
}

void add_list(CLI::App& app, CommandLine& line)
{
    CLI::App* verb = app.add_subcommand("list", "List the scenes that come with Talus");
    verb->footer("Example: talus list");
    verb->callback([&] { line.verb = CommandLine::Verb::list; });
}

} // namespace

std::optional<CommandLine> parse_command_line(int argc, const char* const* argv)
{
    CommandLine line;
    CLI::App app("Granular dynamics: spheres in frictional contact.", "talus");
    app.set_version_flag("--version", "talus " TALUS_VERSION " (" TALUS_LIBRARIES ")");
    app.require_subcommand(0, 1); // none at all is told below, better than by CLI11
    app.footer("Example: talus run hopper");
    add_run(app, line);
    add_resume(app, line);
    add_check(app, line);
    add_keys(app, line);
    add_list(app, line);
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
        throw UsageError("say what to do: run, resume, check, keys or list; see 'talus --help'");
    return line;
}

} // namespace talus
