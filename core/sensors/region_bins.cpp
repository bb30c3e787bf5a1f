// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sensors/region_bins.hpp"

#include "core/sensors/region_share.hpp"

#include <algorithm>
#include <cassert>

namespace talus
{

RegionBins::RegionBins(const Region& region, Direction direction, std::size_t count)
    : region_(region), direction_(direction), count_(count)
{
    assert(in_box() == (direction < Direction::axial) && count > 0);
    double high = direction == Direction::radial ? region.radius : region.height;
    if (in_box()) {
        low_ = region.box.min[static_cast<int>(direction)];
        high = region.box.max[static_cast<int>(direction)];
    }
    width_ = (high - low_) / static_cast<double>(count);
}

Vec3 RegionBins::across(const Vec3& place) const
{
    const Vec3 out = place - region_.base;
    return out - out.dot(region_.axis) * region_.axis;
}

double RegionBins::coordinate(const Vec3& place) const
{
    if (direction_ == Direction::radial) return across(place).norm();
    if (direction_ == Direction::axial) return (place - region_.base).dot(region_.axis);
    return place[static_cast<int>(direction_)];
}

std::size_t RegionBins::bin_before(double coordinate) const
{
    return static_cast<std::size_t>(std::clamp((coordinate - low_) / width_, 0.0, static_cast<double>(count_ - 1)));
}

Region RegionBins::slice(std::size_t bin) const
{
    Region part = region_;
    const double from = low_ + static_cast<double>(bin) * width_;
    if (direction_ == Direction::axial) {
        part.base += from * region_.axis;
        part.height = width_;
    } else {
        part.box.min[static_cast<int>(direction_)] = from;
        part.box.max[static_cast<int>(direction_)] = from + width_;
    }
    return part;
}

Region RegionBins::core(std::size_t bin) const
{
    Region part = region_;
    part.radius = static_cast<double>(bin + 1) * width_;
    return part;
}

double RegionBins::volume(std::size_t bin) const
{
    if (direction_ != Direction::radial) return slice(bin).volume();
    return core(bin).volume() - (bin > 0 ? core(bin - 1).volume() : 0.0);
}

double RegionBins::share_of(std::size_t bin, const Vec3& center, double radius) const
{
    if (direction_ != Direction::radial) return ball_share(slice(bin), center, radius);
    return ball_share(core(bin), center, radius) - (bin > 0 ? ball_share(core(bin - 1), center, radius) : 0.0);
}

const std::array<const char*, 3>& RegionBins::component_names() const
{
    static constexpr std::array<const char*, 3> of_box = {"x", "y", "z"},
                                                of_cylinder = {"axial", "radial", "azimuthal"};
    return in_box() ? of_box : of_cylinder;
}

Vec3 RegionBins::components(const Vec3& place, const Vec3& vector) const
{
    if (in_box()) return vector;
    const Vec3 out = across(place).normalized(); // zero stays zero
    return {vector.dot(region_.axis), vector.dot(out), vector.dot(region_.axis.cross(out))};
}

} // namespace talus
