// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/region.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus
{
namespace
{

constexpr double pi = std::numbers::pi;

double depth_in_box(const Box& box, const Vec3& x)
{
    const Vec3 in = (x - box.min).cwiseMin(box.max - x);
    const double least = in.minCoeff();
    return least >= 0.0 ? least : -in.cwiseMin(0.0).norm();
}

/// Of a cone, with an axis along which x lies so far, and from which it is so far away.
double depth_in_cone(const Region& cone, double top_radius, double along, double out)
{
    // In the half-plane of x the cone is a trapezium, whose slanted side runs from (0, radius) to (height, top_radius).
    const double slope = top_radius - cone.radius, length = std::hypot(cone.height, slope);
    const double to_side = ((cone.radius - out) * cone.height + along * slope) / length;
    const double least = std::min({along, cone.height - along, to_side});
    if (least >= 0.0) return least;
    // Outside, the nearest point is on an end or on the side.
    const auto from_end = [&](double at, double radius) { return std::hypot(along - at, std::max(0.0, out - radius)); };
    const double t = std::clamp((along * cone.height + (out - cone.radius) * slope) / (length * length), 0.0, 1.0);
    const double from_side = std::hypot(along - t * cone.height, out - cone.radius - t * slope);
    return -std::min({from_side, from_end(0.0, cone.radius), from_end(cone.height, top_radius)});
}

Vec3 random_in_box(const Box& box, Random& random)
{
    Vec3 x;
    for (int d = 0; d < 3; ++d) x[d] = box.min[d] + uniform(random) * (box.max[d] - box.min[d]);
    return x;
}

} // namespace

bool Region::contains(const Vec3& x, double ball_radius) const
{
    if (shape == Shape::box) return box.grown(-ball_radius).contains(x);
    if (shape != Shape::cylinder) return depth(x) >= ball_radius;
    const double along = (x - base).dot(axis);
    const double out = (x - base - along * axis).norm();
    return along >= ball_radius && along <= height - ball_radius && out <= radius - ball_radius;
}

double Region::depth(const Vec3& x) const
{
    if (shape == Shape::box) return depth_in_box(box, x);
    if (shape == Shape::inside) return surface->depth(x);
    if (shape == Shape::sphere) return radius - (x - base).norm();
    const double along = (x - base).dot(axis);
    return depth_in_cone(*this, shape == Shape::cone ? top_radius : radius, along, (x - base - along * axis).norm());
}

double Region::volume() const
{
    if (shape == Shape::box) return box.extent().prod();
    if (shape == Shape::inside) return surface->volume();
    if (shape == Shape::sphere) return 4.0 / 3.0 * pi * radius * radius * radius;
    if (shape == Shape::cylinder) return pi * radius * radius * height;
    return pi / 3.0 * height * (radius * radius + radius * top_radius + top_radius * top_radius);
}

Box Region::bounds() const
{
    if (shape == Shape::box) return box;
    if (shape == Shape::inside) return surface->bounds();
    if (shape == Shape::sphere) return Box{base, base}.grown(radius);
    const Vec3 half = disk_half_extent(axis), top = base + height * axis;
    const Vec3 first = radius * half, second = (shape == Shape::cone ? top_radius : radius) * half;
    return Box{base - first, base + first}.extend(Box{top - second, top + second});
}

bool Region::fits(double ball_radius) const
{
    if (shape == Shape::box) return !box.grown(-ball_radius).empty();
    if (shape == Shape::sphere) return radius >= ball_radius;
    if (shape == Shape::cylinder) return radius >= ball_radius && height >= 2.0 * ball_radius;
    if (shape == Shape::cone)
        return contains(base + ball_radius * axis, ball_radius) ||
               contains(base + (height - ball_radius) * axis, ball_radius);
    constexpr int places = 32;
    const Box around = bounds();
    for (int i = 0; i < places * places * places; ++i) {
        const Vec3 at = (Vec3(i % places, i / places % places, i / places / places).array() + 0.5) / places;
        if (contains(around.min + at.cwiseProduct(around.extent()), ball_radius)) return true;
    }
    return false;
}

std::optional<Vec3> Region::random_point(Random& random, double ball_radius) const
{
    if (shape == Shape::box) return random_in_box(box.grown(-ball_radius), random);
    if (shape != Shape::cylinder) {
        const Vec3 x = random_in_box(bounds(), random);
        return contains(x, ball_radius) ? std::optional(x) : std::nullopt;
    }
    const double out = (radius - ball_radius) * std::sqrt(uniform(random));
    const double turn = 2.0 * pi * uniform(random);
    const double along = ball_radius + (height - 2.0 * ball_radius) * uniform(random);
    const Vec3 e1 = any_perpendicular(axis);
    const Vec3 e2 = axis.cross(e1);
    return base + along * axis + out * (std::cos(turn) * e1 + std::sin(turn) * e2);
}

} // namespace talus
