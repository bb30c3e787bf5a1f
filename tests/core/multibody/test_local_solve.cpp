// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/multibody/local_solve.hpp"
#include "tests/support/multibody.hpp"

#include <catch2/catch.hpp>

#include <Eigen/LU>

using namespace talus;
using namespace talus::multibody;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

namespace
{

const auto all_local_solves = {LocalSolve::block, LocalSolve::sliding, LocalSolve::scalar, LocalSolve::sequential};

Constraint contact(double friction, double rolling_reach = 0.0, Eigen::Index rows = 3)
{
    return {.law = Law::contact, .rows = rows, .friction = friction, .rolling_reach = rolling_reach};
}

/// The impulse that solves y = D z + b alone, from λ = 0 on.
VectorXd solved(LocalSolve how, const Constraint& constraint, const MatrixXd& D, const VectorXd& b, int passes = 1,
    double omega = 1.0)
{
    BlockStore store;
    store.add(D);
    store.add(D.inverse());
    VectorXd z = VectorXd::Zero(b.size());
    for (int pass = 0; pass < passes; ++pass) {
        VectorXd y = D * z + b;
        solve_locally(how, {constraint, store[0], store[1], omega}, y, z);
    }
    return z;
}

/// A symmetric positive definite block, its rows coupled more the larger the number.
MatrixXd coupled_block(Random& random, double coupling, Eigen::Index rows = 3)
{
    const MatrixXd root = test::random_matrix(random, rows, rows);
    return MatrixXd::Identity(rows, rows) + coupling * root * root.transpose();
}

} // namespace

TEST_CASE("projection tests against μ² z₁², not μ z₁²", "[multibody][note]")
{
    const auto projected = [](double friction, const VectorXd& impulse) {
        VectorXd z = impulse;
        project(contact(friction), z);
        return z;
    };
    // As written, μ < 1 would let |z_t| = 0.4 z₁ pass, and μ > 1 would scale 3 z₁ up to 4 z₁.
    CHECK(projected(0.25, Eigen::Vector3d(1.0, 0.4, 0.0)).isApprox(Eigen::Vector3d(1.0, 0.25, 0.0)));
    CHECK(projected(4.0, Eigen::Vector3d(1.0, 0.0, 3.0)) == Eigen::Vector3d(1.0, 0.0, 3.0));
    CHECK(projected(0.5, Eigen::Vector3d(0.0, 0.0, 0.0)) == Eigen::Vector3d::Zero()); // t = 0 in (19)
    CHECK(projected(0.0, Eigen::Vector3d(2.0, 1.0, 0.0)) == Eigen::Vector3d(2.0, 0.0, 0.0));
    CHECK(projected(0.5, Eigen::Vector3d(-1.0, 1.0, 0.0)) == Eigen::Vector3d::Zero());
}

TEST_CASE("where D is diagonal with equal tangents all local solves are the exact one, relaxed that of D/ω",
    "[multibody][note]")
{
    const double omega = GENERATE(1.0, 0.7, 1.3);
    Random random(3);
    for (int k = 0; k < 200; ++k) {
        const double normal = 0.2 + uniform(random), tangent = 0.2 + uniform(random);
        const MatrixXd D = Eigen::Vector3d(normal, tangent, tangent).asDiagonal();
        const VectorXd b = test::random_matrix(random, 3, 1);
        const double friction = uniform(random);
        const double z_n = std::max(0.0, -omega * b[0] / normal);
        Vector2d z_t = -omega * b.tail<2>() / tangent;
        if (z_t.norm() > friction * z_n) z_t *= friction * z_n / z_t.norm();
        for (const auto how : all_local_solves) {
            const VectorXd z = solved(how, contact(friction), D, b, 1, omega);
            CHECK(z[0] == Approx(z_n).margin(1e-14));
            CHECK((z.tail<2>() - z_t).norm() < 1e-14);
        }
    }
}

