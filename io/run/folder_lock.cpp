// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/folder_lock.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <string>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace talus
{
namespace
{

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path)
{
    throw OutputError(fmt::format("{}: cannot be locked: {}", path.string(), std::strerror(errno)));
}

std::string host()
{
    std::array<char, 256> name{};
    return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "an unknown host";
}

/// Whether the name still leads to what is open.
bool is_still_there(const fs::path& path, int descriptor)
{
    struct stat open = {}, named = {};
    return ::fstat(descriptor, &open) == 0 && ::stat(path.c_str(), &named) == 0 && open.st_ino == named.st_ino &&
           open.st_dev == named.st_dev;
}

enum class Lock { taken, of_another, unknown };

/// Who only looks whether a folder is locked holds it for a moment himself, so it is asked for a few times.
Lock lock(int descriptor)
{
    for (int k = 0;; ++k) {
        if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return Lock::taken;
        if (errno != EWOULDBLOCK) return Lock::unknown;
        if (k == 5) return Lock::of_another;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
}

[[noreturn]] void refuse_second_owner(const fs::path& folder, const fs::path& lock)
{
    std::string owner;
    std::getline(std::ifstream(lock), owner);
    throw FolderBusy(fmt::format("{}: {} writes into this folder; wait until it is done, stop it, or choose another "
                                 "folder; nothing was changed",
        folder.string(), owner.empty() ? "another process of Talus" : owner));
}

} // namespace

FolderLock::FolderLock(const fs::path& folder) : path_(folder / lock_name)
{
    folder_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder_ < 0) refuse(folder);
    const Lock of_folder = lock(folder_);
    protects_ = of_folder == Lock::taken;
    if (of_folder == Lock::of_another || !take_file()) {
        close();
        refuse_second_owner(folder, path_);
    }
}

/// Locks the file, which is made where it is not there. False where another process has it.
bool FolderLock::take_file()
{
    do {
        if (file_ >= 0) ::close(file_);
        file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        const Lock of_file = file_ >= 0 ? lock(file_) : Lock::unknown;
        if (of_file == Lock::of_another) {
            ::close(std::exchange(file_, -1));
            return false;
        }
        protects_ = protects_ || of_file == Lock::taken;
        if (file_ < 0) {
            const int failure = errno;
            close();
            errno = failure;
            refuse(path_);
        }
    } while (!is_still_there(path_, file_)); // its last owner takes it away when it is done

    const std::string owner = fmt::format("process {} on {}\n", ::getpid(), host());
    if (::ftruncate(file_, 0) == 0 && ::write(file_, owner.data(), owner.size()) >= 0) return true;
    const int failure = errno;
    ::unlink(path_.c_str());
    close();
    errno = failure;
    refuse(path_);
}

void FolderLock::hold()
{
    if (!is_still_there(folder(), folder_))
        throw OutputError(
            fmt::format("{}: the folder was removed or moved while this run wrote into it", folder().string()));
    if (!is_still_there(path_, file_) && !take_file())
        throw OutputError(
            fmt::format("{}: the file was removed, and another process has the folder by now; nothing more is "
                        "written",
                path_.string()));
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : path_(std::move(other.path_)), folder_(std::exchange(other.folder_, -1)), file_(std::exchange(other.file_, -1)),
      protects_(other.protects_)
{
}

void FolderLock::close()
{
    if (file_ >= 0) ::close(std::exchange(file_, -1));
    if (folder_ >= 0) ::close(std::exchange(folder_, -1));
}

FolderLock::~FolderLock()
{
    if (file_ >= 0 && is_still_there(path_, file_)) ::unlink(path_.c_str());
    close();
}

} // namespace talus
