// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/law/contact_law.hpp"

#include <algorithm>
#include <cstdint>

namespace talus
{

/// What is known of a contact from the steps before: what it was in the last one, and whether it has jammed.
///
/// Walls that move as prescribed may ask for what rigid bodies cannot do: a press that closes on a sphere. Then no
/// velocity obeys all contacts; those that overlap deeply yield, and one that comes deeper and deeper has *jammed*,
/// until it overlaps less. Nothing hangs on that but what is reported.
class TouchRecord
{
public:
    /// What it was; kernels read and write it as the low bits of the record.
    enum Last : std::uint8_t { unloaded, loaded, impact, closing_a_gap };
    static constexpr std::uint8_t last_bits = 3;

    Last last() const { return static_cast<Last>(state_ & last_bits); }
    /// In the step before it had an impulse, other than that of an impact.
    bool is_loaded() const { return last() == loaded || last() == closing_a_gap; }
    bool is_jammed() const { return pressed() >= newly_jammed; }
    /// In the step before, it came to be so.
    bool is_newly_jammed() const { return pressed() == newly_jammed; }

    void note(Last now) { set(now, pressed()); }
    /// A step in which it is shallow.
    void note_hold() { set(last(), 0); }
    /// A step in which it is pressed. @param deepens it bears a load, and comes deeper; @param is_deep no doubt is left
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

    /// How many times more than not it has come deeper; from newly_jammed on it has jammed.
    int pressed() const { return state_ >> 2; }
    void set(Last last, int pressed) { state_ = static_cast<std::uint8_t>(4 * pressed + last); }
};

/// The record of a deep contact after a step.
/// @param overlap at its beginning, in smallest diameters; @param u_n after it [m/s]
inline TouchRecord noted(
    TouchRecord touch, ContactKind kind, bool is_loaded, double overlap, double u_n, const LawOfStep& law)
{
    if (is_loaded && kind == ContactKind::impact)
        touch.note(TouchRecord::impact);
    else
        touch.note(is_loaded || kind == ContactKind::yielding ? TouchRecord::loaded : TouchRecord::unloaded);
    const double pressed = law.rigid ? rigid_yield_overlap : pressed_overlap;
    const bool deepens = is_loaded && u_n < 0.0;
    const bool is_deep = overlap > jamming_overlap;
    if (overlap <= pressed && !(touch.is_jammed() && overlap > jammed_overlap))
        touch.note_hold();
    else
        touch.note_yield(deepens, is_deep);
    return touch;
}

} // namespace talus
