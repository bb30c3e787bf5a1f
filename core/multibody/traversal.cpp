// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/multibody/traversal.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace talus::multibody
{
namespace
{

/// Fisher and Yates's shuffle; the one of the standard library differs between libraries.
void shuffle(std::vector<std::size_t>& sequence, std::mt19937_64& random)
{
    for (std::size_t k = sequence.size(); k > 1; --k) std::swap(sequence[k - 1], sequence[random() % k]);
}

} // namespace

Traversal::Traversal(Order order, std::size_t constraints, std::uint64_t seed)
    : order_(order), random_(seed), sequence_(constraints)
{
    std::iota(sequence_.begin(), sequence_.end(), std::size_t{0});
    if (order == Order::reversed) std::reverse(sequence_.begin(), sequence_.end());
}

const std::vector<std::size_t>& Traversal::next()
{
    if (order_ == Order::symmetric && !std::exchange(first_, false)) std::reverse(sequence_.begin(), sequence_.end());
    if (order_ == Order::shuffled) shuffle(sequence_, random_);
    return sequence_;
}

} // namespace talus::multibody
