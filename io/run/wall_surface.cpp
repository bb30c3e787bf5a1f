// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/wall_surface.hpp"

#include <cmath>
#include <numbers>

namespace talus
{

namespace
{

struct Circle {
    Vec3 center;
    double radius;
};

/// The band between two circles round the same axis.
TriangleSoup band(const Circle& first, const Circle& second, const Vec3& axis)
{
    constexpr std::int32_t segments = 64;
    const Vec3 x = any_perpendicular(axis);
    const Vec3 y = axis.cross(x);
    TriangleSoup soup;
    for (std::int32_t k = 0; k < segments; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / segments;
        const Vec3 direction = std::cos(angle) * x + std::sin(angle) * y;
        soup.vertices.push_back(first.center + first.radius * direction);
        soup.vertices.push_back(second.center + second.radius * direction);
        const std::int32_t here = 2 * k, next = 2 * ((k + 1) % segments);
        if (first.radius > 0.0) soup.triangles.push_back({here, next, next + 1});
        if (second.radius > 0.0) soup.triangles.push_back({here, next + 1, here + 1});
    }
    return soup;
}

void append_rectangle(TriangleSoup& soup, const Panels::Rectangle& panel)
{
    const auto first = static_cast<std::int32_t>(soup.vertices.size());
    const Vec3 opposite = panel.corner + panel.edge_a + panel.edge_b;
    for (const Vec3& corner :
        {panel.corner, Vec3(panel.corner + panel.edge_a), opposite, Vec3(panel.corner + panel.edge_b)})
        soup.vertices.push_back(corner);
    soup.triangles.push_back({first, first + 1, first + 2});
    soup.triangles.push_back({first, first + 2, first + 3});
}

/// A globe of eight meridians and five circles of latitude.
void append_globe(TriangleSoup& soup, const Vec3& center, double radius)
{
    constexpr std::int32_t meridians = 8, circles = 5;
    const auto first = static_cast<std::int32_t>(soup.vertices.size());
    const auto vertex = [&](std::int32_t circle, std::int32_t meridian) {
        return first + circle * meridians + meridian % meridians;
    };
    for (std::int32_t c = 0; c < circles; ++c)
        for (std::int32_t m = 0; m < meridians; ++m) {
            const double latitude = std::numbers::pi * c / (circles - 1),
                         longitude = 2.0 * std::numbers::pi * m / meridians;
            soup.vertices.push_back(
                center + radius * Vec3(std::sin(latitude) * std::cos(longitude),
                                      std::sin(latitude) * std::sin(longitude), std::cos(latitude)));
        }
    for (std::int32_t c = 0; c + 1 < circles; ++c)
        for (std::int32_t m = 0; m < meridians; ++m) {
            if (c > 0) soup.triangles.push_back({vertex(c, m), vertex(c + 1, m), vertex(c, m + 1)});
            if (c + 2 < circles) soup.triangles.push_back({vertex(c, m + 1), vertex(c + 1, m), vertex(c + 1, m + 1)});
        }
}

struct Triangulate {
    const Box& contents;

    TriangleSoup operator()(const Plane& plane) const
    {
        Vec3 center = contents.center();
        const double width = 2.0 * contents.extent().maxCoeff();
        center -= (center - plane.point).dot(plane.normal) * plane.normal;
        const Vec3 a = width * any_perpendicular(plane.normal);
        const Vec3 b = plane.normal.cross(a);
        TriangleSoup soup;
        append_rectangle(soup, {center - 0.5 * a - 0.5 * b, a, b});
        return soup;
    }

    TriangleSoup operator()(const Cylinder& tube) const
    {
        return band({tube.base, tube.radius}, {tube.base + tube.height * tube.axis, tube.radius}, tube.axis);
    }

    TriangleSoup operator()(const Cone& funnel) const
    {
        return band({funnel.base, funnel.base_radius}, {funnel.base + funnel.height * funnel.axis, funnel.top_radius},
            funnel.axis);
    }

    TriangleSoup operator()(const Disk& plate) const
    {
        return band({plate.center, plate.radius}, {plate.center, plate.hole_radius}, plate.normal);
    }

    TriangleSoup operator()(const Panels& panels) const
    {
        TriangleSoup soup;
        for (const Panels::Rectangle& panel : panels.rectangles) append_rectangle(soup, panel);
        return soup;
    }

    /// Each grain as a globe of a few facets.
    TriangleSoup operator()(const Grains& grains) const
    {
        TriangleSoup soup;
        for (const Vec3& center : grains.centers) append_globe(soup, center, grains.radius);
        return soup;
    }

    TriangleSoup operator()(const Mesh& mesh) const { return {mesh.vertices, mesh.triangles}; }
};

} // namespace

TriangleSoup wall_surface(const Shape& shape, const Box& contents)
{
    return std::visit(Triangulate{contents}, shape);
}

} // namespace talus
