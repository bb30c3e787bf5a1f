// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/multibody/body_constraints.hpp"

namespace talus::multibody
{

std::vector<std::vector<BlockOfConstraint>> constraints_by_body(const Problem& problem)
{
    std::vector<std::vector<BlockOfConstraint>> of_body(problem.body_count());
    for (std::size_t k = 0; k < problem.constraints().size(); ++k)
        for (std::size_t i = problem.first_block(k); i < problem.first_block(k + 1); ++i)
            of_body[problem.body_of_block(i)].push_back({k, i});
    return of_body;
}

} // namespace talus::multibody
