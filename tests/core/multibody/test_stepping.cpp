// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of eq. (2), step after step.
#include "core/multibody/algorithm_3_1.hpp"
#include "core/multibody/stepping.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace talus::multibody;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace
{

constexpr double rigid = std::numeric_limits<double>::infinity();
constexpr double h = 0.01, mass = 2.0;

/// A mass on a line, held by one row.
struct HeldMass {
    double position = 0.0, velocity = 0.0;

    /// A step under a force.
    void step(double force, const SteppedRow& row)
    {
        Problem problem;
        problem.add_body(MatrixXd::Constant(1, 1, mass), VectorXd::Constant(1, mass * velocity + h * force));
        problem.add_constraint({.law = Law::equality}, {{0, MatrixXd::Ones(1, 1)}},
            VectorXd::Constant(1, row.compliance), VectorXd::Constant(1, row.target));
        Iterate x(problem);
        REQUIRE(solve_projected(x, {.tolerance = 1e-14}).converged);
        velocity = x.velocity()[0];
        position += h * velocity;
    }
};

} // namespace

TEST_CASE("a violation of a holonomic row dies away critically damped for τ = 2h", "[multibody][law]")
{
    // From rest g₀ (1 + 2k/3) 3⁻ᵏ after k steps: the solution of g₊ = 2/3 g − 1/9 g₋.
    HeldMass held{.position = 1e-3};
    for (int k = 1; k <= 12; ++k) {
        held.step(0.0, holonomic_row(held.position, held.velocity, rigid, 2.0 * h, h));
        CHECK(held.position == Approx(1e-3 * (1.0 + 2.0 * k / 3.0) * std::pow(3.0, -k)).epsilon(1e-6));
    }
}

TEST_CASE("a compliant row yields by load over stiffness, whatever the step and the damping", "[multibody][law]")
{
    const double stiffness = GENERATE(1e2, 1e4, 1e7), tau = GENERATE(2.0, 5.0) * h;
    HeldMass held;
    for (int k = 0; k < 4000; ++k) held.step(-20.0, holonomic_row(held.position, held.velocity, stiffness, tau, h));
    CHECK(held.position == Approx(-20.0 / stiffness).epsilon(1e-6));
}

TEST_CASE(
    "a nonholonomic row gives its velocity, up to the slip that its damping lets a force make", "[multibody][law]")
{
    HeldMass belt;
    belt.step(-30.0, nonholonomic_row(0.4, rigid, h));
    CHECK(belt.velocity == Approx(0.4));
    for (int k = 0; k < 2000; ++k) belt.step(-30.0, nonholonomic_row(0.4, 150.0, h));
    CHECK(belt.velocity == Approx(0.4 - 30.0 / 150.0));
}
