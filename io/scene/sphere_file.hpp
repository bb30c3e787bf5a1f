// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/scene.hpp"

#include <filesystem>

namespace talus
{

/// Reads the spheres that a .vtp, .vtu or .csv file lists, in the order of their ids where it has any. io/README.md
/// lists the arrays and columns.
/// @throws InputError where the file is missing, broken, empty or of another kind, or has a number that is not finite
///   or a radius that is not above 0
scene::SphereList read_spheres(const std::filesystem::path& path);

} // namespace talus
