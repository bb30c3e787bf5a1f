// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/vector.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace talus
{

/// How two materials meet.
struct alignas(64) ContactLaw {
    double friction = 0.0;         ///< μ, Coulomb
    double restitution = 0.0;      ///< e, Newton, in [0, 1]
    double rolling_friction = 0.0; ///< μ_r: |rolling torque| ≤ μ_r R* λ_n/h, R* = r₁r₂/(r₁+r₂), at a wall r
    double stiffness = infinity;   ///< k of the normal contact [N/m]; infinity: rigid
    double twisting_friction = 0.0; ///< μ_t: |twisting torque| ≤ μ_t R* λ_n/h
    double modulus = infinity; ///< E*: 1/E* is the sum of (1 − ν²)/E of the two (Hertz 1882) [Pa]; infinity: rigid
};
static_assert(sizeof(ContactLaw) == 64 && offsetof(ContactLaw, friction) == 0 &&
              offsetof(ContactLaw, restitution) == 8 && offsetof(ContactLaw, stiffness) == 24 &&
              offsetof(ContactLaw, modulus) == 40); // kernels read these

/// What draws two materials together, from when they touch until their gap exceeds the range: a force that is the sum
/// of these at touch (METHOD, attraction).
struct Attraction {
    double force = 0.0;     ///< [N] …
    double by_radius = 0.0; ///< … by R* [N/m] …
    double by_weight = 0.0; ///< … and by the weight of the lighter sphere
    double range = 0.0;     ///< [m]; 0: nothing attracts
    double volume = 0.0;    ///< of a liquid bridge, whose force falls with the gap [m³]; 0: it stays the same
};

struct Material {
    std::string name;
    double density = 0.0; ///< [kg/m³]
};

/// The materials of a scene and the law of every pair of them, by material index.
struct Materials {
    std::vector<Material> list;
    std::vector<ContactLaw> laws;             ///< list.size()², symmetric
    std::vector<Attraction> attractions = {}; ///< the same; empty where nothing attracts

    const ContactLaw& between(int a, int b) const { return laws[index(a, b)]; }
    const Attraction& attraction(int a, int b) const { return attractions[index(a, b)]; }

private:
    std::size_t index(int a, int b) const
    {
        return static_cast<std::size_t>(a) * list.size() + static_cast<std::size_t>(b);
    }
};

} // namespace talus
