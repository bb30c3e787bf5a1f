// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/vector.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace talus
{

/// How two materials meet.
struct ContactLaw {
    double friction = 0.0;         ///< μ, Coulomb
    double restitution = 0.0;      ///< e, Newton, in [0, 1]
    double rolling_friction = 0.0; ///< μ_r: |rolling torque| ≤ μ_r R* λ_n/h, R* = r₁r₂/(r₁+r₂), at a wall r
    double stiffness = infinity;   ///< k of the normal contact [N/m]; infinity: rigid
};
static_assert(sizeof(ContactLaw) == 32 && offsetof(ContactLaw, friction) == 0 &&
              offsetof(ContactLaw, restitution) == 8 &&
              offsetof(ContactLaw, stiffness) == 24); // kernels read it as four numbers

struct Material {
    std::string name;
    double density = 0.0; ///< [kg/m³]
};

/// The materials of a scene and the law of every pair of them, by material index.
struct Materials {
    std::vector<Material> list;
    std::vector<ContactLaw> laws; ///< list.size()², symmetric

    const ContactLaw& between(int a, int b) const
    {
        return laws[static_cast<std::size_t>(a) * list.size() + static_cast<std::size_t>(b)];
    }
};

} // namespace talus
