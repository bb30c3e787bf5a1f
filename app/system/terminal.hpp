// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string_view>

/// What the program says to its user. All of it goes through here, so that a log file has it too.
namespace talus
{

void say_text(std::string_view text);  ///< on standard output; ends its own lines
void warn_text(std::string_view text); ///< on standard error, likewise
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
/// @throws OutputError
void open_log(const std::filesystem::path& path);

} // namespace talus
