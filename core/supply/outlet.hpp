// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/candidates/contact_network.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

namespace talus
{

/// What has left through the outlets.
struct Outflow {
    std::int64_t count = 0;
    double mass = 0.0; ///< [kg]

    void persist(Archive& archive) { archive(count, mass); }
};

/// Takes the spheres that are leaving out of the state and adds them to the outflow.
void empty_outlets(Outflow& outflow, State& state, ContactNetwork& contacts, const Model& model);

} // namespace talus
