// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/candidates/carried.hpp"

namespace talus
{

CarriedImpulses::CarriedImpulses(std::size_t slots, bool with_rolling)
    : contact(slots), rolling_impulse(with_rolling ? slots : 0, Vec3::Zero())
{
}

void CarriedImpulses::scale(double factor)
{
    for (CarriedContact& own : contact) own.impulse *= factor;
    for (Vec3& p : rolling_impulse) p *= factor;
}

void CarriedImpulses::shrink(std::size_t slots)
{
    contact.resize(slots);
    if (!rolling_impulse.empty()) rolling_impulse.resize(slots);
}

void CarriedImpulses::copy(std::size_t slot, const CarriedImpulses& from, std::size_t from_slot, bool opposite)
{
    const double sign = opposite ? -1.0 : 1.0;
    contact[slot] = from.contact[from_slot];
    contact[slot].impulse *= sign;
    if (!rolling_impulse.empty()) rolling_impulse[slot] = sign * from.rolling_impulse[from_slot];
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
