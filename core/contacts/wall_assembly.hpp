// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact_network.hpp"
#include "core/contacts/contact_survey.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

namespace talus
{

/// A touch of a sphere and a wall, as detection found it: fields as in TouchPack.
struct WallTouch {
    std::int32_t sphere, wall;
    Vec3 normal;
    double gap, u_n, u_n_before, closes;
    double inverse_mass_sum; ///< W
    std::uint32_t slot;
    double wall_level; ///< of Contact
    WallRow row = {};  ///< at walls that move
};

/// Makes the contacts of a tile with walls: gives each touch a place in its packs, and then makes eight at a time.
/// Those with pistons, of all tiles, follow each other as they come.
class WallAssembly
{
public:
    WallAssembly(TileContacts& contacts, bool with_pistons, const CarriedImpulses& carried, StepContacts& scratch,
        const State& state, const Model& model, const StepConstants& step);

    void add(const WallTouch& at);
    /// Makes what was added.
    ContactSurvey make();

private:
    TileContacts& contacts_;
    const bool with_pistons_;
    const CarriedImpulses& carried_;
    std::vector<BodyImpacts>& impacts_;
    AssemblyRoom& room_;
    const State& state_;
    const Model& model_;
    const StepConstants& step_;
};

} // namespace talus
