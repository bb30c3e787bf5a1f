// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/study/workers.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace talus
{
namespace
{

struct Worker {
    std::size_t task = 0;
    pid_t process = 0;
    int words = -1; ///< where its words come from
    std::string heard = {};
};

/// As if begun anew: what signals do to the study must not reach into a run of it.
[[noreturn]] void work(const std::function<std::string(std::size_t)>& task, std::size_t index, int to_the_study)
{
    for (const int signal : {SIGTERM, SIGHUP, SIGXCPU}) ::signal(signal, SIG_DFL);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL); // a study that is killed leaves nothing that computes or writes
    ::signal(SIGINT, SIG_IGN); // Ctrl-C goes to all of a terminal's processes; the study ends its workers itself
    int code = 1;
    try {
        const std::string words = task(index);
        std::size_t sent = 0;
        while (sent < words.size()) {
            const ssize_t count = ::write(to_the_study, words.data() + sent, words.size() - sent);
            if (count < 0 && errno != EINTR) break;
            if (count > 0) sent += static_cast<std::size_t>(count);
        }
        code = sent == words.size() ? 0 : 1;
    } catch (...) { // no memory, say: told by the exit code
    }
    ::_exit(code);
}

Worker begin(const std::function<std::string(std::size_t)>& task, std::size_t index)
{
    std::array<int, 2> pipe{};
    if (::pipe2(pipe.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category());
    const pid_t process = ::fork();
    if (process == 0) work(task, index, pipe[1]);
    const int failure = errno;
    ::close(pipe[1]);
    if (process < 0) {
        ::close(pipe[0]);
        throw std::system_error(failure, std::generic_category());
    }
    return {index, process, pipe[0]};
}

/// Waits until one has said something, or is done. Returns false where it is.
bool hear(Worker& worker)
{
    std::array<char, 65536> some{};
    const ssize_t count = ::read(worker.words, some.data(), some.size());
    if (count < 0 && errno == EINTR) return true;
    if (count > 0) worker.heard.append(some.data(), static_cast<std::size_t>(count));
    return count > 0;
}

/// Empty where it ended well.
std::string ending_of(Worker& worker)
{
    ::close(worker.words);
    int status = 0;
    while (::waitpid(worker.process, &status, 0) < 0 && errno == EINTR) {}
    if (WIFSIGNALED(status)) return fmt::format("crashed: {}", ::strsignal(WTERMSIG(status)));
    return WEXITSTATUS(status) == 0 ? "" : "ended without a result, as for lack of memory";
}

void wait_for_any(const std::vector<Worker>& workers, std::vector<pollfd>& heard)
{
    constexpr int patience = 200; // ms; then the study may want to stop
    heard.clear();
    for (const Worker& worker : workers) heard.push_back({worker.words, POLLIN, 0});
    ::poll(heard.data(), heard.size(), patience);
}

} // namespace

void run_in_copies(std::size_t count, int at_once, const std::function<std::string(std::size_t)>& task,
    const std::function<void(std::size_t, const std::string&, const std::string&)>& done,
    const std::function<bool()>& go_on)
{
    std::vector<Worker> workers;
    std::vector<pollfd> heard;
    std::size_t next = 0;
    while (next < count || !workers.empty()) {
        if (!go_on()) {
            for (Worker& worker : workers) {
                ::kill(worker.process, SIGKILL);
                ending_of(worker);
            }
            return;
        }
        while (next < count && workers.size() < static_cast<std::size_t>(at_once))
            workers.push_back(begin(task, next++));
        wait_for_any(workers, heard);
        for (std::size_t k = workers.size(); k-- > 0;) {
            if (heard[k].revents == 0 || hear(workers[k])) continue;
            Worker worker = std::move(workers[k]);
            workers.erase(workers.begin() + static_cast<std::ptrdiff_t>(k));
            const std::string ending = ending_of(worker);
            done(worker.task, worker.heard, ending);
        }
    }
}

} // namespace talus
