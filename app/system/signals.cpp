// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/system/signals.hpp"

#include "app/system/last_words.hpp"

#include <csignal>
#include <unistd.h>

namespace talus
{
namespace
{

// All that a handler may touch.
volatile std::sig_atomic_t stop = 0;
volatile std::sig_atomic_t checkpoint = 0;

extern "C" void handle_stop(int signal)
{
    if (stop != 0) {
        say_last_words({"stopped at once by a second signal"});
        _exit(128 + signal);
    }
    stop = signal;
}

extern "C" void handle_checkpoint(int)
{
    checkpoint = 1;
}

void set_handler(int signal, void (*handler)(int))
{
    struct sigaction action = {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART; // a file that is being written is none of the signal's business
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
}

bool is_ignored(int signal)
{
    struct sigaction action = {};
    sigaction(signal, nullptr, &action);
    return action.sa_handler == SIG_IGN;
}

} // namespace

void survive_signals()
{
    for (const int signal : {SIGUSR1, SIGXFSZ}) set_handler(signal, SIG_IGN);
}

void catch_signals()
{
    for (const int signal : {SIGINT, SIGTERM, SIGXCPU}) set_handler(signal, handle_stop);
    if (!is_ignored(SIGHUP)) set_handler(SIGHUP, handle_stop); // nohup: the run outlives its terminal
    set_handler(SIGUSR1, handle_checkpoint);
}

int stop_signal()
{
    return stop;
}

bool checkpoint_requested()
{
    const bool requested = checkpoint != 0;
    checkpoint = 0;
    return requested;
}

} // namespace talus
