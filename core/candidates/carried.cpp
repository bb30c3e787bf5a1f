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

void CarriedImpulses::resize(std::size_t slots, bool with_rolling)
{
    contact.resize(slots);
    if (with_rolling) rolling_impulse.resize(slots, Vec3::Zero());
}

void CarriedImpulses::append(const CarriedImpulses& more)
{
    contact.insert(contact.end(), more.contact.begin(), more.contact.end());
    rolling_impulse.insert(rolling_impulse.end(), more.rolling_impulse.begin(), more.rolling_impulse.end());
}

void CarriedImpulses::copy(std::size_t slot, const CarriedImpulses& from, std::size_t from_slot, bool opposite)
{
    const double sign = opposite ? -1.0 : 1.0;
    contact[slot] = from.contact[from_slot];
    contact[slot].impulse *= sign;
    if (!rolling_impulse.empty()) rolling_impulse[slot] = sign * from.rolling_impulse[from_slot];
}

} // namespace talus
