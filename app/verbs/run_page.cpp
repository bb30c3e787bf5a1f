// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/verbs/run_page.hpp"

#include "app/system/script.hpp"

namespace talus
{

ExitCode report_run(const CommandLine& line)
{
    std::vector<std::string> words;
    if (!line.page.empty()) words.insert(words.end(), {"--output", line.page.string()});
    if (line.frames > 0) words.insert(words.end(), {"--frames", std::to_string(line.frames)});
    if (line.force) words.push_back("--force");
    words.insert(words.end(), {"--", line.out.string()});
    become_script("report.py", words);
}

ExitCode watch_run(const CommandLine& line)
{
    become_script("watch.py", {"--", line.out.string()});
}

void make_page(const std::filesystem::path& folder, Verbosity verbosity)
{
    const bool speaks = verbosity != Verbosity::quiet;
    if (speaks) say("page: ");
    std::fflush(stdout); // that takes seconds: who waits knows for what
    ScriptEnd end;
    try {
        end = run_script("report.py", {"--", folder.string()});
        if (end.exit_code != 0 && end.err.empty()) end.err = fmt::format("report.py ended with {}", end.exit_code);
    } catch (const UsageError& error) {
        end.exit_code = 2;
        end.err = error.what();
    }
    if (speaks) say("{}\n", end.exit_code == 0 ? end.out + ", for any browser" : "none");
    if (end.exit_code != 0) warn("the run has no page: {}\n", end.err);
}

} // namespace talus
