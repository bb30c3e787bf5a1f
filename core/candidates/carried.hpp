// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/archive.hpp"
#include "core/base/vector.hpp"
#include "core/law/touch_record.hpp"

#include <cstdint>
#include <vector>

namespace talus
{

/// What a contact hands on from one step to the next; zeros where nothing is.
struct alignas(32) CarriedContact {
    Vec3 impulse = Vec3::Zero(); ///< λ [N s]
    float compression = 0.0F;    ///< of its spring, what `handed_on` says: its energy, as a length [m]
    TouchRecord touch;
    bool attached = false;       ///< its two have touched, and attract each other since
    std::uint8_t unused[2] = {}; ///< kernels read the last eight bytes as one number

    void persist(Archive& archive) { archive(impulse, compression, touch, attached); }
};
static_assert(sizeof(CarriedContact) == 32 && std::is_standard_layout_v<CarriedContact> &&
              offsetof(CarriedContact, impulse) == 0 && offsetof(CarriedContact, compression) == 24 &&
              offsetof(CarriedContact, touch) == 28 && sizeof(TouchRecord) == 1 &&
              offsetof(CarriedContact, attached) == 29);

/// What contacts hand on, by slot: a slot is a listed pair, or one of those of a listed wall.
struct CarriedImpulses {
    std::vector<CarriedContact> contact;
    std::vector<Vec3> rolling_impulse; ///< [N m s]; empty unless the scene has rolling resistance

    CarriedImpulses() = default;
    CarriedImpulses(std::size_t slots, bool with_rolling);
    void persist(Archive& archive) { archive(contact, rolling_impulse); }
    void scale(double factor); ///< all of them
    /// The first ones remain; new ones are empty.
    void resize(std::size_t slots, bool with_rolling);
    void append(const CarriedImpulses& more);
    void copy(std::size_t slot, const CarriedImpulses& from, std::size_t from_slot, bool opposite = false);
};

/// What contacts with walls hand on, and for how long all impulses have acted. (Those of spheres stand in their tiles.)
struct Carried {
    CarriedImpulses walls;          ///< by wall slot of the candidate list
    std::vector<Vec3> wall_normal;  ///< by wall slot: the normal by which the next step knows a wall contact again
    double impulse_step = infinity; ///< for how long the impulses have acted [s]; infinite before the first step

    void persist(Archive& archive) { archive(walls, wall_normal, impulse_step); }
};

} // namespace talus
