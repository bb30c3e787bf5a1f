// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/system/own_files.hpp"

namespace talus
{

namespace fs = std::filesystem;

fs::path own_files()
{
    std::error_code error;
    const fs::path program = own_program();
    if (!program.empty()) {
        const fs::path installed = (program.parent_path() / TALUS_DATA_FROM_PROGRAM).lexically_normal();
        if (fs::is_directory(installed / "scenarios", error)) return installed;
    }
    return TALUS_SOURCE_FOLDER;
}

fs::path own_program()
{
    std::error_code error;
    return fs::read_symlink("/proc/self/exe", error);
}

} // namespace talus
