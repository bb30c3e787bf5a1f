// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/vector.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace talus
{

/// Along which axes the world repeats itself, and how long it is there. Positions are kept inside the cell that begins
/// at `origin`; what touches across its border is found by taking the nearest image.
struct Periodicity {
    Vec3 origin = Vec3::Zero();             ///< lower corner of the cell [m]
    Vec3 length = Vec3::Constant(infinity); ///< of the cell [m]; infinite along an axis that is not periodic

    bool along(int axis) const { return length[axis] < infinity; }
    bool any() const { return length.minCoeff() < infinity; }

    /// The part of a vector along the periodic axes.
    Vec3 part_along(const Vec3& v) const
    {
        Vec3 part = Vec3::Zero();
        for (int d = 0; d < 3; ++d)
            if (along(d)) part[d] = v[d];
        return part;
    }

    /// The whole cells by which `from` must be shifted to be the image nearest to `to`.
    Vec3 shift_towards(const Vec3& from, const Vec3& to) const
    {
        Vec3 shift = Vec3::Zero();
        for (int d = 0; d < 3; ++d)
            if (along(d)) shift[d] = length[d] * std::round((to[d] - from[d]) / length[d]);
        return shift;
    }

    /// The shortest of a difference of positions and its images.
    Vec3 nearest_image(const Vec3& difference) const { return difference + shift_towards(difference, Vec3::Zero()); }

    /// How far two boxes are apart along each axis, by those of their images that are nearest there; 0 where they meet.
    Vec3 apart(const Box& a, const Box& b) const
    {
        Vec3 gap = (a.min - b.max).cwiseMax(b.min - a.max).cwiseMax(0.0);
        for (int d = 0; d < 3; ++d) {
            if (!along(d)) continue;
            const double ahead = b.min[d] - a.max[d];
            const double behind_b = ahead - length[d] * std::floor(ahead / length[d]); // from a on to an image of b
            const double behind_a = length[d] - behind_b - (a.max[d] - a.min[d]) - (b.max[d] - b.min[d]);
            gap[d] = std::max(0.0, std::min(behind_a, behind_b));
        }
        return gap;
    }

    /// The image of a position that lies inside the cell.
    Vec3 wrapped(const Vec3& x) const
    {
        Vec3 inside = x;
        for (int d = 0; d < 3; ++d)
            if (along(d)) {
                inside[d] -= length[d] * std::floor((x[d] - origin[d]) / length[d]);
                if (inside[d] >= origin[d] + length[d]) inside[d] = origin[d]; // rounding
            }
        return inside;
    }

    /// The shifts to this cell (the first: zero) and to all cells that adjoin it.
    std::vector<Vec3> neighbor_shifts() const
    {
        std::vector<Vec3> shifts = {Vec3::Zero()};
        for (int d = 0; d < 3; ++d) {
            if (!along(d)) continue;
            const auto known = shifts;
            for (const double sign : {-1.0, 1.0})
                for (const Vec3& shift : known) shifts.push_back(shift + sign * length[d] * Vec3::Unit(d));
        }
        return shifts;
    }
};

} // namespace talus
