// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/archive.hpp"
#include "core/base/vector.hpp"

#include <cstdint>
#include <vector>

namespace talus
{

/// What is known of a contact from the steps before: whether it was loaded or an impact, and whether it has jammed.
///
/// Walls that move as told may ask for what rigid bodies cannot do: a press that closes on a sphere. Then no velocity
/// obeys all contacts; those that overlap deeply yield (law.hpp), and one that yields and could not part has *jammed*,
/// until it overlaps less.
class TouchRecord
{
public:
    /// In the step before it had an impulse, other than that of an impact.
    bool is_loaded() const { return state_ == 1 || state_ >= 3; }
    /// In the step before it closed a gap.
    bool was_open() const { return state_ == 5; }
    /// In the step before it was an impact.
    bool was_impact() const { return state_ == 2; }
    bool is_jammed() const { return state_ == 3 || state_ == 4; }
    /// In the step before, it came to be so.
    bool is_newly_jammed() const { return state_ == 3; }

    /// A step in which it does not yield.
    void note_load(bool loaded) { state_ = loaded; }
    void note_impact() { state_ = 2; }
    void note_closing() { state_ = 5; }
    /// A step in which it yields. @param presses and does not part as fast as it might
    void note_yield(bool presses)
    {
        if (is_jammed() || presses)
            state_ = is_jammed() ? 4 : 3;
        else
            state_ = 1;
    }

private:
    std::uint8_t state_ = 0; ///< 0: not loaded; 1: loaded; 2: impact; 3: jammed in the step before; 4: longer; 5: it
                             ///< had a gap
};

/// What a contact hands on from one step to the next; zeros where nothing is.
struct alignas(32) CarriedContact {
    Vec3 impulse = Vec3::Zero(); ///< λ [N s]
    float compression = 0.0F;    ///< κ: what of its overlap a load has pressed [m]
    TouchRecord touch;
    std::uint8_t unused[3] = {}; ///< kernels read the last eight bytes as one number

    void persist(Archive& archive) { archive(impulse, compression, touch); }
};
static_assert(sizeof(CarriedContact) == 32);

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
