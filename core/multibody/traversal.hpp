// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace talus::multibody
{

/// The order in which a sweep goes through the constraints.
enum class Order {
    natural,
    reversed,
    symmetric, ///< natural and reversed in turn
    shuffled,  ///< another permutation for each sweep, by the seed
};

/// Gives each sweep its order.
class Traversal
{
public:
    Traversal(Order order, std::size_t constraints, std::uint64_t seed);

    /// The constraints in the order of the next sweep.
    const std::vector<std::size_t>& next();

private:
    Order order_;
    bool first_ = true;
    std::mt19937_64 random_;
    std::vector<std::size_t> sequence_;
};

} // namespace talus::multibody
