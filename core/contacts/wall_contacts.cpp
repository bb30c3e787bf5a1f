// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contacts/wall_contacts.hpp"

#include <algorithm>

namespace talus
{
namespace
{

/// Points nearer to each other than this share of the radius are the same point.
constexpr double same_point = 1e-6;

/// Whether the distance has no local minimum at `candidate`: its point lies on another patch, which comes nearer to x.
bool on_a_nearer_patch(
    const WallPoint& candidate, const std::vector<WallPoint>& all, const PlacedWall& wall, double tolerance)
{
    return std::any_of(all.begin(), all.end(), [&](const WallPoint& other) {
        return other.patch != candidate.patch && other.distance < candidate.distance &&
               std::abs(wall.nearest_point(static_cast<std::size_t>(other.patch), candidate.point).distance) <=
                   tolerance;
    });
}

} // namespace

void keep_local_minima(const PlacedWall& wall, double radius, std::vector<WallPoint>& near)
{
    if (near.size() < 2) return;
    const double tolerance = same_point * radius;
    std::vector<WallPoint> points;
    for (const auto& candidate : near) {
        const bool known = std::any_of(points.begin(), points.end(),
            [&](const WallPoint& p) { return (p.point - candidate.point).norm() <= tolerance; });
        if (!known && !on_a_nearer_patch(candidate, near, wall, tolerance)) points.push_back(candidate);
    }
    near = std::move(points);
}

void match_carried(Carried& carried, WallPair& pair, const std::vector<WallPoint>& points)
{
    const auto same = [&](std::uint32_t old, std::size_t k) {
        return points[k].normal.dot(carried.wall_normal[pair.first + old]) > same_contact;
    };
    if (points.size() == 1 && pair.carried == 1 && same(0, 0)) { // nearly always so
        carried.wall_normal[pair.first] = points[0].normal;
        return;
    }
    const bool with_rolling = !carried.walls.rolling_impulse.empty();
    CarriedImpulses matched(points.size(), with_rolling);
    std::vector<std::uint8_t> taken(pair.carried, 0);
    std::vector<std::uint8_t> served(points.size(), 0);
    for (;;) {
        double best = same_contact;
        std::size_t best_point = 0;
        std::uint32_t best_old = 0;
        for (std::size_t k = 0; k < points.size(); ++k)
            for (std::uint32_t old = 0; old < pair.carried; ++old) {
                const double alike = points[k].normal.dot(carried.wall_normal[pair.first + old]);
                if (served[k] || taken[old] || alike <= best) continue;
                best = alike;
                best_point = k;
                best_old = old;
            }
        if (best == same_contact) break;
        served[best_point] = taken[best_old] = 1;
        matched.copy(best_point, carried.walls, pair.first + best_old);
    }
    for (std::size_t k = 0; k < points.size(); ++k) {
        carried.walls.copy(pair.first + k, matched, k);
        carried.wall_normal[pair.first + k] = points[k].normal;
    }
    pair.carried = static_cast<std::uint32_t>(points.size());
}

} // namespace talus
