// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/world/piston.hpp"

#include <catch2/catch.hpp>

using namespace talus;

TEST_CASE("the inertia of a block is that of the points that it is made of", "[piston]")
{
    // Σ m (|x|² − x xᵀ) over the middles of 40³ equal parts, which lack 1/40² of each square.
    constexpr int n = 40;
    const Vec3 extent = GENERATE(Vec3(0.3, 0.2, 0.1), Vec3(0.3, 0.2, 0.0), Vec3(0, 0, 2));
    const double mass = 0.7;
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (int k = 0; k < n * n * n; ++k) {
        const Vec3 share = (Vec3(k % n, k / n % n, k / n / n).array() + 0.5) / n - 0.5;
        const Vec3 x = share.cwiseProduct(extent);
        sum += mass / (n * n * n) * (x.squaredNorm() * Eigen::Matrix3d::Identity() - x * x.transpose());
    }
    CHECK((block_inertia(mass, extent) - sum).norm() < 2.0 / (n * n) * sum.norm());
}
