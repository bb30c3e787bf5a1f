// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/multibody/algorithm_3_1.hpp"
#include "tests/support/multibody.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace talus;
using namespace talus::multibody;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace
{

/// Units of mass, length and time: the same physics in other numbers.
struct Units {
    double mass = 1.0, length = 1.0, time = 1.0;

    double velocity() const { return length / time; }
    double impulse() const { return mass * length / time; }
};

/// Two bodies with six degrees of freedom, between them and the floor three contacts with coupled blocks and rolling
/// rows.
Problem coupled_contacts(const Units& units)
{
    Random random(12);
    Problem problem;
    for (const double mass : {1.0, 7.0}) {
        VectorXd inertia = VectorXd::Constant(6, mass * units.mass);
        inertia.tail<3>() *= 0.1 * units.length * units.length;
        VectorXd velocity = test::random_matrix(random, 6, 1);
        velocity[2] -= 2.0;
        velocity.head<3>() *= units.velocity();
        velocity.tail<3>() /= units.time;
        problem.add_body(inertia.asDiagonal(), inertia.cwiseProduct(velocity));
    }
    const auto rows = [&](double sign) {
        MatrixXd G = 0.3 * test::random_matrix(random, 5, 6);
        G.topLeftCorner<3, 3>() += sign * (MatrixXd(3, 3) << 0, 0, 1, 1, 0, 0, 0, 1, 0).finished();
        G.bottomRightCorner<2, 3>() += sign * MatrixXd::Identity(2, 3);
        G.bottomLeftCorner<2, 3>().setZero();
        G.topRightCorner<3, 3>() *= units.length;
        return G;
    };
    const Constraint law{.law = Law::contact, .friction = 0.4, .rolling_reach = 0.05 * units.length};
    const VectorXd zero = VectorXd::Zero(5);
    problem.add_constraint(law, {{0, rows(1)}}, zero, zero);
    problem.add_constraint(law, {{1, rows(1)}, {0, rows(-1)}}, zero, zero);
    problem.add_constraint(law, {{1, rows(1)}}, zero, zero);
    return problem;
}

} // namespace

TEST_CASE("the error measures do not depend on the units", "[multibody]")
{
    const Units other{1e-6, 1e3, 60.0}; // milligrams and the like
    const auto problem = coupled_contacts({}), same = coupled_contacts(other);
    Iterate x(problem), y(same);
    const SolveSettings three{.tolerance = 0.0, .max_sweeps = 3};
    solve_projected(x, three);
    solve_projected(y, three);
    const auto a = measure_errors(x), b = measure_errors(y);
    CHECK(a.natural_map > 1e-3);
    CHECK(b.natural_map == Approx(a.natural_map).epsilon(1e-10));
    CHECK(b.worst_velocity_violation == Approx(a.worst_velocity_violation * other.velocity()).epsilon(1e-10));
    CHECK(b.worst_spin_violation == Approx(a.worst_spin_violation / other.time).epsilon(1e-10));
}

TEST_CASE("a solution of a coupled problem with rolling rows has no error, another state has", "[multibody]")
{
    const auto problem = coupled_contacts({});
    Iterate x(problem);
    const auto report = solve_projected(x, {.tolerance = 1e-12, .max_sweeps = 20000});
    CHECK(report.converged);
    const auto errors = measure_errors(x);
    CHECK(errors.natural_map < 1e-12);
    CHECK(errors.worst_velocity_violation < 1e-10);
    CHECK(errors.worst_spin_violation < 1e-10);
    CHECK(errors.cone_violation < 1e-14);

    VectorXd wrong = x.impulse();
    wrong[1] = 0.5 * wrong[0]; // outside the cone of μ = 0.4
    wrong[2] = 0.0;
    const auto broken = measure_errors(Iterate(problem, wrong));
    CHECK(broken.natural_map > 0.01);
    CHECK(broken.cone_violation == Approx(0.1 * wrong[0]));
}