TEST_CASE("tangent on a disk obeys Coulomb's law, coupled or not, symmetric or not", "[multibody]")
{
    Random random(5);
    const double skew = GENERATE(0.0, 0.01, 1.0); // outside problems have blocks that are not quite symmetric
    int sliding = 0;
    for (int k = 0; k < 1000; ++k) {
        Eigen::Matrix2d D = coupled_block(random, 3.0, 2);
        D(0, 1) += skew;
        D(1, 0) -= skew;
        const Vector2d b = test::random_matrix(random, 2, 1);
        const double radius = 0.5 * uniform(random);
        const Vector2d z = solve_on_disk(D, b, radius);
        const Vector2d slip = D * z + b;
        if (z.norm() < radius * (1.0 - 1e-12)) {
            CHECK(slip.norm() < 1e-13);
        } else {
            ++sliding;
            CHECK(z.norm() == Approx(radius).epsilon(1e-12));
            CHECK(slip.dot(z) + slip.norm() * z.norm() < 1e-12 * radius); // against the slip
        }
    }
    CHECK(sliding > 300);
}

TEST_CASE("tangent on a disk where the block is singular or the disk next to nothing", "[multibody][degenerate]")
{
    const Eigen::Matrix2d parallel = Eigen::Matrix2d::Ones(); // both tangents are the same
    CHECK(solve_on_disk(Eigen::Matrix2d::Identity(), Vector2d(1, 1), 0.0) == Vector2d::Zero());
    CHECK(solve_on_disk(parallel, Vector2d::Zero(), 1.0) == Vector2d::Zero());
    for (const Vector2d& b : {Vector2d(1.0, 1.0), Vector2d(1.0, -1.0), Vector2d(1.0, 0.3)})
        for (const double radius : {1e-312, 1e-3, 0.3, 10.0}) {
            CAPTURE(b, radius);
            const Vector2d z = solve_on_disk(parallel, b, radius);
            const Vector2d slip = parallel * z + b;
            CHECK(z.norm() <= radius * (1.0 + 1e-12));
            CHECK(slip.dot(z) + slip.norm() * z.norm() < 1e-10 * std::max(radius, z.norm()));
        }
}

TEST_CASE("what the sequential solve leaves as it is obeys the law in coupled blocks too", "[multibody]")
{
    // For μ small enough the passes settle; then y_n, z_n and the disk hold at once.
    Random random(7);
    for (int k = 0; k < 200; ++k) {
        const MatrixXd D = coupled_block(random, 0.5, 5);
        const VectorXd b = test::random_matrix(random, 5, 1);
        const auto constraint = contact(0.3, 0.2, 5);
        const VectorXd z = solved(LocalSolve::sequential, constraint, D, b, 500);
        const VectorXd y = D * z + b;
        CHECK(cone_violation(constraint, z) < 1e-14);
        CHECK(std::abs(std::min(z[0], y[0])) < 1e-10);
        const auto opposes = [&](Eigen::Index first, double limit) {
            const Vector2d part = z.segment<2>(first), slip = y.segment<2>(first);
            if (part.norm() < limit * (1.0 - 1e-9)) return slip.norm() < 1e-10;
            return std::abs(slip.dot(part) + slip.norm() * part.norm()) < 1e-10;
        };
        CHECK(opposes(1, 0.3 * z[0]));
        CHECK(opposes(3, 0.2 * z[0]));
    }
}

TEST_CASE("(18)-(19) and (20)-(21) do not obey Coulomb's law in coupled blocks", "[multibody][note]")
{
    // Slides along (18)'s tangent: (19) leaves the normal velocity nonzero, (20)–(21) mends that, but its direction is
    // that of sticking, not that of slip.
    const MatrixXd D = (MatrixXd(3, 3) << 1.0, 0.4, 0.0, 0.4, 2.0, 0.5, 0.0, 0.5, 1.0).finished();
    const VectorXd b = Eigen::Vector3d(-1.0, 2.0, 0.5);
    const auto velocity = [&](LocalSolve how) -> VectorXd { return D * solved(how, contact(0.3), D, b, 500) + b; };
    CHECK(std::abs(velocity(LocalSolve::block)[0]) > 0.1);
    CHECK(std::abs(velocity(LocalSolve::sliding)[0]) < 1e-12);
    CHECK(std::abs(velocity(LocalSolve::sequential)[0]) < 1e-12);

    const auto out_of_line = [&](LocalSolve how) {
        const VectorXd z = solved(how, contact(0.3), D, b, 500);
        const Vector2d slip = (D * z + b).tail<2>().normalized(), friction = z.tail<2>().normalized();
        return (slip + friction).norm();
    };
    CHECK(out_of_line(LocalSolve::sliding) > 0.05);
    CHECK(out_of_line(LocalSolve::sequential) < 1e-10);
}

