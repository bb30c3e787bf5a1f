// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/simulation.hpp"

#include <filesystem>

namespace talus
{

/// Keeps the state of a simulation, without what its sensors have seen, in a folder of its own.
/// @throws OutputError
void keep_state(Simulation& simulation, const std::filesystem::path& folder);

/// Puts a kept state into a simulation of the same scene under another setting: it begins at the nearest multiple of
/// its own time step, and goes on with the forces of the contacts. Its sensors have seen nothing.
/// @throws InputError where the folder holds no state that fits
void put_state(Simulation& simulation, const std::filesystem::path& folder);

} // namespace talus
