// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/multibody.hpp"

#include <algorithm>
#include <numeric>

namespace talus::test
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using multibody::BodyRows;
using multibody::Law;
using multibody::Problem;

MatrixXd random_matrix(Random& random, Index rows, Index columns)
{
    return MatrixXd::NullaryExpr(rows, columns, [&] { return 2.0 * uniform(random) - 1.0; });
}

namespace
{

/// A number between 1 and `most`.
Index some(Random& random, Index most)
{
    return 1 + static_cast<Index>(random() % static_cast<std::uint64_t>(most));
}

/// So many different bodies of the problem.
std::vector<std::size_t> some_bodies(Random& random, std::size_t bodies, int wanted)
{
    std::vector<std::size_t> all(bodies);
    std::iota(all.begin(), all.end(), std::size_t{0});
    for (std::size_t i = bodies; i > 1; --i) std::swap(all[i - 1], all[random() % i]);
    all.resize(std::min(bodies, static_cast<std::size_t>(wanted)));
    return all;
}

} // namespace

Problem random_equalities(const RandomShape& shape, std::uint64_t seed)
{
    constexpr Index most_dofs = 6;
    Random random(seed);
    Problem problem;
    for (int b = 0; b < shape.bodies; ++b) {
        const Index dofs = some(random, most_dofs);
        const MatrixXd root = random_matrix(random, dofs, dofs);
        problem.add_body(MatrixXd::Identity(dofs, dofs) + root * root.transpose(), random_matrix(random, dofs, 1));
    }
    for (int k = 0; k < shape.constraints; ++k) {
        const Index rows = some(random, shape.most_rows);
        std::vector<BodyRows> bodies;
        for (const auto b : some_bodies(random, problem.body_count(), shape.bodies_of_constraint))
            bodies.push_back({b, random_matrix(random, rows, problem.mass(b).rows())});
        problem.add_constraint(
            {.law = Law::equality}, bodies, VectorXd::Constant(rows, shape.compliance), random_matrix(random, rows, 1));
    }
    return problem;
}

Problem column(const std::vector<double>& masses, Law law)
{
    Problem problem;
    for (const double mass : masses) problem.add_body(MatrixXd::Constant(1, 1, mass), VectorXd::Constant(1, -mass));
    const MatrixXd up = MatrixXd::Constant(1, 1, 1.0);
    for (std::size_t k = 0; k < masses.size(); ++k) {
        std::vector<BodyRows> bodies = {{k, up}};
        if (k > 0) bodies.push_back({k - 1, -up});
        problem.add_constraint({.law = law}, bodies, VectorXd::Zero(1), VectorXd::Zero(1));
    }
    return problem;
}

VectorXd column_impulses(const std::vector<double>& masses)
{
    VectorXd impulse(static_cast<Index>(masses.size()));
    double above = 0.0;
    for (auto k = masses.size(); k-- > 0;) impulse[static_cast<Index>(k)] = above += masses[k];
    return impulse;
}

} // namespace talus::test
