// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/system/script.hpp"

#include "app/system/own_files.hpp"
#include "app/system/terminal.hpp"

#include <array>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace talus
{
namespace
{

namespace fs = std::filesystem;

constexpr const char* python = "/usr/bin/python3"; ///< for which Debian has python3-vtk9

fs::path script_path(const std::string& script)
{
    const fs::path path = own_files() / "postprocess" / script;
    std::error_code error;
    if (!fs::is_regular_file(path, error)) throw UsageError(fmt::format("the script {} is not there", path.string()));
    return path;
}

/// What is executed, as the system takes it.
class Call
{
public:
    Call(const std::string& script, const std::vector<std::string>& arguments)
        : words_{python, script_path(script).string()}
    {
        if (::access(python, X_OK) != 0)
            throw UsageError(
                fmt::format("{} is not there, which draws pages: apt install python3-vtk9 python3-numpy", python));
        words_.insert(words_.end(), arguments.begin(), arguments.end());
        for (std::string& word : words_) pointers_.push_back(word.data());
        pointers_.push_back(nullptr);
    }

    char* const* words() { return pointers_.data(); }

private:
    std::vector<std::string> words_;
    std::vector<char*> pointers_;
};

/// Starts a script in a group of its own, so that the Ctrl-C that stops a run leaves it alone.
pid_t start(Call& call, const posix_spawn_file_actions_t* actions)
{
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    pid_t process = 0;
    const int failure = posix_spawn(&process, python, actions, &attributes, call.words(), environ);
    posix_spawnattr_destroy(&attributes);
    if (failure != 0) throw UsageError(fmt::format("{} cannot be started: {}", python, std::strerror(failure)));
    return process;
}

int end_of(pid_t process)
{
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {}
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::string without_line_ends(std::string text)
{
    while (!text.empty() && text.back() == '\n') text.pop_back();
    return text;
}

} // namespace

void become_script(const std::string& script, const std::vector<std::string>& arguments)
{
    Call call(script, arguments);
    execv(python, call.words());
    throw UsageError(fmt::format("{} cannot be started: {}", python, std::strerror(errno)));
}

ScriptEnd run_script(const std::string& script, const std::vector<std::string>& arguments)
{
    Call call(script, arguments);
    std::array<std::array<int, 2>, 2> pipes{};
    for (auto& one : pipes)
        if (::pipe2(one.data(), O_CLOEXEC) != 0)
            throw UsageError(fmt::format("{} cannot be started: {}", python, std::strerror(errno)));
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, pipes[0][1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, pipes[1][1], STDERR_FILENO);
    const pid_t process = start(call, &actions);
    posix_spawn_file_actions_destroy(&actions);
    for (const auto& one : pipes) ::close(one[1]);

    ScriptEnd end;
    std::array<std::string*, 2> said = {&end.out, &end.err};
    std::array<pollfd, 2> ears = {pollfd{pipes[0][0], POLLIN, 0}, pollfd{pipes[1][0], POLLIN, 0}};
    for (int open = 2; open > 0;) {
        if (::poll(ears.data(), ears.size(), -1) < 0) continue;
        for (std::size_t k = 0; k < ears.size(); ++k) {
            if (ears[k].fd < 0 || ears[k].revents == 0) continue;
            std::array<char, 4096> bytes{};
            const ssize_t count = ::read(ears[k].fd, bytes.data(), bytes.size());
            if (count > 0) {
                said[k]->append(bytes.data(), static_cast<std::size_t>(count));
            } else if (count == 0 || errno != EINTR) {
                ::close(ears[k].fd);
                ears[k].fd = -1;
                --open;
            }
        }
    }
    end.exit_code = end_of(process);
    end.out = without_line_ends(std::move(end.out));
    end.err = without_line_ends(std::move(end.err));
    return end;
}

ScriptBeside::ScriptBeside(const std::string& script, const std::vector<std::string>& arguments)
{
    Call call(script, arguments);
    process_ = start(call, nullptr);
}

ScriptBeside::~ScriptBeside()
{
    end_of(process_);
}

} // namespace talus
