// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/periodicity.hpp"
#include "core/base/vector.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace talus
{

/// Two indices, a < b.
struct IndexPair {
    std::int32_t a = 0;
    std::int32_t b = 0;
    bool operator==(const IndexPair&) const = default;
    /// By a, then by b: in one comparison, since lists of pairs are sorted at every search.
    auto operator<=>(const IndexPair& other) const { return key() <=> other.key(); }

private:
    std::uint64_t key() const { return (static_cast<std::uint64_t>(a) << 32U) + static_cast<std::uint32_t>(b); }
};
static_assert(sizeof(IndexPair) == 8 && offsetof(IndexPair, a) == 0 && offsetof(IndexPair, b) == 4); // two numbers

/// All pairs of boxes that meet, touching included, across periodic borders too, each once and in no particular order
/// (CGAL's box intersection, slab by slab, the slabs at the same time).
std::vector<IndexPair> find_box_pairs(const std::vector<Box>& boxes, const Periodicity& periodicity = {});

/// The same, but only the pairs with at least one member in `movers`, whose entries differ: by a grid of the movers
/// (mover_search.cpp).
std::vector<IndexPair> find_box_pairs(
    const std::vector<Box>& boxes, const std::vector<std::int32_t>& movers, const Periodicity& periodicity = {});

/// Sorts the pairs, and keeps one of those that are equal: in a short cell two boxes may meet across its border on both
/// sides.
void keep_each_once(std::vector<IndexPair>& pairs);

/// The same as the first by trying every pair: the oracle of the tests.
std::vector<IndexPair> find_box_pairs_brute_force(const std::vector<Box>& boxes, const Periodicity& periodicity = {});

} // namespace talus
