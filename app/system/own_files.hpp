// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace talus
{

/// The folder of what comes with the program: `scenarios` and `postprocess`. Where the program is installed it is
/// share/talus beside its own folder, wherever that was moved to; else the source tree that it was built from.
std::filesystem::path own_files();

/// Makes it this folder, for what is no program of its own: a module of Python.
void set_own_files(const std::filesystem::path& folder);

/// The file of the program itself; empty where the system does not tell.
std::filesystem::path own_program();

} // namespace talus
