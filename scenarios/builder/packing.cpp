// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/builder/packing.hpp"

#include "core/world/closed_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace talus
{
namespace
{

constexpr int tries = 2000;                    ///< places tried for one sphere of a random or dense packing
constexpr std::int64_t most_places = 10000000; ///< of a lattice, and ten for each sphere, tried in vain

/// Spheres sorted into cubes as large as the largest of them, to find those near a place.
class SphereGrid
{
public:
    explicit SphereGrid(double edge) : edge_(edge) {}

    void add(const PackedSphere& sphere) { cells_[key(sphere.center)].push_back(sphere); }

    bool overlaps(const PackedSphere& sphere) const
    {
        for (int dx = -1; dx <= 1; ++dx)
            for (int dy = -1; dy <= 1; ++dy)
                for (int dz = -1; dz <= 1; ++dz)
                    if (overlaps_in(key(sphere.center + edge_ * Vec3(dx, dy, dz)), sphere)) return true;
        return false;
    }

private:
    std::uint64_t key(const Vec3& x) const
    {
        std::uint64_t k = 0;
        for (int d = 0; d < 3; ++d)
            k = (k << 21) ^
                (static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(x[d] / edge_))) & 0x1fffff);
        return k;
    }

    bool overlaps_in(std::uint64_t cell, const PackedSphere& sphere) const
    {
        const auto found = cells_.find(cell);
        return found != cells_.end() &&
               std::any_of(found->second.begin(), found->second.end(), [&](const PackedSphere& other) {
                   const double least = sphere.radius + other.radius;
                   return (sphere.center - other.center).squaredNorm() < least * least;
               });
    }

    double edge_;
    std::unordered_map<std::uint64_t, std::vector<PackedSphere>> cells_;
};

/// A grid with these spheres in it, to which those of a mixture may be added.
SphereGrid grid_of(const std::vector<PackedSphere>& others, const GrainSource& grains)
{
    double largest = grains.max_diameter();
    for (const auto& sphere : others) largest = std::max(largest, 2.0 * sphere.radius);
    SphereGrid grid(largest);
    for (const auto& sphere : others) grid.add(sphere);
    return grid;
}

Vec3 random_in_ball(Random& random)
{
    for (;;) {
        // One after the other: compilers take the arguments of a call in orders of their own.
        const double z = 2.0 * uniform(random) - 1.0;
        const double y = 2.0 * uniform(random) - 1.0;
        const double x = 2.0 * uniform(random) - 1.0;
        const Vec3 point(x, y, z);
        if (point.squaredNorm() <= 1.0) return point;
    }
}

/// The directions of a lattice whose layers are stacked against gravity.
struct LatticeFrame {
    Vec3 up, e1, e2;

    explicit LatticeFrame(const Model& model) : up(model.up())
    {
        // Along the axes of the world where gravity is along one, so that box-shaped regions are filled to their
        // corners.
        e1 = std::abs(up[0]) < 0.9 ? (Vec3::UnitX() - up[0] * up).normalized()
                                   : (Vec3::UnitY() - up[1] * up).normalized();
        e2 = up.cross(e1);
    }
};

} // namespace

PackingRoom::PackingRoom(const Region& region, std::vector<Region> except, const Model& model)
    : region_(region), model_(model), except_(std::move(except)), walls_(place_walls_at_start(model))
{
    for (const PlacedWall& wall : walls_) {
        auto inside = wall.stands() ? inside_of(wall.wall().shape, same_corner * model.mean_diameter) : std::nullopt;
        if (inside) closed_.push_back({std::move(*inside), wall.pose().inverse(), false});
    }
    const Box bounds = region.bounds();
    for (ClosedWall& wall : closed_) {
        constexpr int places = 16; // along each axis
        int balance = 0;           // places of the region inside the wall, less those outside
        for (int i = 0; i < places * places * places; ++i) {
            const Vec3 at = (Vec3(i % places, i / places % places, i / places / places).array() + 0.5) / places;
            const Vec3 x = bounds.min + at.cwiseProduct(bounds.extent());
            if (region.contains(x)) balance += wall.inside.contains(wall.into(x)) ? 1 : -1;
        }
        wall.filled = balance > 0;
    }
}

bool PackingRoom::on_right_side(const Vec3& x) const
{
    return std::ranges::all_of(
        closed_, [&](const ClosedWall& wall) { return wall.inside.contains(wall.into(x)) == wall.filled; });
}

bool PackingRoom::holds(const Vec3& center, double radius) const
{
    return region_.contains(center, radius) &&
           std::ranges::all_of(except_, [&](const Region& free) { return free.depth(center) <= -radius; }) &&
           !touches_wall(walls_, center, radius) && on_right_side(center);
}

