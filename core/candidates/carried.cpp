// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/candidates/carried.hpp"

namespace talus
{

CarriedImpulses::CarriedImpulses(std::size_t slots, bool with_rolling)
    : impulse(slots, Vec3::Zero()), rolling_impulse(with_rolling ? slots : 0, Vec3::Zero()), touch(slots),
      free_overlap(slots, 0.0F)
{
}

void CarriedImpulses::clear(std::size_t slot)
{
    if (!touch[slot].is_loaded()) return; // nothing is carried without
    impulse[slot].setZero();
    if (!rolling_impulse.empty()) rolling_impulse[slot].setZero();
    touch[slot] = {};
}

void CarriedImpulses::scale(double factor)
{
    for (Vec3& p : impulse) p *= factor;
    for (Vec3& p : rolling_impulse) p *= factor;
}

void CarriedImpulses::copy(std::size_t slot, const CarriedImpulses& from, std::size_t from_slot, bool opposite)
{
    const double sign = opposite ? -1.0 : 1.0;
    impulse[slot] = sign * from.impulse[from_slot];
    if (!rolling_impulse.empty()) rolling_impulse[slot] = sign * from.rolling_impulse[from_slot];
    touch[slot] = from.touch[from_slot];
    free_overlap[slot] = from.free_overlap[from_slot];
}

double Carried::scale_to(double step)
{
    const double factor = impulse_step < infinity ? step / impulse_step : 1.0;
    impulse_step = step;
    if (factor == 1.0) return factor;
    pairs.scale(factor);
    walls.scale(factor);
    return factor;
}

} // namespace talus
