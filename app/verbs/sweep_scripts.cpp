// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/verbs/sweep_scripts.hpp"

#include "app/system/own_files.hpp"
#include "app/system/script.hpp"

namespace talus
{
namespace
{

/// The words of a script that runs cases: what it is to call, and what the user asked for.
std::vector<std::string> words_of(const CommandLine& line)
{
    std::vector<std::string> words = {"--talus", own_program().string()};
    if (!line.out.empty()) words.insert(words.end(), {"--out", line.out.string()});
    if (line.jobs > 0) words.insert(words.end(), {"--jobs", std::to_string(line.jobs)});
    if (line.force) words.push_back("--force");
    if (line.verbosity == Verbosity::quiet) words.push_back("--quiet");
    words.insert(words.end(), {"--", line.scene});
    return words;
}

} // namespace

void sweep_scenes(const CommandLine& line)
{
    become_script("sweep.py", words_of(line));
}

void gather_cases(const CommandLine& line)
{
    become_script("gather.py", {"--", line.scene});
}

void study_scene(const CommandLine& line)
{
    std::vector<std::string> words = {"--talus", own_program().string()};
    if (!line.study.empty()) words.insert(words.end(), {"--settings", line.study.string()});
    for (const std::string& text : line.overrides) words.push_back("--set=" + text);
    if (line.seed) words.insert(words.end(), {"--seed", std::to_string(*line.seed)});
    if (line.threads > 0) words.insert(words.end(), {"--threads", std::to_string(line.threads)});
    if (!line.out.empty()) words.insert(words.end(), {"--out", line.out.string()});
    if (line.force) words.push_back("--force");
    if (line.verbosity == Verbosity::quiet) words.push_back("--quiet");
    words.insert(words.end(), {"--", line.scene});
    become_script("study.py", words);
}

void tell_study_keys()
{
    become_script("study.py", {"--keys"});
}

void calibrate_scenes(const CommandLine& line)
{
    become_script("calibrate.py", words_of(line));
}

} // namespace talus
