// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/system/own_files.hpp"

namespace talus
{

namespace fs = std::filesystem;

namespace
{

fs::path& told()
{
    static fs::path folder;
    return folder;
}

} // namespace

void set_own_files(const fs::path& folder)
{
    told() = folder;
}

fs::path own_files()
{
    if (!told().empty()) return told();
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    if (!error) {
        const fs::path installed = (program.parent_path() / TALUS_DATA_FROM_PROGRAM).lexically_normal();
        if (fs::is_directory(installed / "scenarios", error)) return installed;
    }
    return TALUS_SOURCE_FOLDER;
}

} // namespace talus
