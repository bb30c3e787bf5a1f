// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/system/last_words.hpp"

#include "app/system/terminal.hpp"

#include <array>
#include <atomic>
#include <csignal>
#include <cstring>

#include <unistd.h>

namespace talus
{
namespace
{

/// A handler may come at any time: while one text is written, the other is the one to say.
std::array<std::array<char, 1024>, 2> ways_on = {};
std::atomic<std::size_t> said = 0;

/// A stack of the handler's own: that of the program may be what has run out.
alignas(16) std::array<char, 1 << 16> handlers_stack;

extern "C" void handle_crash(int signal)
{
    say_last_words({"talus: this is a fault of Talus, please report it: it crashed (SIG", sigabbrev_np(signal), ")"});
    _exit(static_cast<int>(ExitCode::internal));
}

void write_past_buffers(const char* text)
{
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text, std::strlen(text)); // there is no one to tell
}

} // namespace

void catch_crashes()
{
    stack_t stack = {};
    stack.ss_sp = handlers_stack.data();
    stack.ss_size = handlers_stack.size();
    sigaltstack(&stack, nullptr);
    struct sigaction action = {};
    action.sa_handler = handle_crash;
    action.sa_flags = SA_ONSTACK | static_cast<int>(SA_RESETHAND);
    sigemptyset(&action.sa_mask);
    for (const int crash : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) sigaction(crash, &action, nullptr);
}

void note_checkpoint(const std::filesystem::path& folder, std::optional<double> checkpoint)
{
    const std::string run = folder.string();
    const std::string text =
        checkpoint ? fmt::format("; the last checkpoint in {0} is of t = {1:.6g} s; to go on: talus resume {0}", run,
                         *checkpoint)
                   : fmt::format("; there is no checkpoint in {}", run);
    auto& next = ways_on[1 - said];
    next[text.copy(next.data(), next.size() - 1)] = '\0';
    said = 1 - said;
}

const char* way_on()
{
    return ways_on[said].data();
}

void say_last_words(std::initializer_list<const char*> sentence)
{
    if (isatty(STDERR_FILENO)) write_past_buffers("\n"); // the line of progress may not have ended
    for (const char* part : sentence) write_past_buffers(part);
    write_past_buffers(way_on());
    write_past_buffers("\n");
}

} // namespace talus
