// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sensors/region_share.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus
{
namespace
{

constexpr double pi = std::numbers::pi;
constexpr int slices = 16; ///< intervals of Simpson's rule

/// ∫₀ˣ √(ρ² − t²) dt for |x| ≤ ρ.
double under_circle(double x, double rho)
{
    return 0.5 * (x * std::sqrt(std::max(0.0, rho * rho - x * x)) + rho * rho * std::asin(x / rho));
}

/// Area of the part of the disk of radius ρ round the origin where X < x and Y < y.
double disk_quadrant(double x, double y, double rho)
{
    if (x <= -rho || y <= -rho) return 0.0;
    x = std::min(x, rho);
    y = std::min(y, rho);
    // The line Y = y cuts the disk between X = −c and X = c; left and right of that a column is whole or not there.
    const double c = std::sqrt(rho * rho - y * y);
    const double middle = std::clamp(x, -c, c);
    double area = y * (middle + c) + under_circle(middle, rho) + under_circle(c, rho);
    if (y > 0.0) {
        area += 2.0 * (under_circle(std::min(x, -c), rho) + 0.25 * pi * rho * rho);
        area += 2.0 * (under_circle(std::max(x, c), rho) - under_circle(c, rho));
    }
    return area;
}

/// Area of a disk of radius ρ round the origin inside the rectangle between two corners.
double disk_in_rectangle(double rho, double x0, double x1, double y0, double y1)
{
    return disk_quadrant(x1, y1, rho) - disk_quadrant(x0, y1, rho) - disk_quadrant(x1, y0, rho) +
           disk_quadrant(x0, y0, rho);
}

/// Area that two disks share whose centres are d apart.
double disk_in_disk(double a, double b, double d)
{
    if (d >= a + b) return 0.0;
    if (d <= std::abs(a - b)) return pi * std::min(a, b) * std::min(a, b);
    const double along_a = (d * d + a * a - b * b) / (2.0 * d); // of the common chord, from the first centre
    const double along_b = d - along_a;
    const double half_chord = std::sqrt(std::max(0.0, a * a - along_a * along_a));
    return a * a * std::acos(std::clamp(along_a / a, -1.0, 1.0)) +
           b * b * std::acos(std::clamp(along_b / b, -1.0, 1.0)) - d * half_chord;
}

/// The share of a ball of radius r round 0 that lies below z.
double share_below(double z, double r)
{
    const double t = std::clamp(z / r, -1.0, 1.0);
    return 0.25 * (1.0 + t) * (1.0 + t) * (2.0 - t);
}

/// ∫ area(ρ(z)) dz over [from, to] within the ball, as a share of its volume; ρ is the radius of its slice at z.
template <class Area> double sum_slices(double radius, double from, double to, Area&& area)
{
    from = std::max(from, -radius);
    to = std::min(to, radius);
    if (from >= to) return 0.0;
    const double width = (to - from) / slices;
    double sum = 0.0;
    for (int k = 0; k <= slices; ++k) {
        const double z = from + k * width;
        const double rho = std::sqrt(std::max(0.0, radius * radius - z * z));
        const double weight = k == 0 || k == slices ? 1.0 : (k % 2 == 1 ? 4.0 : 2.0);
        if (rho > 0.0) sum += weight * area(rho);
    }
    return sum * width / 3.0 / (4.0 / 3.0 * pi * radius * radius * radius);
}

double ball_share_of_box(const Box& box, const Vec3& center, double radius)
{
    const Vec3 low = box.min - center, high = box.max - center;
    int cut_directions = 0;
    double share = 1.0;
    for (int d = 0; d < 3; ++d) {
        if (low[d] <= -radius && high[d] >= radius) continue;
        ++cut_directions;
        share = share_below(high[d], radius) - share_below(low[d], radius);
        if (share <= 0.0) return 0.0;
    }
    if (cut_directions <= 1) return share;
    return sum_slices(radius, low.z(), high.z(),
        [&](double rho) { return disk_in_rectangle(rho, low.x(), high.x(), low.y(), high.y()); });
}

double ball_share_of_cylinder(const Region& region, const Vec3& center, double radius)
{
    const double along = (center - region.base).dot(region.axis);
    const double out = (center - region.base - along * region.axis).norm();
    if (out >= region.radius + radius) return 0.0;
    if (out <= region.radius - radius) return share_below(region.height - along, radius) - share_below(-along, radius);
    return sum_slices(
        radius, -along, region.height - along, [&](double rho) { return disk_in_disk(rho, region.radius, out); });
}

/// A part [from, to] of a line, which is cut smaller and smaller.
struct Interval {
    double from = 0.0, to = 1.0;

    /// Keeps what has low ≤ start + t rate ≤ high.
    void cut(double start, double rate, double low, double high)
    {
        if (rate == 0.0) {
            if (start < low || start > high) to = from;
            return;
        }
        const auto [first, last] = std::minmax({(low - start) / rate, (high - start) / rate});
        from = std::max(from, first);
        to = std::min(to, last);
    }

    double length() const { return std::max(0.0, to - from); }
};

/// Keeps what is within `radius` of an axis, for a line that is at right angles `out` from it and goes `step`.
void cut_by_mantle(Interval& part, const Vec3& out, const Vec3& step, double radius)
{
    const double a = step.squaredNorm(), b = out.dot(step), c = out.squaredNorm() - radius * radius;
    if (a == 0.0) {
        if (c > 0.0) part.to = part.from;
        return;
    }
    const double root = std::sqrt(std::max(0.0, b * b - a * c));
    part.from = std::max(part.from, (-b - root) / a);
    part.to = std::min(part.to, (-b + root) / a);
}

} // namespace

double ball_share(const Region& region, const Vec3& center, double radius)
{
    if (region.shape == Region::Shape::box) return ball_share_of_box(region.box, center, radius);
    return ball_share_of_cylinder(region, center, radius);
}

double segment_share(const Region& region, const Vec3& p, const Vec3& q)
{
    Interval part;
    const Vec3 step = q - p;
    if (region.shape == Region::Shape::box) {
        for (int d = 0; d < 3; ++d) part.cut(p[d], step[d], region.box.min[d], region.box.max[d]);
        return part.length();
    }
    const double along = (p - region.base).dot(region.axis), rate = step.dot(region.axis);
    part.cut(along, rate, 0.0, region.height);
    cut_by_mantle(part, p - region.base - along * region.axis, step - rate * region.axis, region.radius);
    return part.length();
}

} // namespace talus
