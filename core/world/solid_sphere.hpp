// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace talus
{

/// What a body of one solid sphere has in place of an inertia: m r² / I, for I = 2/5 m r².
inline constexpr double inverse_inertia_factor = 5.0 / 2.0;

} // namespace talus
