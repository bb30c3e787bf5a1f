// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/simulation.hpp"

#include <filesystem>
#include <string>

namespace talus
{

/// All that changes of a simulation, but what its sensors have seen.
std::string state_of(Simulation& simulation);

/// Puts back what state_of gave, into the same simulation.
/// @throws ArchiveError where the bytes are of another scene
void put_back(Simulation& simulation, std::string state);

/// Keeps the state of a simulation in a folder of its own.
/// @throws OutputError
void save_state(Simulation& simulation, const std::filesystem::path& folder);

/// Puts a saved state into a simulation of the same scene under another setting: it begins at the nearest multiple of
/// its own time step, and goes on with the forces of the contacts. Its sensors have seen nothing.
/// @throws InputError where the folder holds no state that fits
void load_state(Simulation& simulation, const std::filesystem::path& folder);

} // namespace talus