TEST_CASE("an unsolved problem that ends without impulses is found to be solved", "[multibody][degenerate]")
{
    // A sphere that leaves the floor, started with an impulse.
    Problem problem;
    problem.add_body(MatrixXd::Identity(1, 1), VectorXd::Constant(1, 1.0));
    problem.add_constraint(
        {.law = Law::unilateral}, {{0, MatrixXd::Identity(1, 1)}}, VectorXd::Zero(1), VectorXd::Zero(1));
    Iterate x(problem, VectorXd::Constant(1, 0.5));
    const auto report = solve_projected(x, {.tolerance = 1e-12, .max_sweeps = 10});
    CHECK(report.converged);
    CHECK(report.sweeps == 2); // the second finds that nothing is left to do
    CHECK(x.impulse()[0] == 0.0);
    CHECK(x.velocity()[0] == Approx(1.0));
}

TEST_CASE("the natural map of one contact, by hand", "[multibody]")
{
    // d = (2, 4, 6): the tangents share the scale 5 and, in the sum, have the normal's weight 2. λ = (1, 0.2, 0), y = D
    // λ
    // + q: z = λ − y/d, its normal clamped, its tangent on the disk of radius 0.5 z_n.
    Problem problem;
    problem.add_body(Eigen::Vector3d(1.0 / 2, 1.0 / 4, 1.0 / 6).asDiagonal(), Eigen::Vector3d::Zero());
    problem.add_constraint({.law = Law::contact, .friction = 0.5}, {{0, MatrixXd::Identity(3, 3)}}, VectorXd::Zero(3),
        Eigen::Vector3d(1.0, -3.0, 0.0));
    const Iterate x(problem, Eigen::Vector3d(1.0, 0.2, 0.0));
    // y = (2 − 1, 0.8 + 3, 0); z = (0.5, 0.2 − 0.76, 0), cut to a tangent of −0.25; δ = (0.5, 0.45, 0)
    const auto errors = measure_errors(x);
    CHECK(errors.natural_map == Approx(std::sqrt((0.5 * 0.5 + 0.45 * 0.45) / (1.0 + 0.2 * 0.2))));
    CHECK(errors.worst_velocity_violation == Approx(5.0 * 0.45));
    CHECK(errors.cone_violation == 0.0);
}

TEST_CASE("over-relaxed contacts stay in their cones", "[multibody][note]")
{
    const auto problem = coupled_contacts({});
    Iterate x(problem);
    ProjectedGaussSeidel<Iterate> algorithm(x, LocalSolve::sequential);
    for (int sweep = 0; sweep < 20; ++sweep) {
        algorithm.sweep(x, {0, 1, 2}, 1.6);
        CHECK(measure_errors(x).cone_violation < 1e-14);
    }
}

TEST_CASE("what has no solution is never called solved", "[multibody][degenerate]")
{
    // Pressed by two platens that close, and two equalities that contradict each other: impulses grow for ever, and an
    // error relative to them falls.
    const auto law = GENERATE(Law::unilateral, Law::equality);
    Problem problem;
    problem.add_body(MatrixXd::Identity(1, 1), VectorXd::Zero(1));
    const MatrixXd up = MatrixXd::Identity(1, 1);
    const VectorXd zero = VectorXd::Zero(1), closing = VectorXd::Ones(1);
    problem.add_constraint({.law = law}, {{0, up}}, zero, closing);
    problem.add_constraint({.law = law}, {{0, -up}}, zero, closing);
    Iterate x(problem);
    const auto report = solve_projected(x, {.tolerance = 1e-3, .max_sweeps = 5000});
    CHECK(report.residual < 1e-3);
    CHECK_FALSE(report.converged);
    CHECK(report.growing);
    CHECK(report.sweeps == 5000);
}

TEST_CASE("a solve that starts from far too much does not stop there", "[multibody][degenerate]")
{
    const auto problem = test::column(std::vector<double>(20, 1.0));
    Iterate x(problem, 1e7 * VectorXd::Ones(20));
    const auto report = solve_projected(x, {.tolerance = 1e-4, .max_sweeps = 100000});
    CHECK(report.converged);
    CHECK(measure_errors(x).natural_map <= 1e-4);
    CHECK(measure_errors(x).natural_map == report.residual);
}

TEST_CASE("a solve that stops at its cap says so", "[multibody]")
{
    const auto problem = coupled_contacts({});
    Iterate x(problem);
    const auto report = solve_projected(x, {.tolerance = 1e-12, .max_sweeps = 2});
    CHECK_FALSE(report.converged);
    CHECK(report.sweeps == 2);
    CHECK(report.residual == measure_errors(x).natural_map);
    CHECK(report.finite);
}
