// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/scene.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace talus
{

/// The files that a scene was read from beside its own, those of the keys `mesh` and `file`, with their checksums.
/// @throws InputError where one cannot be read any more
std::vector<std::pair<std::string, std::uint32_t>> input_files(const scene::Scene& scene);

} // namespace talus
