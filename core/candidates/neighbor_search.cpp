// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/candidates/neighbor_search.hpp"

#include <CGAL/box_intersection_d.h>

#include <algorithm>

namespace talus
{
namespace
{

/// A box as CGAL's search wants it (concept BoxIntersectionBox_d). Its id is the index: `box_intersection_d` leaves out
/// pairs with equal ids, which here are exactly a mover paired with itself.
class SearchBox
{
public:
    using NT = double;
    using ID = std::int32_t;

    SearchBox(const Box& box, ID index) : box_(box), index_(index) {}
    static int dimension() { return 3; }
    ID id() const { return index_; }
    NT min_coord(int d) const { return box_.min[d]; }
    NT max_coord(int d) const { return box_.max[d]; }

private:
    Box box_;
    ID index_;
};

/// Below this number of boxes CGAL tries every pair; with its default of 10 a full search takes 1.7
/// times as long, and with 1000 a search for few movers does.
constexpr std::ptrdiff_t cutoff = 30;

/// The boxes and their images, by their own indices, as far as they meet `around`.
std::vector<SearchBox> search_boxes(const std::vector<Box>& boxes, const std::vector<Vec3>& shifts, const Box& around)
{
    std::vector<SearchBox> result;
    result.reserve(boxes.size());
    for (const Vec3& shift : shifts)
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const Box image = boxes[i].shifted(shift);
            if (image.meets(around)) result.emplace_back(image, static_cast<std::int32_t>(i));
        }
    return result;
}

Box box_around(const std::vector<Box>& boxes)
{
    Box around;
    for (const Box& box : boxes) around.extend(box);
    return around;
}

IndexPair ordered(std::int32_t i, std::int32_t j)
{
    return {std::min(i, j), std::max(i, j)};
}

/// In a short cell two boxes may meet across its border on both sides.
void keep_each_once(std::vector<IndexPair>& pairs)
{
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

} // namespace

std::vector<IndexPair> find_box_pairs(const std::vector<Box>& boxes, const Periodicity& periodicity)
{
    std::vector<IndexPair> pairs;
    auto all = search_boxes(boxes, periodicity.neighbor_shifts(), box_around(boxes));
    CGAL::box_self_intersection_d<CGAL::Sequential_tag>(
        all.begin(), all.end(),
        [&](const SearchBox& p, const SearchBox& q) { pairs.push_back(ordered(p.id(), q.id())); }, cutoff);
    if (periodicity.any()) keep_each_once(pairs);
    return pairs;
}

std::vector<IndexPair> find_box_pairs(
    const std::vector<Box>& boxes, const std::vector<std::int32_t>& movers, const Periodicity& periodicity)
{
    std::vector<std::uint8_t> moves(boxes.size(), 0);
    std::vector<SearchBox> some;
    some.reserve(movers.size());
    Box around;
    for (const auto i : movers) {
        moves[static_cast<std::size_t>(i)] = 1;
        some.emplace_back(boxes[static_cast<std::size_t>(i)], i);
        around.extend(boxes[static_cast<std::size_t>(i)]);
    }
    auto others = search_boxes(boxes, periodicity.neighbor_shifts(), around);

    std::vector<IndexPair> pairs;
    CGAL::box_intersection_d<CGAL::Sequential_tag>(
        some.begin(), some.end(), others.begin(), others.end(),
        [&](const SearchBox& mover, const SearchBox& other) {
            // Two movers meet twice, once in each role.
            if (moves[static_cast<std::size_t>(other.id())] && other.id() < mover.id()) return;
            pairs.push_back(ordered(mover.id(), other.id()));
        },
        cutoff);
    if (periodicity.any()) keep_each_once(pairs);
    return pairs;
}

std::vector<IndexPair> find_box_pairs_brute_force(const std::vector<Box>& boxes, const Periodicity& periodicity)
{
    const auto shifts = periodicity.neighbor_shifts();
    const auto meet = [&](const Box& a, const Box& b) {
        return std::any_of(shifts.begin(), shifts.end(), [&](const Vec3& shift) { return a.meets(b.shifted(shift)); });
    };
    std::vector<IndexPair> pairs;
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (std::size_t j = i + 1; j < boxes.size(); ++j)
            if (meet(boxes[i], boxes[j])) pairs.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)});
    return pairs;
}

} // namespace talus
