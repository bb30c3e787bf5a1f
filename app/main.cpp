// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/command_line.hpp"
#include "app/loop/open_scene.hpp"
#include "app/system/last_words.hpp"
#include "app/system/signals.hpp"
#include "app/system/terminal.hpp"
#include "app/verbs/check_scene.hpp"
#include "app/verbs/dump_step.hpp"
#include "app/verbs/export_files.hpp"
#include "app/verbs/new_scene.hpp"
#include "app/verbs/run_case.hpp"
#include "app/verbs/run_page.hpp"
#include "app/verbs/run_scene.hpp"
#include "app/verbs/solve_problem.hpp"
#include "app/verbs/sweep_scripts.hpp"
#include "io/scene/key_table.hpp"
#include "io/text/input_error.hpp"

#include <cstdlib>
#include <filesystem>
#include <new>

#include <malloc.h>
#include <unistd.h>

namespace talus
{
namespace
{

/// Starts the program anew, once, with what the libraries read from the environment before main, unless the user has
/// set it.
///
/// A thread of GCC's OpenMP that has nothing to do spins for a millisecond and more before it sleeps, on a processor
/// that others may need: on two cores that had other work, a run on two threads took more than twice as long and
/// ten times the processor time.
///
/// The C library asks for pages of 2 MB only then: a step of 200 000 settled spheres takes a fifth less time with them,
/// whose places the processor finds sooner.
void restart_with_own_settings(char** argv)
{
    const bool spins = std::getenv("GOMP_SPINCOUNT") || std::getenv("OMP_WAIT_POLICY");
    const bool pages = std::getenv("GLIBC_TUNABLES");
    if (spins && pages) return;
    if (!spins) setenv("GOMP_SPINCOUNT", "2000", 1);
    if (!pages) setenv("GLIBC_TUNABLES", "glibc.malloc.hugetlb=1", 1);
    execv("/proc/self/exe", argv); // returns only if it cannot; then the run goes on as it is
}

/// Memory that a step frees stays with the program, for the next step makes the same arrays anew.
///
/// Otherwise the C library gives the largest back to the system, which hands them out page by page, cleared: of the
/// time of pressure scaling in a column of 300 spheres that was a third.
void keep_freed_memory()
{
    mallopt(M_MMAP_THRESHOLD, 32 << 20); // the largest that it takes
    mallopt(M_TRIM_THRESHOLD, 1 << 30);
}

ExitCode execute(const CommandLine& line)
{
    if (!line.log.empty()) open_log(line.log);
    switch (line.verb) {
    case CommandLine::Verb::new_scene:
        new_scene(line);
        break;
    case CommandLine::Verb::run:
        return line.sweep_case ? run_case(line) : run_scene(line);
    case CommandLine::Verb::resume:
        return resume_run(line);
    case CommandLine::Verb::check:
        check_scene(open_scene(line), line.resolved);
        break;
    case CommandLine::Verb::keys:
        if (line.table == "study") tell_study_keys();
        say_text(key_table(line.table));
        break;
    case CommandLine::Verb::list:
        list_scenes();
        break;
    case CommandLine::Verb::dump:
        return dump_step(line);
    case CommandLine::Verb::solve:
        return solve_problem(line);
    case CommandLine::Verb::export_files:
        return export_files(line);
    case CommandLine::Verb::report:
        return report_run(line);
    case CommandLine::Verb::watch:
        return watch_run(line);
    case CommandLine::Verb::study:
        study_scene(line);
    case CommandLine::Verb::sweep:
        sweep_scenes(line);
    case CommandLine::Verb::gather:
        gather_cases(line);
    case CommandLine::Verb::calibrate:
        calibrate_scenes(line);
    }
    return ExitCode::done;
}

ExitCode fail(ExitCode code, const std::string& sentence)
{
    warn("{}\n", sentence);
    return code;
}

ExitCode execute_guarded(int argc, const char* const* argv)
{
    try {
        const auto line = parse_command_line(argc, argv);
        return line ? execute(*line) : ExitCode::done;
    } catch (const UsageError& error) {
        return fail(ExitCode::input, fmt::format("talus: {}", error.what()));
    } catch (const InputError& error) {
        return fail(ExitCode::input, error.what());
    } catch (const OutputError& error) {
        return fail(ExitCode::output, fmt::format("{}{}", error.what(), way_on()));
    } catch (const std::filesystem::filesystem_error& error) { // of a name that cannot be looked at
        return fail(ExitCode::input, fmt::format("{}: {}{}", error.path1().string(), error.code().message(), way_on()));
    } catch (const std::bad_alloc&) {
        return fail(ExitCode::internal, fmt::format("talus: there is not enough memory{}", way_on()));
    } catch (const std::exception& error) {
        return fail(ExitCode::internal,
            fmt::format("talus: this is a fault of Talus, please report it: {}{}", error.what(), way_on()));
    }
}

} // namespace
} // namespace talus

int main(int argc, char** argv)
{
    talus::survive_signals();
    talus::restart_with_own_settings(argv);
    talus::keep_freed_memory();
    talus::catch_crashes();
    return static_cast<int>(talus::execute_guarded(argc, argv));
}
