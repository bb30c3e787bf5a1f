// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/system/whereabouts.hpp"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cmath>
#include <limits>

#include <unistd.h>

namespace talus
{
namespace
{

constexpr double never = std::numeric_limits<double>::quiet_NaN();

// A handler may come between any two of these; each alone is always whole.
std::array<char, 1024> folder = {}; ///< empty: there is no run
std::atomic<std::int64_t> step = 0;
std::atomic<double> time_of_step = 0.0;
std::atomic<RunPhase> phase = RunPhase::output;
std::atomic<double> time_of_checkpoint = never;

void text_to(int descriptor, std::string_view text)
{
    [[maybe_unused]] const ssize_t written = ::write(descriptor, text.data(), text.size()); // there is no one to tell
}

/// Whether the folder still has one.
bool has_checkpoint()
{
    for (const char* name : {"/checkpoint.latest", "/checkpoint.previous"}) {
        ShortText path;
        path << folder.data() << name << std::string_view("\0", 1);
        if (::access(path.view().data(), R_OK) == 0) return true;
    }
    return false;
}

static_assert(std::atomic<double>::is_always_lock_free && std::atomic<RunPhase>::is_always_lock_free);

} // namespace

void note_run(const std::filesystem::path& run)
{
    const std::string name = run.string();
    std::copy_n(name.c_str(), std::min(name.size(), folder.size() - 1), folder.begin());
}

void note_step(std::int64_t begun, double time)
{
    step = begun;
    time_of_step = time;
}

void note_phase(RunPhase begun)
{
    phase = begun;
}

void note_checkpoint(double time)
{
    time_of_checkpoint = time;
}

ShortText& ShortText::operator<<(std::string_view text)
{
    const std::size_t size = std::min(text.size(), text_.size() - size_);
    std::copy_n(text.begin(), size, text_.begin() + static_cast<std::ptrdiff_t>(size_));
    size_ += size;
    return *this;
}

ShortText& ShortText::operator<<(double number)
{
    std::array<char, 32> digits;
    const auto end = std::to_chars(digits.begin(), digits.end(), number, std::chars_format::general, 6).ptr;
    return *this << std::string_view(digits.begin(), static_cast<std::size_t>(end - digits.begin()));
}

ShortText& ShortText::operator<<(std::int64_t number)
{
    std::array<char, 32> digits;
    const auto end = std::to_chars(digits.begin(), digits.end(), number).ptr;
    return *this << std::string_view(digits.begin(), static_cast<std::size_t>(end - digits.begin()));
}

void add_whereabouts(ShortText& text)
{
    if (folder.front() == '\0') return;
    const double checkpoint = time_of_checkpoint;
    text << ", at t = " << time_of_step << " s, in step " << step << " ("
         << phase_names[static_cast<std::size_t>(phase.load())] << "); ";
    if (std::isnan(checkpoint) || !has_checkpoint()) {
        text << "there is no checkpoint in " << folder.data();
        return;
    }
    text << "the last checkpoint in " << folder.data() << " is of t = " << checkpoint << " s; to go on: talus resume "
         << folder.data();
}

void say_last_words(ShortText& text)
{
    add_whereabouts(text);
    text << "\n";
    // On a screen the line of progress may not have ended.
    if (isatty(STDERR_FILENO)) text_to(STDERR_FILENO, "\n");
    text_to(STDERR_FILENO, text.view());
}

} // namespace talus
