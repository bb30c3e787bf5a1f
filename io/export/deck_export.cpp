// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/export/deck_export.hpp"

#include "io/export/deck_basis.hpp"
#include "io/export/export_folder.hpp"
#include "io/export/lammps_deck.hpp"
#include "io/export/liggghts_deck.hpp"

#include <fmt/format.h>

namespace talus
{
namespace
{

std::string deck_file(DeckProgram program)
{
    return fmt::format("in.{}", program_name(program));
}

} // namespace

std::string program_name(DeckProgram program)
{
    return program == DeckProgram::lammps ? "lammps" : "liggghts";
}

std::string deck_command(DeckProgram program)
{
    return fmt::format("{} -in {}", program == DeckProgram::lammps ? "lmp" : "liggghts", deck_file(program));
}

ExportNotes export_deck(const scene::Scene& scene, const Simulation& simulation, const DeckOrigin& origin,
    const std::filesystem::path& folder, bool force)
{
    const DeckBasis basis = deck_basis(scene, simulation);
    Deck deck = origin.program == DeckProgram::lammps ? lammps_deck(basis) : liggghts_deck(basis);
    deck.text = deck_head(basis, origin, deck.notes) + deck.text;
    deck.files.emplace(deck_file(origin.program), deck.text);
    deck.files.emplace(spheres_file, data_file(basis));
    std::vector<std::string> names;
    for (const auto& [name, text] : deck.files) names.push_back(name);
    const ExportFolder out(
        folder, fmt::format("{} of the scene {}", program_name(origin.program), origin.scene), names, force);
    for (const auto& [name, text] : deck.files) out.write(name, text);
    return deck.notes;
}

} // namespace talus
