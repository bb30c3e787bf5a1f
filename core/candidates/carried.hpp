// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/archive.hpp"
#include "core/base/vector.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace talus
{

/// What is known of a contact from the steps before: whether it was loaded or an impact, and whether it has jammed.
///
/// Walls that move as told may ask for what rigid bodies cannot do: a press that closes on a sphere. Then no velocity
/// obeys all contacts; those that overlap deeply yield (law.hpp), and one that comes deeper and deeper has
/// *jammed*, until it overlaps less. Nothing hangs on that but what is reported.
class TouchRecord
{
public:
    /// In the step before it had an impulse, other than that of an impact.
    bool is_loaded() const { return last() == 1 || was_open(); }
    /// In the step before it closed a gap.
    bool was_open() const { return last() == 3; }
    /// In the step before it was an impact.
    bool was_impact() const { return last() == 2; }
    bool is_jammed() const { return pressed() >= newly_jammed; }
    /// In the step before, it came to be so.
    bool is_newly_jammed() const { return pressed() == newly_jammed; }

    void note_load(bool loaded) { set(loaded, pressed()); }
    void note_impact() { set(2, pressed()); }
    void note_closing() { set(3, pressed()); }
    /// A step in which it is shallow.
    void note_hold() { set(last(), 0); }
    /// A step in which it is pressed. @param deepens it bears a load, and comes deeper; @param is_deep too deep to wait
    void note_yield(bool deepens, bool is_deep)
    {
        const int steps = std::max(0, pressed() + (deepens ? 1 : -1));
        if (is_jammed())
            note_known();
        else
            set(last(), deepens && is_deep && steps > 1 ? newly_jammed : steps);
    }
    /// Its press is known: it is not reported again.
    void note_known() { set(last(), newly_jammed + 1); }

private:
    static constexpr int newly_jammed = 60; ///< a blade grips grains for half as many steps, and lets them go

    std::uint8_t state_ = 0;

    /// What it was in the step before: 0 not loaded, 1 loaded, 2 an impact, 3 closing a gap.
    int last() const { return state_ & 3; }
    /// How many times more than not it has come deeper; from newly_jammed on it has jammed.
    int pressed() const { return state_ >> 2; }
    void set(int last, int pressed) { state_ = static_cast<std::uint8_t>(4 * pressed + last); }
};

/// What a contact hands on from one step to the next; zeros where nothing is.
struct alignas(32) CarriedContact {
    Vec3 impulse = Vec3::Zero(); ///< λ [N s]
    float compression = 0.0F;    ///< of its spring, what `handed_on` says: its energy, as a length [m]
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
    /// Σ W|λ|² of what was carried into the step in which something struck what is much lighter, where the impulses are
    /// of such a step; else infinite.
    double load_before_impact = infinity;

    void persist(Archive& archive) { archive(walls, wall_normal, impulse_step, load_before_impact); }
};

} // namespace talus