TEST_CASE("the sign of (18)'s normal impulse does not tell whether a coupled contact closes", "[multibody][note]")
{
    // Left alone the contact closes, b_n < 0; to stick it would have to be pulled, z₁ < 0 in (18). It slides.
    const MatrixXd D = (MatrixXd(3, 3) << 1.0, 0.9, 0.0, 0.9, 1.0, 0.0, 0.0, 0.0, 1.0).finished();
    const VectorXd b = Eigen::Vector3d(-0.1, -1.0, 0.0);
    REQUIRE((-D.inverse() * b)[0] < 0.0);
    const auto normal_velocity = [&](LocalSolve how) { return (D * solved(how, contact(0.2), D, b, 500) + b)[0]; };
    CHECK(normal_velocity(LocalSolve::block) == b[0]); // goes on to close
    CHECK(std::abs(normal_velocity(LocalSolve::sequential)) < 1e-12);
}

TEST_CASE(
    "(20)-(21) with rolling rows: what sticks keeps its part of (18), what slides follows z_1", "[multibody][note]")
{
    // Tangent slides along (1, 0), rolling sticks; d_12 = 0.2, d_14 = 0.3. By hand: (18) gives z; then
    // z_1 (1 + 0.3 · 0.2) = −(b_1 + 0.3 z_4).
    MatrixXd D = MatrixXd::Identity(5, 5);
    D(0, 1) = D(1, 0) = 0.2;
    D(0, 3) = D(3, 0) = 0.3;
    const VectorXd b = (VectorXd(5) << -1.0, -2.0, 0.0, 0.1, 0.0).finished();
    const VectorXd sticking = -D.inverse() * b;
    const auto constraint = contact(0.3, 10.0, 5);
    REQUIRE(sticking[1] > 0.3 * sticking[0]);
    const VectorXd z = solved(LocalSolve::sliding, constraint, D, b);
    CHECK(z[0] == Approx((1.0 - 0.3 * sticking[3]) / 1.06));
    CHECK(z[1] == Approx(0.3 * z[0]));
    CHECK(z[3] == Approx(sticking[3]));
}

TEST_CASE("one pass of the sequential solve, by hand", "[multibody]")
{
    // Normal −b_1/d_11; its change enters the tangent, and the tangent's the rolling row.
    MatrixXd D = MatrixXd::Identity(5, 5);
    D(0, 1) = D(1, 0) = 0.5;
    D(1, 3) = D(3, 1) = 0.25;
    const VectorXd b = (VectorXd(5) << -2.0, 0.4, 0.0, 0.1, 0.0).finished();
    const VectorXd z = solved(LocalSolve::sequential, contact(10.0, 10.0, 5), D, b);
    CHECK(z[0] == Approx(2.0));
    CHECK(z[1] == Approx(-(0.4 + 0.5 * 2.0)));
    CHECK(z[3] == Approx(-(0.1 + 0.25 * z[1])));
}

TEST_CASE("(21) falls back on (19) where its denominator is not positive", "[multibody][note]")
{
    // d₁₁ + μ d₁₂ w₁ < 0: a rod that jams, Painlevé 1895.
    const MatrixXd D = (MatrixXd(3, 3) << 1.0, -1.2, 0.0, -1.2, 2.0, 0.0, 0.0, 0.0, 1.0).finished();
    const VectorXd b = Eigen::Vector3d(0.8, -2.0, 0.0);
    const auto jammed = contact(1.0);
    REQUIRE(D(0, 0) + jammed.friction * D(0, 1) < 0.0);
    const VectorXd sticking = -D.inverse() * b;
    REQUIRE(sticking[1] > jammed.friction * sticking[0]); // it slides, w = (1, 0)
    const VectorXd z = solved(LocalSolve::sliding, jammed, D, b);
    CHECK(z == solved(LocalSolve::block, jammed, D, b));
    CHECK(z[0] > 0.0);
}

TEST_CASE("a constraint that nothing can answer is left alone", "[multibody][degenerate]")
{
    const MatrixXd nothing = MatrixXd::Zero(3, 3);
    BlockStore store;
    store.add(nothing);
    store.add(nothing); // the pseudo-inverse
    for (const auto how : all_local_solves) {
        VectorXd y = Eigen::Vector3d(-1.0, 0.5, 0.0), z = VectorXd::Zero(3);
        const auto constraint = contact(0.5);
        solve_locally(how, {constraint, store[0], store[1]}, y, z);
        CHECK(z == VectorXd::Zero(3));
    }
}
