// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/text/input_error.hpp"

#include <filesystem>

namespace talus
{

/// The file that a folder's owner holds locked while it runs, and takes away when it is done.
inline constexpr const char* lock_name = "talus.lock";

/// Another process writes into the folder.
struct FolderBusy : InputError {
    using InputError::InputError;
};

/// Makes this process the only one of Talus that writes into a folder, until it ends in whatever way. The folder itself
/// is locked, and a file in it that names its owner; where folders cannot be locked (NFS) the file alone.
class FolderLock
{
public:
    /// @pre the folder is there
    /// @throws FolderBusy with the owner's process and host where there is one, OutputError where the folder may not
    /// be written
    explicit FolderLock(const std::filesystem::path& folder);
    ~FolderLock();
    FolderLock(FolderLock&& other) noexcept;
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;
    FolderLock& operator=(FolderLock&&) = delete;

    /// To be called before each write: puts the file back where somebody has removed it.
    /// @throws OutputError where the folder is not the one that was locked, or another process has it by now
    void hold();

    /// False where the file system knows no locks.
    bool protects() const { return protects_; }

    std::filesystem::path folder() const { return path_.parent_path(); }

private:
    std::filesystem::path path_;
    int folder_ = -1; ///< descriptors; −1: moved from
    int file_ = -1;
    bool protects_ = false;

    bool take_file();
    void close();
};

} // namespace talus
