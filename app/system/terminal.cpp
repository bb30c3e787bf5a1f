// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/system/terminal.hpp"

#include "io/text/input_error.hpp"

#include <fmt/chrono.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>

namespace talus
{
namespace
{

/// The one log of this process, as standard output is one.
std::ofstream log_file;

std::string time_of_day()
{
    const auto now = std::chrono::time_point_cast<std::chrono::milliseconds>(std::chrono::system_clock::now());
    const auto milliseconds = now.time_since_epoch().count() % 1000;
    return fmt::format(
        "{:%Y-%m-%d %H:%M:%S}.{:03}", fmt::localtime(std::chrono::system_clock::to_time_t(now)), milliseconds);
}

/// Whether a text begins with digits where the stamp has them, and with the same signs elsewhere.
bool has_shape_of(const std::string& stamp, const std::string& text)
{
    const auto is_digit = [](char c) { return '0' <= c && c <= '9'; };
    return std::ranges::mismatch(stamp, text, [&](char a, char b) { return is_digit(a) ? is_digit(b) : a == b; }).in1 ==
           stamp.end();
}

} // namespace

void say_text(std::string_view text)
{
    std::fwrite(text.data(), 1, text.size(), stdout);
    log_text(text);
}

void warn_text(std::string_view text)
{
    std::fflush(stdout); // so that the two stay in order where they go to one place
    std::fwrite(text.data(), 1, text.size(), stderr);
    log_text(text);
}

void log_text(std::string_view text)
{
    if (!log_file.is_open()) return;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        log_file << time_of_day() << "  " << text.substr(0, end) << '\n';
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    log_file << std::flush;
}

void open_log(const std::filesystem::path& path)
{
    const std::string stamp = time_of_day();
    std::string line;
    std::getline(std::ifstream(path), line);
    if (!line.empty() && !has_shape_of(stamp, line))
        throw UsageError(fmt::format("{}: is no log file of Talus; nothing is added to it", path.string()));
    log_file.open(path, std::ios::app);
    if (!log_file) throw OutputError(fmt::format("{}: cannot be written: {}", path.string(), std::strerror(errno)));
}

} // namespace talus
