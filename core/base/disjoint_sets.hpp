// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace talus
{

/// Members 0 to n − 1 that are joined to sets (union–find). A set is named by its first member.
class DisjointSets
{
public:
    explicit DisjointSets(std::size_t members) : parent_(members)
    {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    }

    std::size_t first_of_set(std::size_t member)
    {
        while (parent_[member] != member) member = parent_[member] = parent_[parent_[member]];
        return member;
    }

    void join(std::size_t a, std::size_t b)
    {
        const std::size_t first = first_of_set(a), second = first_of_set(b);
        parent_[std::max(first, second)] = std::min(first, second);
    }

private:
    std::vector<std::size_t> parent_; ///< never larger than the index
};

} // namespace talus
