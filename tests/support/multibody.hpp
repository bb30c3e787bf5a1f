// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/region.hpp"
#include "core/multibody/problem.hpp"

namespace talus::test
{

/// Entries between −1 and 1.
Eigen::MatrixXd random_matrix(Random& random, Eigen::Index rows, Eigen::Index columns);

/// What a random problem is like.
struct RandomShape {
    int bodies;
    int constraints;
    Eigen::Index most_rows;   ///< a constraint has 1 … so many
    int bodies_of_constraint; ///< so many different bodies, or all there are
    double compliance;        ///< diagonal of Σ over that of G M⁻¹ Gᵀ, about
};

/// Bodies with 1 … 6 degrees of freedom and full mass blocks; equalities with random rows.
multibody::Problem random_equalities(const RandomShape& shape, std::uint64_t seed);

/// A column of masses on a floor, after a step of free fall by −1 m/s: one row for each contact, from the floor up.
multibody::Problem column(const std::vector<double>& masses, multibody::Law law = multibody::Law::unilateral);

/// The impulses that hold it: what lies above.
Eigen::VectorXd column_impulses(const std::vector<double>& masses);

} // namespace talus::test
