// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace talus
{

/// Arguments that make no sense; what() is one sentence.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

enum class Verbosity { quiet, normal, verbose };

/// What the user asked for.
struct CommandLine {
    enum class Verb { run, resume, check, keys, list };
    Verb verb = Verb::list;
    std::string scene;                  ///< a path, or a name in scenarios/
    std::string table;                  ///< of keys: the one to show; empty: all
    std::vector<std::string> overrides; ///< key=value
    std::optional<std::int64_t> seed;
    std::optional<double> until; ///< [s]
    std::filesystem::path out;   ///< of run: empty for out/<scene name>; of resume: the run's folder
    std::filesystem::path log;   ///< empty: no log file
    bool force = false;
    bool relax = false;
    int threads = 0; ///< 0: as many as OpenMP takes, all cores unless its environment says otherwise
    Verbosity verbosity = Verbosity::normal;
};

/// Reads the arguments. Nothing is returned where they asked for help or the version, which has then been printed.
/// @throws UsageError
std::optional<CommandLine> parse_command_line(int argc, const char* const* argv);

} // namespace talus
