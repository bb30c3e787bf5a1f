// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>

namespace talus
{

// Walls that move as told may ask for what rigid bodies cannot do: a press that closes on a sphere. Then no velocity
// obeys all contacts, the impulses grow with every sweep, and the residual, which is relative to them, comes to say
// that all is well. What tells it is a contact that has an impulse, overlaps, and closes even so, for many steps
// without a break.

/// A contact of `projected` counts as pressed in a step when it overlaps by this many smallest diameters, and has an
/// impulse that does not keep it from closing …
inline constexpr double pressed_overlap = 0.01;
inline constexpr double pressed_closing = 1e-8; ///< … by this many in the step

/// It is beyond solution when it has been pressed for so many steps on end. Then it yields (stabilisation.hpp), so that
/// impulses stay finite and none is left over when the press opens; until it overlaps less, or has not been pressed for
/// as many steps on end: while its impulse of before gives way, it may not close for some.
inline constexpr int pressed_steps = 100;

inline bool is_beyond_solution(std::uint8_t touched)
{
    return touched > pressed_steps;
}

inline bool came_beyond_solution(std::uint8_t touched)
{
    return touched == 1 + pressed_steps;
}

/// How `CarriedImpulses::touched` goes on in a step in which it is pressed: 1 + the number of steps, and when it yields
/// already, the number from which count_unpressed counts down.
inline std::uint8_t count_pressed(std::uint8_t touched)
{
    if (is_beyond_solution(touched)) return 1 + 2 * pressed_steps;
    return static_cast<std::uint8_t>(std::max<int>(touched, 1) + 1);
}

/// How it goes on in a step in which it overlaps as much, and is not pressed.
inline std::uint8_t count_unpressed(std::uint8_t touched)
{
    if (!is_beyond_solution(touched)) return 1;
    const int left = (came_beyond_solution(touched) ? count_pressed(touched) : touched) - 1;
    return static_cast<std::uint8_t>(left > 1 + pressed_steps ? left : 1);
}

} // namespace talus
