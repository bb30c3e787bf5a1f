// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/export/frame_export.hpp"
#include "scenarios/scene.hpp"
#include "core/simulation/simulation.hpp"

/// A scene as the input of LAMMPS (tried: 29 Sep 2021) or LIGGGHTS (3.8): spheres as they lie, materials, walls,
/// pours, outlets, sensors of mass flow, frames. Their contacts are springs: Hertz and Mindlin, with damping from the
/// restitution, and a Young's modulus that is the deck's own.
namespace talus
{

enum class DeckProgram { lammps, liggghts };

std::string program_name(DeckProgram program);

/// The command that runs a deck in its folder.
std::string deck_command(DeckProgram program);

/// Where a deck comes from, for its first line.
struct DeckOrigin {
    DeckProgram program;
    std::string scene;   ///< its name
    std::string version; ///< of Talus
};

/// Writes the deck and its files into a folder of their own.
/// @param simulation of the scene, before its first step
/// @return what the deck cannot say, a sentence each; they stand in the deck too
/// @throws InputError where the folder is not free, OutputError
ExportNotes export_deck(const scene::Scene& scene, const Simulation& simulation, const DeckOrigin& origin,
    const std::filesystem::path& folder, bool force);

} // namespace talus
