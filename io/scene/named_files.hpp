// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/scene/scene_file.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace talus
{

/// Reads every file that a scene names into it, meshes, spheres and sieve analyses, and makes their paths absolute.
/// @throws InputError that begins with the place of the key
void read_named_files(SceneFile& file);

/// The files that a scene was read from beside its own, those of the keys `mesh` and `file`, with their checksums.
/// @throws InputError where one cannot be read any more
std::vector<std::pair<std::string, std::uint32_t>> named_files(const scene::Scene& scene);

} // namespace talus
