// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/candidates/neighbor_search.hpp"
#include "scenarios/builder/packing.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

namespace talus
{
namespace
{

constexpr int centers_tried = 2000; ///< places tried for the centre of one sphere
constexpr int most_sweeps = 4000;
constexpr double margin = 1e-3; ///< by which radii are larger while spheres are pushed apart, so that they end clear
/// Pushes are so many times the overlap, as in successive over-relaxation: with 1 three to six times as many sweeps
/// are needed; with 1.8 a fill of 0.6 does not come to rest.
constexpr double relaxation = 1.7;
constexpr double skin = 0.5; ///< what spheres may move until pairs are listed anew: half of it, in smallest radii

/// Spheres that are pushed apart; the last ones are others, which stay.
class Crowd
{
public:
    Crowd(const PackingRoom& room, std::vector<PackedSphere> spheres, const std::vector<PackedSphere>& others)
        : room_(room), movable_(spheres.size()), spheres_(std::move(spheres))
    {
        spheres_.insert(spheres_.end(), others.begin(), others.end());
        for (const auto& sphere : spheres_) smallest_ = std::min(smallest_, sphere.radius);
    }

    /// Moves every overlapping pair apart and every sphere into the room, one after the other. Returns whether each was
    /// clear when its turn came.
    bool sweep()
    {
        if (moved() > 0.5 * skin * smallest_) list_pairs();
        bool done = true;
        for (const auto& [a, b] : pairs_) done = !part(spheres_[a], spheres_[b], is_free(a), is_free(b)) && done;
        for (const auto i : at_border_) {
            PackedSphere& sphere = spheres_[i];
            sphere.center += room_.way_in(sphere.center, (1.0 + margin) * sphere.radius);
            done = done && room_.holds(sphere.center, sphere.radius);
        }
        return done;
    }

    /// The spheres that lie in the room and overlap none before them.
    std::vector<PackedSphere> clear_ones()
    {
        list_pairs();
        std::vector<std::uint8_t> fits(spheres_.size(), 1);
        for (std::size_t i = 0; i < movable_; ++i) fits[i] = room_.holds(spheres_[i].center, spheres_[i].radius);
        for (const auto& [a, b] : pairs_)
            if (fits[a] && fits[b] && overlap(spheres_[a], spheres_[b]) > 0.0) fits[is_free(b) ? b : a] = 0;
        std::vector<PackedSphere> result;
        for (std::size_t i = 0; i < movable_; ++i)
            if (fits[i]) result.push_back(spheres_[i]);
        return result;
    }

private:
    const PackingRoom& room_;
    std::size_t movable_;
    std::vector<PackedSphere> spheres_;
    std::vector<Vec3> listed_at_; ///< where spheres were when pairs were listed
    std::vector<IndexPair> pairs_;
    std::vector<std::size_t> at_border_; ///< those that may come to lie outside the room before pairs are listed anew
    double smallest_ = infinity;         ///< radius [m]

    bool is_free(std::int32_t i) const { return static_cast<std::size_t>(i) < movable_; }

    Vec3 apart(const PackedSphere& a, const PackedSphere& b) const
    {
        return room_.model().periodicity.nearest_image(a.center - b.center);
    }

    double overlap(const PackedSphere& a, const PackedSphere& b) const
    {
        return a.radius + b.radius - apart(a, b).norm();
    }

    /// Returns whether they overlapped. The smaller one of two goes the longer way.
    bool part(PackedSphere& a, PackedSphere& b, bool a_free, bool b_free) const
    {
        const Vec3 way = apart(a, b);
        const double clear = (1.0 + margin) * (a.radius + b.radius), square = way.squaredNorm();
        if (square >= clear * clear || !(square > 0.0)) return false;
        const double distance = std::sqrt(square), deep = clear - distance;
        const double of_a = a_free ? b.radius * b.radius * b.radius : 0.0;
        const double of_b = b_free ? a.radius * a.radius * a.radius : 0.0;
        const Vec3 push = relaxation * deep / (distance * (of_a + of_b)) * way;
        a.center += of_a * push;
        b.center -= of_b * push;
        return deep > margin * (a.radius + b.radius);
    }

    double moved() const
    {
        if (listed_at_.empty()) return infinity;
        double most = 0.0;
        for (std::size_t i = 0; i < movable_; ++i)
            most = std::max(most, (spheres_[i].center - listed_at_[i]).squaredNorm());
        return std::sqrt(most);
    }

    void list_pairs()
    {
        std::vector<Box> boxes;
        listed_at_.clear();
        for (const auto& sphere : spheres_) {
            boxes.push_back(
                Box{sphere.center, sphere.center}.grown((1.0 + margin) * sphere.radius + 0.5 * skin * smallest_));
            listed_at_.push_back(sphere.center);
        }
        std::vector<std::int32_t> movers(movable_);
        std::iota(movers.begin(), movers.end(), 0);
        pairs_ = find_box_pairs(boxes, movers, room_.model().periodicity);
        std::ranges::sort(pairs_);
        at_border_.clear();
        for (std::size_t i = 0; i < movable_; ++i)
            if (!room_.holds(spheres_[i].center, (1.0 + margin) * spheres_[i].radius + skin * smallest_))
                at_border_.push_back(i);
    }
};

} // namespace

std::vector<PackedSphere> dense_packing(
    const PackingRoom& room, GrainSource& grains, const std::vector<PackedSphere>& others, Random& random)
{
    std::vector<PackedSphere> spheres;
    while (grains.is_open()) {
        const Grain grain = grains.draw(random);
        if (!grains.wants(grain)) break;
        const double radius = 0.5 * grain.diameter;
        std::optional<Vec3> center;
        for (int k = 0; k < centers_tried && !center; ++k) {
            center = room.region().random_point(random, radius);
            if (center && !room.holds(*center, 0.0)) center.reset();
        }
        if (!center) return {};
        spheres.push_back({*center, radius, grain.material});
        grains.take(grain);
    }
    const std::size_t count = spheres.size();
    Crowd crowd(room, std::move(spheres), others);
    // The last pushes of a sweep may have closed what it had opened before.
    for (int k = 0; k < most_sweeps; ++k) {
        if (!crowd.sweep()) continue;
        auto clear = crowd.clear_ones();
        if (clear.size() == count) return clear;
    }
    return crowd.clear_ones();
}

} // namespace talus
