// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/system/own_files.hpp"

namespace talus
{

namespace fs = std::filesystem;

fs::path own_files()
{
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    if (!error) {
        const fs::path installed = (program.parent_path() / TALUS_DATA_FROM_PROGRAM).lexically_normal();
        if (fs::is_directory(installed / "scenarios", error)) return installed;
    }
    return TALUS_SOURCE_FOLDER;
}

} // namespace talus
