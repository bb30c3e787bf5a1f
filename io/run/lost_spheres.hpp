// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/supply/removal.hpp"

#include <filesystem>
#include <vector>

namespace talus
{

/// Writes lost.vtp into a run's folder: the spheres that escaped, each as it was then. Without any the file is removed.
/// @throws OutputError
void write_lost(const std::filesystem::path& folder, const std::vector<EscapedSphere>& escaped);

} // namespace talus
