// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/candidates/neighbor_search.hpp"

#include <CGAL/box_intersection_d.h>

#include <algorithm>

namespace talus
{
namespace
{

/// A box as CGAL's search wants it (concept BoxIntersectionBox_d). Its id is the index: pairs with equal ids, a box and
/// its own image, are left out.
class SearchBox
{
public:
    using NT = double;
    using ID = std::int32_t;

    SearchBox(const Box& box, ID index) : box_(box), index_(index) {}
    static int dimension() { return 3; }
    ID id() const { return index_; }
    const Box& box() const { return box_; }
    NT min_coord(int d) const { return box_.min[d]; }
    NT max_coord(int d) const { return box_.max[d]; }

private:
    Box box_;
    ID index_;
};

/// Below this number of boxes CGAL tries every pair; with its default of 10 a search takes 1.7 times as long.
constexpr std::ptrdiff_t cutoff = 30;

/// Boxes of a slab, on average. Smaller ones are searched faster, but then more boxes stand in two.
constexpr std::size_t slab_size = 8000;

Box box_around(const std::vector<Box>& boxes)
{
    Box around;
    for (const Box& box : boxes) around.extend(box);
    return around;
}

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

/// Slices of space across its longest side, in each of which as many of some boxes begin. A pair of boxes that meet is
/// found in the slab where the second one of them begins, so that slabs can be searched at the same time.
class Slabs
{
public:
    explicit Slabs(const std::vector<SearchBox>& boxes)
    {
        Box around;
        for (const SearchBox& box : boxes) around.extend(box.box());
        if (!boxes.empty()) around.extent().maxCoeff(&axis_);
        std::vector<double> begin;
        begin.reserve(boxes.size());
        for (const SearchBox& box : boxes) begin.push_back(box.min_coord(axis_));
        for (std::size_t k = slab_size; k < begin.size(); k += slab_size) {
            const auto cut = begin.begin() + static_cast<std::ptrdiff_t>(k);
            std::nth_element(begin.begin() + static_cast<std::ptrdiff_t>(k - slab_size), cut, begin.end());
            cuts_.push_back(*cut);
        }
    }

    std::size_t count() const { return cuts_.size() + 1; }

    /// The boxes that meet each slab.
    std::vector<std::vector<SearchBox>> sort(const std::vector<SearchBox>& boxes) const
    {
        std::vector<std::vector<SearchBox>> slabs(count());
        for (const SearchBox& box : boxes)
            for (auto k = slab_at(box.min_coord(axis_)), last = slab_at(box.max_coord(axis_)); k <= last; ++k)
                slabs[k].push_back(box);
        return slabs;
    }

    bool is_in(std::size_t slab, const SearchBox& a, const SearchBox& b) const
    {
        return slab_at(std::max(a.min_coord(axis_), b.min_coord(axis_))) == slab;
    }

private:
    int axis_ = 0;
    std::vector<double> cuts_;

    std::size_t slab_at(double x) const
    {
        return static_cast<std::size_t>(std::upper_bound(cuts_.begin(), cuts_.end(), x) - cuts_.begin());
    }
};

/// Calls search(slab, pairs) for all slabs at the same time. Returns what they found, slab after slab.
template <class Search> std::vector<IndexPair> search_slabs(const Slabs& slabs, Search&& search)
{
    std::vector<std::vector<IndexPair>> found(slabs.count());
#pragma omp parallel for schedule(dynamic) if (slabs.count() > 1)
    for (std::size_t k = 0; k < slabs.count(); ++k) search(k, found[k]);
    std::vector<IndexPair> pairs = std::move(found[0]);
    for (std::size_t k = 1; k < found.size(); ++k) pairs.insert(pairs.end(), found[k].begin(), found[k].end());
    return pairs;
}

IndexPair ordered(std::int32_t i, std::int32_t j)
{
    return {std::min(i, j), std::max(i, j)};
}

} // namespace

void keep_each_once(std::vector<IndexPair>& pairs)
{
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

std::vector<IndexPair> find_box_pairs(const std::vector<Box>& boxes, const Periodicity& periodicity)
{
    const auto all = search_boxes(boxes, periodicity.neighbor_shifts(), box_around(boxes));
    const Slabs slabs(all);
    auto in_slab = slabs.sort(all);
    auto pairs = search_slabs(slabs, [&](std::size_t k, std::vector<IndexPair>& found) {
        CGAL::box_self_intersection_d<CGAL::Sequential_tag>(
            in_slab[k].begin(), in_slab[k].end(),
            [&](const SearchBox& p, const SearchBox& q) {
                if (slabs.is_in(k, p, q)) found.push_back(ordered(p.id(), q.id()));
            },
            cutoff);
    });
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
