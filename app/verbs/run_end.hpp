// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/loop/open_scene.hpp"
#include "app/loop/run_loop.hpp"
#include "app/system/exit_code.hpp"

#include <filesystem>

namespace talus
{

/// Runs what is ready to run, writes summary.json and tells how it went.
/// @returns how the program ends
/// @throws OutputError
ExitCode run_to_end(const OpenedScene& opened, RunLoop& loop, const std::filesystem::path& folder, Verbosity verbosity);

} // namespace talus
