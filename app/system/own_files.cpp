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
