// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact_network.hpp"
#include "core/step/incidents.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

#include <vector>

namespace talus
{

/// Takes the spheres out for which `gone` is not 0; the others keep their order. The contacts of the last step are
/// forgotten, for they name spheres by storage index.
void remove_spheres(State& state, ContactNetwork& network, const std::vector<std::uint8_t>& gone);

/// What has left through the outlets.
struct Outflow {
    std::int64_t count = 0;
    double mass = 0.0; ///< [kg]

    void persist(Archive& archive) { archive(count, mass); }
};

/// Takes the spheres that are leaving out of the state and adds them to the outflow.
void empty_outlets(Outflow& outflow, State& state, ContactNetwork& network);

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
void remove_escaped(
    std::vector<EscapedSphere>& escaped, State& state, ContactNetwork& network, const std::vector<Incident>& incidents);

} // namespace talus
