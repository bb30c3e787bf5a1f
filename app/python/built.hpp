// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/python/session.hpp"

#include <pybind11/pybind11.h>

/// What the decks for other programs (postprocess/decks) are made from and written with.
namespace talus::python
{

/// What the building of a scene adds to its text:
/// - `moduli`: E* of each pair of materials, infinite where they are rigid [Pa]
/// - `diameters` least, mean, largest; boxes `contents` and `world`, as rows min and max [m]
/// - `walls`: `corners` [m] and `triangles` as the scene has them, of grains their centres and none, and the pose
///   (rotation, shift) of each when it appears
/// - `pours`: of each species its share by number, the mean volume [m³], and `draws` diameters, rising [m]
pybind11::dict built_scene(Session& session, std::size_t draws);

/// Adds _ExportFolder and _stl_text.
void bind_export(pybind11::module_& module);

} // namespace talus::python
