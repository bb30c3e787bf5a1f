// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/region.hpp"

#include <array>

namespace talus
{

/// A region cut into equally wide bins along one of its directions: a box into slices along x, y or z, a cylinder into
/// disks along its axis or into rings round it.
class RegionBins
{
public:
    enum class Direction { x, y, z, axial, radial };

    /// @pre x, y or z goes with a box, axial or radial with a cylinder; count ≥ 1
    RegionBins(const Region& region, Direction direction, std::size_t count);

    std::size_t count() const { return count_; }

    /// Where the middle of a bin is: x, y or z, or the distance from the base or the axis of the cylinder [m].
    double middle(std::size_t bin) const { return low_ + (static_cast<double>(bin) + 0.5) * width_; }

    /// [m³]
    double volume(std::size_t bin) const;

    /// Calls use(bin, share) for the bins that a ball lies in, with the share of its volume.
    template <class Use> void for_each_share(const Vec3& center, double radius, Use&& use) const
    {
        const double at = coordinate(center);
        const std::size_t end = bin_before(at + radius) + 1;
        for (std::size_t bin = bin_before(at - radius); bin < end; ++bin)
            if (const double share = share_of(bin, center, radius); share > 0.0) use(bin, share);
    }

    /// The names of the components of a vector: x, y and z in a box; axial, radial and azimuthal in a cylinder.
    const std::array<const char*, 3>& component_names() const;

    /// The components of a vector that belongs to a place. On the axis itself there is no radial direction, and both
    /// components across are zero.
    Vec3 components(const Vec3& place, const Vec3& vector) const;

private:
    Region region_;
    Direction direction_;
    std::size_t count_;
    double low_ = 0.0, width_ = 0.0; ///< of the coordinate [m]

    bool in_box() const { return region_.shape == Region::Shape::box; }
    Vec3 across(const Vec3& place) const; ///< from the axis of the cylinder to the place
    double coordinate(const Vec3& place) const;
    std::size_t bin_before(double coordinate) const; ///< the bin there, or the nearest one
    Region slice(std::size_t bin) const;             ///< along x, y, z or the axis
    Region core(std::size_t bin) const;              ///< all within the outer radius of a ring
    double share_of(std::size_t bin, const Vec3& center, double radius) const;
};

} // namespace talus
