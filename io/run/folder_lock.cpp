// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/folder_lock.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
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

/// Whether the name still leads to the open file: its last owner takes the file away when it is done.
bool is_still_there(const fs::path& path, int descriptor)
{
    struct stat open = {}, named = {};
    return ::fstat(descriptor, &open) == 0 && ::stat(path.c_str(), &named) == 0 && open.st_ino == named.st_ino &&
           open.st_dev == named.st_dev;
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
    do {
        if (descriptor_ >= 0) ::close(descriptor_);
        descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (descriptor_ < 0) refuse(path_);
        protects_ = ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0;
        if (!protects_ && errno == EWOULDBLOCK) {
            ::close(descriptor_);
            refuse_second_owner(folder, path_);
        }
    } while (!is_still_there(path_, descriptor_));

    const std::string owner = fmt::format("process {} on {}\n", ::getpid(), host());
    if (::ftruncate(descriptor_, 0) != 0 || ::write(descriptor_, owner.data(), owner.size()) < 0) {
        const int failure = errno;
        ::unlink(path_.c_str());
        ::close(descriptor_);
        errno = failure;
        refuse(path_);
    }
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)), protects_(other.protects_)
{
}

FolderLock::~FolderLock()
{
    if (descriptor_ < 0) return;
    ::unlink(path_.c_str());
    ::close(descriptor_);
}

} // namespace talus
