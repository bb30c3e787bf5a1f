// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact_network.hpp"
#include "core/contacts/contact_survey.hpp"
#include "core/packs/kernels.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

namespace talus
{

/// Makes the contacts between spheres: finds the candidates of a tile that are near, gives each a place in its packs,
/// and then makes eight at a time.
class SphereAssembly
{
public:
    SphereAssembly(ContactNetwork& network, const State& state, const Model& model, const StepConstants& step);

    ContactSurvey assemble(std::size_t tile);

private:
    ContactNetwork& network_;
    const State& state_;
    const Model& model_;
    const StepConstants& step_;
    const TouchKernel& kernel_ = fastest_kernels().touch;
    SphereNumbers spheres_; ///< without what their contacts carry

    void place(const Tile& tile, const SphereNumbers& spheres, TileContacts& contacts);
    ContactSurvey make(const Tile& tile, const SphereNumbers& spheres, TileContacts& contacts);
};

} // namespace talus
