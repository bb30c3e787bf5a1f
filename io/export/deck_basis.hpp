// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/export/deck_export.hpp"

#include <map>
#include <optional>

/// What the decks for both programs share.
namespace talus
{

/// A deck as it is put together: its commands, the other files that it needs by name, and what it cannot say.
struct Deck {
    std::string text;
    std::map<std::string, std::string> files;
    ExportNotes notes;
};

/// Numbers of atom types: first the materials, then the walls of grains, which are spheres that do not move.
struct AtomTypes {
    std::vector<int> material;            ///< of each type, type 1 first
    std::vector<std::size_t> grain_walls; ///< of the types after those of the materials, in their order
    std::vector<int> moving;              ///< types that spheres have
};

/// Some spheres of one size.
struct SizeClass {
    double diameter = 0.0; ///< [m]
    int material = 0;
    double share = 0.0; ///< by number, of all spheres of the mixture
};

/// Where and how a deck begins.
struct DeckBasis {
    const scene::Scene& scene;
    const Simulation& simulation;
    AtomTypes types;
    Box box;              ///< a sphere that leaves it is gone [m]
    double modulus = 0.0; ///< Young's, of all materials [Pa]
};

/// @throws InputError where the scene has what decks cannot say
DeckBasis deck_basis(const scene::Scene& scene, const Simulation& simulation);

inline constexpr const char* spheres_file = "spheres.data";

/// Between looks at outlets [s].
inline constexpr double outlet_interval = 0.02;

/// Poisson's ratio of all materials.
inline constexpr double poisson = 0.25;

/// The name of something in a deck: "wall0_gate".
std::string deck_id(const char* kind, std::size_t index, const std::string& name);

/// The spheres and grains at the start as a data file of atom style sphere.
std::string data_file(const DeckBasis& basis);

/// The sizes of a mixture in classes of equal number, each with the mean volume of its spheres.
std::vector<SizeClass> size_classes(const Mixture& mixture);

/// A box as both programs call it, "block 0 1 0 1 0 1".
std::string box_words(const Box& box);

/// A region as both programs call it; nothing where they have none such.
std::optional<std::string> region_words(const Region& region);

/// A shape that lies along a coordinate axis: "z 0.1 0.2" with the two other coordinates of `base`, and the axis.
struct AxisWords {
    int axis;
    std::string words;
};
std::optional<AxisWords> along_axis(const Vec3& base, const Vec3& direction);

/// Whether a wall stands until it is removed within the run, or appears in it.
bool comes_or_goes(const Wall& wall, double duration);

/// The beginning of a deck: what it is and what it cannot say.
std::string deck_head(const DeckBasis& basis, const DeckOrigin& origin, const ExportNotes& notes);

/// The room with its spheres, the variables `modulus`, `step` and `t`, and a group for each type that moves.
std::string deck_room(const DeckBasis& basis);

/// The name of that group.
std::string type_group(const DeckBasis& basis, int type);

/// Gravity and integration.
std::string deck_motion(const DeckBasis& basis);

/// Regions of the outlets, sensors of mass flow, and frames. Adds what it leaves out to the notes.
std::string deck_outputs(const DeckBasis& basis, ExportNotes& notes);

/// Commands that are due at a time of the run [s].
using Timeline = std::map<double, std::string>;

/// The timeline as text, up to the end of the run, with the runs in between.
/// @param every what is added to each run
std::string deck_runs(const DeckBasis& basis, const Timeline& timeline, const std::string& every = "");

/// The names of the regions of the outlets.
std::vector<std::string> outlet_regions(const DeckBasis& basis);

/// What neither program can say of the scene.
ExportNotes common_notes(const DeckBasis& basis);

} // namespace talus
