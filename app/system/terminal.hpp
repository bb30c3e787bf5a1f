// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>
#include <string_view>

/// What the program says to its user, and how it ends. All text goes through here, so that a log file has it too.
namespace talus
{

/// How much is said: nothing but errors, the usual, or a line for every frame and checkpoint as well.
enum class Verbosity { quiet, normal, verbose };

/// How the program ends. These are part of its interface.
enum class ExitCode {
    done = 0,
    not_converged = 1, ///< `talus solve`: the tolerance was not met; the result is written all the same
    input = 2,         ///< wrong usage, a wrong scene or a wrong problem
    physics = 3,       ///< a sphere escaped, is not a number or blew up
    output = 4,        ///< a file cannot be written
    internal = 70,     ///< a fault of Talus, or no memory
    stopped = 128      ///< and the number of the signal, after a checkpoint
};

/// Of a program that a signal has stopped.
inline ExitCode stopped_by(int signal)
{
    return static_cast<ExitCode>(static_cast<int>(ExitCode::stopped) + signal);
}

/// Arguments that make no sense; what() is one sentence.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

void say_text(std::string_view text);  ///< on standard output; ends its own lines
void warn_text(std::string_view text); ///< on standard error; ends its own lines
void log_text(std::string_view text);  ///< in the log file alone, if there is one

template <class... Args> void say(fmt::format_string<Args...> format, Args&&... args)
{
    say_text(fmt::format(format, std::forward<Args>(args)...));
}
template <class... Args> void warn(fmt::format_string<Args...> format, Args&&... args)
{
    warn_text(fmt::format(format, std::forward<Args>(args)...));
}

/// From now on adds everything to this file too, each line with the time of day before it.
/// @throws UsageError where the file holds something that is no log, OutputError
void open_log(const std::filesystem::path& path);

} // namespace talus