Vec3 PackingRoom::way_in(const Vec3& center, double radius) const
{
    double least = 0.0; // the greatest breach has the least margin
    Vec3 way = Vec3::Zero();
    const auto ask = [&](double margin, auto&& direction) {
        if (margin >= least) return;
        least = margin;
        way = -margin * direction();
    };
    const auto inwards = [&](const Region& region, const Vec3& x) {
        Vec3 slope;
        for (int d = 0; d < 3; ++d) {
            const Vec3 step = 1e-4 * radius * Vec3::Unit(d);
            slope[d] = region.depth(x + step) - region.depth(x - step);
        }
        return slope.stableNormalized();
    };
    ask(region_.depth(center) - radius, [&] { return inwards(region_, center); });
    for (const Region& free : except_) ask(-free.depth(center) - radius, [&] { return Vec3(-inwards(free, center)); });
    for (const PlacedWall& wall : walls_) {
        if (!wall.stands()) continue;
        std::vector<std::int32_t> patches;
        wall.patches_near(Box{center, center}.grown(radius), patches);
        for (const auto k : patches) {
            const WallPoint at = wall.nearest_point(static_cast<std::size_t>(k), center);
            ask(at.distance - radius, [&] { return at.normal; });
        }
    }
    for (const ClosedWall& wall : closed_) {
        const Vec3 x = wall.into(center);
        if (wall.inside.contains(x) == wall.filled) continue;
        const double sign = wall.filled ? 1.0 : -1.0;
        ask(sign * wall.inside.depth(x) - radius,
            [&] { return Vec3(sign * (wall.into.rotation.transpose() * inwards(wall.inside, x))); });
    }
    return way;
}

std::vector<PackedSphere> lattice_packing(const PackingRoom& room, GrainSource& grains, double spacing,
    const std::vector<PackedSphere>& others, Random& random)
{
    const double a = spacing * grains.max_diameter(); // distance of nearest lattice points
    const LatticeFrame frame(room.model());
    const Box bounds = room.region().bounds();
    const Vec3 middle = bounds.center();
    // Half the region's size along each direction of the frame.
    const auto half = [&](const Vec3& e) { return 0.5 * bounds.extent().dot(e.cwiseAbs()); };
    const auto places = [&](double length) {
        return static_cast<std::int64_t>(std::min(length / a, static_cast<double>(most_places))) + 2;
    };
    const auto layers = places(2.0 * half(frame.up)), rows = places(half(frame.e1)), columns = places(half(frame.e2));

    const auto grid = grid_of(others, grains);
    std::vector<PackedSphere> spheres;
    Grain next = grains.draw(random);
    std::int64_t in_vain = 0; // places that were taken, or outside
    for (std::int64_t k = 0; k < layers; ++k) {
        for (std::int64_t i = -rows; i <= rows; ++i)
            for (std::int64_t j = -columns; j <= columns; ++j) {
                if (!grains.wants(next)) return spheres;
                const double radius = 0.5 * next.diameter;
                const Vec3 jitter = (0.5 * a - radius) * random_in_ball(random);
                const Vec3 point = middle + static_cast<double>(i) * a * frame.e1 +
                                   static_cast<double>(j) * a * frame.e2 +
                                   (0.5 * a - half(frame.up) + static_cast<double>(k) * a) * frame.up;
                const PackedSphere sphere{point + jitter, radius, next.material};
                if (!room.holds(sphere.center, radius) || grid.overlaps(sphere)) {
                    if (++in_vain > most_places + 10 * grains.taken()) return spheres;
                    continue;
                }
                spheres.push_back(sphere);
                grains.take(next);
                next = grains.draw(random);
            }
    }
    return spheres;
}

std::vector<PackedSphere> random_packing(
    const PackingRoom& room, GrainSource& grains, const std::vector<PackedSphere>& others, Random& random)
{
    auto grid = grid_of(others, grains);
    std::vector<PackedSphere> spheres;
    while (grains.is_open()) {
        const Grain grain = grains.draw(random);
        if (!grains.wants(grain)) break;
        const double radius = 0.5 * grain.diameter;
        bool placed = false;
        for (int k = 0; k < tries && !placed; ++k) {
            const auto center = room.region().random_point(random, radius);
            placed = center && !grid.overlaps({*center, radius}) && room.holds(*center, radius);
            if (!placed) continue;
            grid.add({*center, radius, grain.material});
            spheres.push_back({*center, radius, grain.material});
            grains.take(grain);
        }
        if (!placed) break;
    }
    return spheres;
}

} // namespace talus
