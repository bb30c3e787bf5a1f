// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/trial_run.hpp"

#include "io/text/input_error.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <system_error>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace talus
{

namespace
{

// What the copy says, followed by a sentence where it refuses; nothing where it crashed.
constexpr char accepts = 'a';
constexpr char refuses = 'r';

/// A crash is to end the copy at once and quietly: no handler, no core file, no word.
void make_crashes_quiet()
{
    for (const int crash : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU}) ::signal(crash, SIG_DFL);
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_CORE, &none);
    ::dup2(::open("/dev/null", O_WRONLY), STDERR_FILENO);
}

/// Of addresses, in use now [B].
std::size_t memory_in_use()
{
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    return pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

void set_limits(const TrialLimits& limits)
{
    const auto seconds = static_cast<rlim_t>(limits.seconds); // a copy begins at 0
    const rlimit time{seconds, seconds + 1};
    ::setrlimit(RLIMIT_CPU, &time);
    const rlim_t bytes = memory_in_use() + limits.memory;
    const rlimit memory{bytes, bytes};
    ::setrlimit(RLIMIT_AS, &memory);
}

[[noreturn]] void say_and_leave(int to_the_original, const std::string& words)
{
    const bool said = ::write(to_the_original, words.data(), words.size()) == static_cast<ssize_t>(words.size());
    ::_exit(said ? 0 : 1);
}

[[noreturn]] void act_in_the_copy(const std::function<void()>& act, const TrialLimits& limits, int to_the_original)
{
    make_crashes_quiet();
    set_limits(limits);
    try {
        act();
    } catch (const InputError& error) {
        say_and_leave(to_the_original, refuses + std::string(error.what()));
    } catch (...) { // no memory: as good as a crash
        ::_exit(1);
    }
    say_and_leave(to_the_original, std::string(1, accepts));
}

/// All that comes until no one is left who could write.
std::string read_all(int descriptor)
{
    std::string words;
    std::array<char, 4096> some{};
    for (;;) {
        const ssize_t count = ::read(descriptor, some.data(), some.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return words;
        words.append(some.data(), static_cast<std::size_t>(count));
    }
}

/// What a copy says of `act`.
std::string ask_a_copy(const std::function<void()>& act, const TrialLimits& limits)
{
    std::array<int, 2> pipe{};
    if (::pipe2(pipe.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category());
    const pid_t copy = ::fork();
    if (copy == 0) act_in_the_copy(act, limits, pipe[1]);
    const int failure = errno;
    ::close(pipe[1]);
    const std::string words = read_all(pipe[0]);
    ::close(pipe[0]);
    if (copy < 0) throw std::system_error(failure, std::generic_category());
    while (::waitpid(copy, nullptr, 0) < 0 && errno == EINTR) {}
    return words;
}

} // namespace

void try_in_a_copy(const std::function<void()>& act, const TrialLimits& limits, const std::string& crashed)
{
    const std::string words = ask_a_copy(act, limits);
    if (words.empty()) throw InputError(crashed);
    if (words.front() == refuses) throw InputError(words.substr(1));
}

} // namespace talus
