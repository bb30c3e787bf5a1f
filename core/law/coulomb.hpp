// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/lanes.hpp"

namespace talus
{

/// Coulomb's disk, METHOD (7) and (8): cuts vectors that are too long back to this radius.
/// @tparam V has dot(V), and can be multiplied by N
template <class N, class V> [[gnu::always_inline]] inline void cut_to_disk(V& vector, const N& radius)
{
    const N size_squared = vector.dot(vector);
    const Answer<N> outside = size_squared > radius * radius;
    if (!any_of(outside)) return;
    const N one = size_squared * 0.0 + 1.0;
    vector = vector * (outside ? radius / root<N>(size_squared) : one);
}

/// By how much a vector is too long for that disk.
template <class N, class V> [[gnu::always_inline]] inline N beyond_disk(const V& vector, const N& radius)
{
    const N size_squared = vector.dot(vector), none = {};
    const Answer<N> outside = size_squared > radius * radius;
    return any_of(outside) ? (outside ? root<N>(size_squared) - radius : none) : none;
}

} // namespace talus
