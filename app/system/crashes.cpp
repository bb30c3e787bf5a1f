// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/system/crashes.hpp"

#include "app/system/exit_code.hpp"
#include "app/system/whereabouts.hpp"

#include <array>
#include <csignal>

#include <unistd.h>

namespace talus
{
namespace
{

struct Crash {
    int signal;
    const char* name;
};

constexpr std::array<Crash, 5> crashes = {
    {{SIGSEGV, "SIGSEGV"}, {SIGBUS, "SIGBUS"}, {SIGFPE, "SIGFPE"}, {SIGILL, "SIGILL"}, {SIGABRT, "SIGABRT"}}};

/// A stack of the handler's own: that of the program may be what has run out.
alignas(16) std::array<char, 1 << 16> handlers_stack;

extern "C" void handle_crash(int signal)
{
    ShortText text;
    text << "talus: this is a fault of Talus, please report it: it crashed (";
    for (const Crash& crash : crashes)
        if (crash.signal == signal) text << crash.name;
    text << ")";
    say_last_words(text);
    _exit(static_cast<int>(ExitCode::internal));
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
    for (const Crash& crash : crashes) sigaction(crash.signal, &action, nullptr);
}

} // namespace talus
