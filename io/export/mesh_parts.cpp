// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/export/mesh_parts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace talus
{
namespace
{

constexpr double same_place = 1e-4; ///< of the mesh's size
constexpr double most_sag = 0.05;   ///< of the radius
constexpr double all_round = 0.9;   ///< of the area of a surface once round: what chords leave of it, and no slit does

/// A ring of corners: where it lies along the axis, and its radius.
struct Ring {
    double place = 0.0, radius = 0.0;
};

double size_of(const Mesh& mesh)
{
    Box box;
    for (const Vec3& corner : mesh.vertices) box.extend(corner);
    return box.extent().norm();
}

double area_of(const Mesh& mesh, const std::array<std::int32_t, 3>& triangle)
{
    const auto corner = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(triangle[k])]; };
    return 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
}

/// Area of a surface round the axis between two rings; of a disk where they are one.
double round_area(const Ring& a, const Ring& b)
{
    if (&a == &b) return std::numbers::pi * a.radius * a.radius;
    return std::numbers::pi * (a.radius + b.radius) * std::hypot(a.place - b.place, a.radius - b.radius);
}

/// The surface round the axis between two rings, or the disk within one.
Shape round_shape(const Vec3& center, const Vec3& axis, const Ring& low, const Ring& high, double flat)
{
    const Vec3 base = center + (low.place - center.dot(axis)) * axis;
    if (high.place - low.place > flat) return Cone{base, axis, low.radius, high.radius, high.place - low.place};
    const bool is_ring = &low != &high;
    return Disk{base, axis, std::max(low.radius, high.radius), is_ring ? std::min(low.radius, high.radius) : 0.0};
}

RoundParts round_parts_about(const Mesh& mesh, int d)
{
    const double near = same_place * size_of(mesh);
    const Vec3 axis = Vec3::Unit(d);
    Vec3 center = Vec3::Zero();
    for (const Vec3& corner : mesh.vertices) center += corner / static_cast<double>(mesh.vertices.size());

    std::vector<Ring> rings;
    std::vector<std::size_t> ring_of;
    for (const Vec3& corner : mesh.vertices) {
        const Ring own{corner.dot(axis), (corner - center - (corner - center).dot(axis) * axis).norm()};
        const auto found = std::ranges::find_if(rings,
            [&](const Ring& ring) { return std::hypot(ring.place - own.place, ring.radius - own.radius) < near; });
        ring_of.push_back(static_cast<std::size_t>(found - rings.begin()));
        if (found == rings.end()) rings.push_back(own);
    }

    std::map<std::pair<std::size_t, std::size_t>, double> areas; // between rings
    RoundParts parts;
    for (const auto& triangle : mesh.triangles) {
        std::set<std::size_t> joined;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto a = static_cast<std::size_t>(triangle[k]), b = static_cast<std::size_t>(triangle[(k + 1) % 3]);
            joined.insert(ring_of[a]);
            if (ring_of[a] != ring_of[b]) continue;
            const Vec3 chord = mesh.vertices[b] - mesh.vertices[a];
            const double radius = rings[ring_of[a]].radius;
            const double sag = radius - std::sqrt(std::max(0.0, radius * radius - 0.25 * chord.squaredNorm()));
            // a disk may be made of chords across it, so only joints of two rings must be near the circle
            if (ring_of[static_cast<std::size_t>(triangle[(k + 2) % 3])] == ring_of[a]) continue;
            if (sag > most_sag * radius) return {};
            parts.sag = std::max(parts.sag, sag);
        }
        if (joined.size() == 3) return {};
        areas[{*joined.begin(), *joined.rbegin()}] += area_of(mesh, triangle);
    }
    for (const auto& [pair, area] : areas) {
        const Ring *low = &rings[pair.first], *high = &rings[pair.second];
        if (!(area > all_round * round_area(*low, *high))) return {};
        if (low->place > high->place) std::swap(low, high);
        parts.shapes.push_back(round_shape(center, axis, *low, *high, near));
    }
    return parts;
}

} // namespace

RoundParts round_parts(const Mesh& mesh)
{
    for (const int d : {2, 1, 0})
        if (RoundParts parts = round_parts_about(mesh, d); !parts.shapes.empty()) return parts;
    return {};
}

std::vector<Plate> plates(const Mesh& mesh)
{
    const double near = same_place * size_of(mesh);
    std::vector<Plate> list;
    std::vector<bool> taken(mesh.triangles.size());
    const auto corner = [&](std::size_t n, std::size_t k) {
        return mesh.vertices[static_cast<std::size_t>(mesh.triangles[n][k % 3])];
    };
    // Two triangles p q r and p q s make a plate where p + q = r + s.
    const auto partner = [&](std::size_t n, std::size_t k) {
        const Vec3 wanted = corner(n, k) + corner(n, k + 1) - corner(n, k + 2);
        for (std::size_t m = n + 1; m < mesh.triangles.size(); ++m) {
            if (taken[m]) continue;
            for (std::size_t j = 0; j < 3; ++j)
                if ((corner(m, j + 2) - wanted).norm() < near &&
                    std::min((corner(m, j) - corner(n, k)).norm(), (corner(m, j) - corner(n, k + 1)).norm()) < near &&
                    std::min((corner(m, j + 1) - corner(n, k)).norm(), (corner(m, j + 1) - corner(n, k + 1)).norm()) <
                        near)
                    return m;
        }
        return n;
    };
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
        for (std::size_t k = 0; k < 3 && !taken[n]; ++k) {
            const std::size_t m = partner(n, k);
            if (m == n) continue;
            taken[n] = taken[m] = true;
            const Vec3 r = corner(n, k + 2);
            list.push_back({r, corner(n, k) - r, corner(n, k + 1) - r});
        }
        if (!taken[n]) return {};
    }
    return list;
}

} // namespace talus
