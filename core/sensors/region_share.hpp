// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/region.hpp"

namespace talus
{

/// Which share of a ball's volume lies inside a region, 0 to 1. Exact where plane faces across one direction cut the
/// ball; elsewhere the exact areas of 17 slices, summed by Simpson's rule: wrong by less than 1e-3 of the ball, whose
/// sign changes with its place, so that the errors of many balls cancel.
double ball_share(const Region& region, const Vec3& center, double radius);

/// Which share of the straight line from p to q lies inside a region, 0 to 1.
double segment_share(const Region& region, const Vec3& p, const Vec3& q);

} // namespace talus
