// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/python/session.hpp"

#include <pybind11/numpy.h>

#include <string>

/// From a state to arrays of numpy and back.
namespace talus::python
{

/// Makes numpy know the records of contacts: once, before all.
void register_records();

/// @param name "positions", "velocities", "angular_velocities", "radii", "masses", "materials", "ids" or "own_forces"
/// @return a copy, in the order of ids
pybind11::array copy_of(Session& session, const std::string& name);

/// @param name "positions", "velocities", "radii", "materials" or "ids"
/// @return the memory itself, read only, in storage order; it lives as long as the array does, and a step leaves it
pybind11::array view_of(Session& session, const std::string& name);

/// The contacts of the last step that bear something, as an array of records.
pybind11::array contacts_of(Session& session);

/// Three numbers. @throws std::invalid_argument unless they are finite
Vec3 vector_from(const pybind11::array& numbers, const std::string& what);

pybind11::array_t<double> array_from(const Vec3& vector);

} // namespace talus::python
