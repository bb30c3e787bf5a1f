// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/archive.hpp"
#include "core/base/vector.hpp"

#include <cstdint>
#include <vector>

namespace talus
{

/// What is known of a contact from the steps before: whether it was loaded, and for how long it has been jammed.
///
/// Walls that move as told may ask for what rigid bodies cannot do: a press that closes on a sphere. Then no velocity
/// obeys all contacts, the impulses grow with every sweep, and the residual, which is relative to them, comes to say
/// that all is well. What tells it is a contact that has an impulse, overlaps, and closes even so (it is *pressed*, see
/// carry.cpp), for many steps without a break: it is *jammed*. A jammed contact yields (law.hpp), so that impulses stay
/// finite and none is left over when the press opens; until it overlaps less, or has not been pressed for as many steps
/// in a row: while its old impulse gives way, it may not close for some.
///
/// A compliant contact takes all that a press asks for, and gives it back: as speed, when a sphere slips out. So where
/// it closes under load deeper than any bed at rest lets it, it is *crushed*: jammed at once, until it is shallow.
class TouchRecord
{
public:
    static constexpr int jam_steps = 100; ///< pressed for so many steps in a row, a contact is jammed

    /// In the step before it had an impulse, other than that of an impact.
    bool is_loaded() const { return state_ > 0; }
    bool is_jammed() const { return state_ > jam_steps; }
    /// In the step before, it came to be so.
    bool is_newly_jammed() const { return state_ == 1 + jam_steps; }

    /// A step in which it is not deep enough to be pressed.
    void note_load(bool loaded) { state_ = loaded; }
    /// A step in which it is pressed.
    void note_pressed()
    {
        if (is_jammed())
            state_ = freshly_pressed;
        else
            state_ = static_cast<std::uint8_t>((state_ > 1 ? state_ : 1) + 1);
    }
    /// A step in which it is crushed, or has been and is not shallow yet.
    void note_crushed() { state_ = is_jammed() ? freshly_pressed : 1 + jam_steps; }
    /// A step in which it is as deep, and not pressed.
    void note_unpressed()
    {
        if (is_newly_jammed()) state_ = freshly_pressed;
        state_ = state_ > 2 + jam_steps ? static_cast<std::uint8_t>(state_ - 1) : 1;
    }

private:
    static constexpr int freshly_pressed = 1 + 2 * jam_steps;

    /// 0: not loaded; 1: loaded; to 1 + jam_steps: pressed for one step less; from freshly_pressed down to 2 +
    /// jam_steps: jammed, and not pressed for as many steps as are missing.
    std::uint8_t state_ = 0;
};

/// From this overlap on, in smallest diameters, a contact can be pressed.
inline constexpr double pressed_overlap = 0.01;

/// From this overlap on, in smallest diameters, a compliant contact can be crushed.
inline constexpr double crushed_overlap = 0.125;

/// What a contact hands on from one step to the next; zeros where nothing is.
struct alignas(32) CarriedContact {
    Vec3 impulse = Vec3::Zero(); ///< λ [N s]
    float compression = 0.0F;    ///< κ: what of its overlap a load has pressed [m]; not read where it was not loaded
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
    double step_before = 0.0;       ///< length of the step that brought the spheres where they are [s]

    void persist(Archive& archive) { archive(walls, wall_normal, impulse_step, step_before); }
};

} // namespace talus
