// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/scene/sphere_columns.hpp"

#include <filesystem>

namespace talus
{

/// The atoms of a file of LAMMPS or LIGGGHTS: of a dump in text ("ITEM: ATOMS id type x …") the last frame, of a data
/// file ("Atoms # sphere") all with their velocities.
/// @throws InputError where the file is missing, broken, or has neither
SphereColumns read_lammps(const std::filesystem::path& path);

} // namespace talus
