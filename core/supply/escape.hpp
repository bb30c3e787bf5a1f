// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/candidates/contact_network.hpp"
#include "core/step/diagnostics.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

#include <vector>

namespace talus
{

/// A sphere that left the world where there is no outlet, as it was then.
struct EscapedSphere {
    double time = 0.0; ///< [s]
    std::int64_t id = -1;
    Vec3 position = Vec3::Zero();
    Vec3 velocity = Vec3::Zero();
    Vec3 angular_velocity = Vec3::Zero();
    double radius = 0.0;
    std::int32_t material = 0;
    std::int32_t last_wall = -1; ///< index of the wall touched last, −1 for none

    void persist(Archive& archive)
    {
        archive(time, id, position, velocity, angular_velocity, radius, material, last_wall);
    }
};

/// Takes the spheres that escaped in the last step out of the state and adds them to the list.
/// @param incidents of that step
void remove_escaped(std::vector<EscapedSphere>& escaped, State& state, ContactNetwork& contacts, const Model& model,
    const std::vector<Incident>& incidents);

} // namespace talus
