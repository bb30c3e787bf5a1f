// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/multibody/problem.hpp"

namespace talus::multibody
{

/// A constraint on a body, and which block of the problem its G_kb is.
struct BlockOfConstraint {
    std::size_t constraint;
    std::size_t block;
};

/// c_b1, c_b2, … of the note: by body, the constraints that touch it, in ascending order.
std::vector<std::vector<BlockOfConstraint>> constraints_by_body(const Problem& problem);

} // namespace talus::multibody
