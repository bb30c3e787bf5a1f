// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/scene.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace talus
{

/// Reads the spheres that a file lists, in the order of their ids where it has any: a table in text, a VTK file, a dump
/// or data file of LAMMPS. io/README.md lists the arrays and columns.
/// @param materials of the scene, in its order; @throws InputError where the file is missing, broken, empty or of
/// another kind, or has a number that is not finite
///   or a radius that is not above 0
scene::SphereList read_spheres(const std::filesystem::path& path, const std::vector<std::string>& materials = {});

} // namespace talus
