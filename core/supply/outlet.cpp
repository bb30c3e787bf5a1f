// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/supply/outlet.hpp"

#include "core/supply/removal.hpp"

namespace talus
{

void empty_outlets(Outflow& outflow, State& state, ContactNetwork& contacts, const Model& model)
{
    for (std::size_t i = 0; i < state.count(); ++i) {
        if (!state.leaving[i]) continue;
        ++outflow.count;
        outflow.mass += state.mass(i);
    }
    remove_spheres(state, contacts, model, state.leaving);
}

} // namespace talus
