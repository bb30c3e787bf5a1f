// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/candidates/contact_network.hpp"

#include <cstdint>
#include <vector>

namespace talus
{

/// What its contacts did to a sphere in a step, those with walls included.
struct SphereLoad {
    Vec3 impulse = Vec3::Zero(); ///< sum of the contact impulses [N s]
    std::int32_t contacts = 0;   ///< those with an impulse: the sphere's coordination number
};

/// The load on each of `spheres` spheres by storage index, from the solved contacts.
std::vector<SphereLoad> sphere_loads(const ContactNetwork& network, std::size_t spheres);

} // namespace talus
