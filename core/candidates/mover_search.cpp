// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/candidates/neighbor_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace talus
{
namespace
{

constexpr double cells_per_box = 16;        ///< at most; where boxes lie far apart, cells are larger
constexpr double usual_length = 1.5;        ///< of a box, in mean lengths
constexpr double rounding = 1.0 + 1e-9;     ///< of lengths
constexpr std::size_t boxes_at_once = 4096; ///< that a thread compares

/// A box in single precision, no smaller: most boxes of a cell do not meet, and this is seen in two comparisons.
struct RoughBox {
    typedef float Corner __attribute__((vector_size(4 * sizeof(float))));
    typedef std::int32_t Flags __attribute__((vector_size(4 * sizeof(float))));
    Corner min, max;

    RoughBox() = default;
    explicit RoughBox(const Box& box)
    {
        const auto least = [](double x) { return static_cast<float>(x - 1e-6 * std::abs(x) - 1e-30); };
        const auto most = [](double x) { return static_cast<float>(x + 1e-6 * std::abs(x) + 1e-30); };
        min = Corner{least(box.min.x()), least(box.min.y()), least(box.min.z()), 0.0F};
        max = Corner{most(box.max.x()), most(box.max.y()), most(box.max.z()), 0.0F};
    }
    bool meets(const RoughBox& other) const
    {
        const Flags both = (min <= other.max) & (other.min <= max);
        std::int64_t halves[2];
        __builtin_memcpy(halves, &both, sizeof halves);
        return (halves[0] & halves[1]) == -1;
    }
};

/// Some boxes, in cells of a grid by where they begin, so that each is in one only.
class BoxGrid
{
public:
    /// @param longest none of the members is longer
    BoxGrid(const std::vector<Box>& boxes, std::vector<std::int32_t> members, double longest)
        : boxes_(boxes), longest_(rounding * longest)
    {
        if (members.empty()) return;
        for (const auto i : members) around_.extend(boxes[static_cast<std::size_t>(i)]);
        const double room = around_.extent().prod() / (cells_per_box * static_cast<double>(members.size()));
        edge_ = std::max(0.5 * longest, std::cbrt(room));
        for (std::size_t d = 0; d < 3; ++d)
            cells_[d] = 1 + static_cast<std::int32_t>(around_.extent()[static_cast<int>(d)] / edge_);

        first_.assign(static_cast<std::size_t>(cells_[0]) * cells_[1] * cells_[2] + 1, 0);
        const auto cell_of = [&](std::int32_t i) {
            const Vec3& begin = boxes[static_cast<std::size_t>(i)].min;
            return at(index(begin, 0), index(begin, 1), index(begin, 2));
        };
        for (const auto i : members) ++first_[cell_of(i) + 1];
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        members_.resize(members.size());
        rough_.resize(members.size());
        auto place = first_;
        for (const auto i : members) {
            const auto k = place[cell_of(i)]++;
            members_[k] = i;
            rough_[k] = RoughBox(boxes[static_cast<std::size_t>(i)]);
        }
    }

    /// Calls use(member) for each member whose box meets this one.
    template <class Use> void for_each_met(const Box& box, Use&& use) const
    {
        if (members_.empty() || !box.meets(around_)) return;
        const Vec3 begin = box.min.array() - longest_;
        const RoughBox rough(box);
        const auto first_x = index(begin, 0), last_x = index(box.max, 0);
        for (auto z = index(begin, 2), last_z = index(box.max, 2); z <= last_z; ++z)
            for (auto y = index(begin, 1), last_y = index(box.max, 1); y <= last_y; ++y)
                for (auto k = first_[at(first_x, y, z)], end = first_[at(last_x, y, z) + 1]; k < end; ++k)
                    if (rough_[k].meets(rough) && boxes_[static_cast<std::size_t>(members_[k])].meets(box))
                        use(members_[k]);
    }

private:
    const std::vector<Box>& boxes_;
    double longest_, edge_ = 0.0;
    Box around_;
    std::array<std::int32_t, 3> cells_{};
    std::vector<std::uint32_t> first_; ///< by cell: its members are members_[first_[c]] to members_[first_[c + 1] − 1]
    std::vector<std::int32_t> members_;
    std::vector<RoughBox> rough_; ///< by place in members_

    std::int32_t index(const Vec3& x, int axis) const
    {
        const double along = (x[axis] - around_.min[axis]) / edge_;
        return static_cast<std::int32_t>(
            std::clamp(along, 0.0, static_cast<double>(cells_[static_cast<std::size_t>(axis)] - 1)));
    }

    std::size_t at(std::int32_t x, std::int32_t y, std::int32_t z) const
    {
        return (static_cast<std::size_t>(z) * cells_[1] + y) * cells_[0] + x;
    }
};

/// Members in two grids: those that are much longer than most would make the cells of all too large.
class MoverGrids
{
public:
    MoverGrids(const std::vector<Box>& boxes, const std::vector<std::int32_t>& movers)
    {
        const auto length = [&](std::int32_t i) { return boxes[static_cast<std::size_t>(i)].extent().maxCoeff(); };
        double sum = 0.0;
        for (const auto i : movers) sum += length(i);
        const double usual = usual_length * sum / static_cast<double>(movers.size());
        std::vector<std::int32_t> usual_ones, long_ones;
        double longest = 0.0;
        for (const auto i : movers) {
            (length(i) <= usual ? usual_ones : long_ones).push_back(i);
            longest = std::max(longest, length(i));
        }
        grids_.emplace_back(boxes, std::move(usual_ones), std::min(usual, longest));
        grids_.emplace_back(boxes, std::move(long_ones), longest);
    }

    template <class Use> void for_each_met(const Box& box, Use&& use) const
    {
        for (const BoxGrid& grid : grids_) grid.for_each_met(box, use);
    }

private:
    std::vector<BoxGrid> grids_;
};

} // namespace

std::vector<IndexPair> find_box_pairs(
    const std::vector<Box>& boxes, const std::vector<std::int32_t>& movers, const Periodicity& periodicity)
{
    if (movers.empty()) return {};
    std::vector<std::uint8_t> moves(boxes.size(), 0);
    for (const auto i : movers) moves[static_cast<std::size_t>(i)] = 1;
    const MoverGrids movers_at(boxes, movers);
    const auto shifts = periodicity.neighbor_shifts();

    std::vector<std::vector<IndexPair>> found((boxes.size() + boxes_at_once - 1) / boxes_at_once);
#pragma omp parallel for schedule(dynamic) if (found.size() > 1)
    for (std::size_t part = 0; part < found.size(); ++part) {
        const auto end = std::min(boxes.size(), (part + 1) * boxes_at_once);
        for (std::size_t i = part * boxes_at_once; i < end; ++i)
            for (const Vec3& shift : shifts)
                movers_at.for_each_met(boxes[i].shifted(shift), [&](std::int32_t mover) {
                    // Two movers meet twice, once in each role; a box and its own image are no pair.
                    const auto other = static_cast<std::int32_t>(i);
                    if (other == mover || (moves[i] && other < mover)) return;
                    found[part].push_back({std::min(mover, other), std::max(mover, other)});
                });
    }
    std::vector<IndexPair> pairs = std::move(found[0]);
    for (std::size_t part = 1; part < found.size(); ++part)
        pairs.insert(pairs.end(), found[part].begin(), found[part].end());
    if (periodicity.any()) keep_each_once(pairs);
    return pairs;
}

} // namespace talus
