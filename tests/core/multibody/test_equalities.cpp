// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/multibody/algorithm_2_1.hpp"
#include "core/multibody/algorithm_2_2.hpp"
#include "core/multibody/algorithm_3_1.hpp"
#include "tests/support/direct_solution.hpp"
#include "tests/support/multibody.hpp"

#include <catch2/catch.hpp>

using namespace talus;
using namespace talus::multibody;
using test::random_equalities;
using test::RandomShape;

namespace
{

/// As exact as sweeps get.
SolveSettings exact(double omega = 1.0, Order order = Order::natural)
{
    return {.tolerance = 1e-14, .max_sweeps = 20000, .omega = {omega}, .order = order};
}

double difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b)
{
    return (a - b).norm() / b.norm();
}

} // namespace

TEST_CASE("Algorithms 2.1, 2.2 and 3.1 and the direct solution agree on equalities", "[multibody][oracle]")
{
    const int bodies = GENERATE(1, 4, 30);
    const int constraints = GENERATE(1, 6, 40);
    const Eigen::Index most_rows = GENERATE(1, 3, 7);
    const int bodies_of_constraint = GENERATE(1, 2, 4);
    const auto problem = random_equalities({bodies, constraints, most_rows, bodies_of_constraint, 0.5}, 17);
    CAPTURE(bodies, constraints, most_rows, bodies_of_constraint);

    const auto direct = test::solve_sparse(problem);
    const auto dense = test::solve_dense(problem);
    CHECK(difference(direct.velocity, dense.velocity) < 1e-12);
    CHECK(difference(direct.impulse, dense.impulse) < 1e-12);

    Iterate by_2_1(problem), by_2_2(problem), by_3_1(problem);
    solve_with_residual_update(by_2_1, exact());
    solve_with_local_residual(by_2_2, exact());
    solve_projected(by_3_1, exact());
    for (const Iterate* x : {&by_2_1, &by_2_2, &by_3_1}) {
        CHECK(difference(x->velocity(), direct.velocity) < 1e-12);
        CHECK(difference(x->impulse(), direct.impulse) < 1e-12);
    }
}

TEST_CASE("rank-deficient equalities: the velocities are those of the direct solution", "[multibody][oracle]")
{
    // Rigid, each equality is there twice (and so consistent): rank at most half of the rows.
    const int bodies = GENERATE(6, 12);
    const auto once = random_equalities({bodies, bodies / 2, 2, 2, 0.0}, 5);
    Problem twice;
    for (std::size_t b = 0; b < once.body_count(); ++b)
        twice.add_body(once.mass(b), once.mass(b) * once.dofs_of(b, once.free_velocity()));
    for (int copy = 0; copy < 2; ++copy)
        for (std::size_t k = 0; k < once.constraints().size(); ++k) {
            std::vector<BodyRows> rows;
            for (std::size_t i = once.first_block(k); i < once.first_block(k + 1); ++i)
                rows.push_back({once.body_of_block(i), once.jacobian(i)});
            const auto size = once.constraints()[k].rows;
            twice.add_constraint(
                {.law = Law::equality}, rows, Eigen::VectorXd::Zero(size), once.rows_of(k, once.target()));
        }

    const auto direct = test::solve_dense(twice);
    CHECK(difference(direct.velocity, test::solve_sparse(once).velocity) < 1e-11);
    Iterate by_2_1(twice), by_2_2(twice);
    solve_with_residual_update(by_2_1, exact());
    solve_with_local_residual(by_2_2, exact());
    CHECK(difference(by_2_1.velocity(), direct.velocity) < 1e-12);
    CHECK(difference(by_2_2.velocity(), direct.velocity) < 1e-12);
}

TEST_CASE("rows that depend on each other within one block have a pseudo-inverse", "[multibody][degenerate]")
{
    // Eight rows on six degrees of freedom, rigid, and consistent: D_kk has rank six.
    Random random(2);
    const Eigen::MatrixXd rows = test::random_matrix(random, 8, 6);
    Problem problem;
    problem.add_body(2.0 * Eigen::MatrixXd::Identity(6, 6), test::random_matrix(random, 6, 1));
    const Eigen::VectorXd velocity = test::random_matrix(random, 6, 1);
    problem.add_constraint({.law = Law::equality}, {{0, rows}}, Eigen::VectorXd::Zero(8), rows * velocity);
    for (const auto solve : {+[](Iterate& x) { return solve_with_residual_update(x, exact()); },
             +[](Iterate& x) -> IterationReport { return solve_with_local_residual(x, exact()); },
             +[](Iterate& x) { return solve_projected(x, exact()); }}) {
        Iterate x(problem);
        solve(x);
        CHECK(difference(x.velocity(), velocity) < 1e-12);
    }
}

TEST_CASE("the order of traversal and the relaxation change the way, not the solution", "[multibody]")
{
    const auto problem = random_equalities({8, 12, 3, 2, 0.3}, 3);
    const auto direct = test::solve_sparse(problem);
    const auto order = GENERATE(Order::natural, Order::reversed, Order::symmetric, Order::shuffled);
    const double omega = GENERATE(0.7, 1.0, 1.3);
    Iterate by_2_1(problem), by_2_2(problem), by_3_1(problem);
    solve_with_residual_update(by_2_1, exact(omega, order));
    solve_with_local_residual(by_2_2, exact(omega, order));
    solve_projected(by_3_1, exact(omega, order));
    for (const Iterate* x : {&by_2_1, &by_2_2, &by_3_1}) CHECK(difference(x->velocity(), direct.velocity) < 1e-12);
}

TEST_CASE("a warm start has the velocities that belong to its impulses", "[multibody][note]")
{
    // The note sets λ = λ⁰ but leaves v = v⁽¹⁾: its residual is then off by G M⁻¹ Gᵀ λ⁰ for ever.
    const auto problem = random_equalities({5, 6, 3, 2, 0.4}, 8);
    const auto direct = test::solve_sparse(problem);
    Iterate started_there(problem, direct.impulse);
    CHECK(difference(started_there.velocity(), direct.velocity) < 1e-12);
    CHECK(measure_errors(started_there).natural_map < 1e-12);

    Iterate as_in_note(problem, direct.impulse);
    as_in_note.velocity() = problem.free_velocity();
    solve_with_local_residual(as_in_note, exact());
    CHECK(difference(as_in_note.velocity(), direct.velocity) > 0.1);
}

TEST_CASE("the note's running error is not the residual; the drop of energy is", "[multibody][note]")
{
    const auto problem = random_equalities({8, 14, 3, 2, 0.1}, 21);
    const auto direct = test::solve_sparse(problem);
    const double omega = GENERATE(1.0, 1.4);
    const auto energy_error = [&](const Iterate& x) {
        const Eigen::VectorXd d = x.impulse() - direct.impulse;
        return 0.5 * d.dot(schur_times(problem, d));
    };
    const auto squared_residual = [&](const Iterate& x) {
        double sum = 0.0;
        for (std::size_t k = 0; k < x.constraints().size(); ++k) {
            Eigen::VectorXd r(x.constraints()[k].rows);
            x.residual_of(k, r);
            sum += r.squaredNorm();
        }
        return sum;
    };

    Iterate x(problem);
    const double before = energy_error(x);
    const auto one = solve_with_local_residual(x, {.tolerance = 0.0, .max_sweeps = 1, .omega = {omega}});
    CHECK(one.running_error.energy_drop == Approx(before - energy_error(x)).epsilon(1e-10));
    CHECK(one.running_error.of_note != Approx(squared_residual(x)).epsilon(0.1));

    Iterate later(problem);
    const auto forty = solve_with_local_residual(later, {.tolerance = 0.0, .max_sweeps = 40, .omega = {1.0}});
    CHECK(forty.running_error.energy_left() == Approx(energy_error(later)).epsilon(0.1));
}

TEST_CASE("the note's running error becomes negative on a column", "[multibody][note]")
{
    // Before the first sweep only the floor's contact has a residual; on their way up the others get theirs.
    const auto problem = test::column({1.0, 1.0, 1.0, 1.0}, Law::equality);
    Iterate x(problem);
    const auto report = solve_with_local_residual(x, {.tolerance = 0.0, .max_sweeps = 1});
    CHECK(report.running_error.of_note == Approx(1.0 - (1.0 + 1.0 + 1.0 / 4 + 1.0 / 16)));
}

TEST_CASE("S x without S, assembled, and dense", "[multibody][oracle]")
{
    const auto problem = random_equalities({9, 11, 4, 3, 0.2}, 4);
    Random random(1);
    const Eigen::VectorXd x = test::random_matrix(random, problem.rows(), 1);
    const auto assembled = assemble(problem);
    CHECK(difference(schur_times(problem, x), assembled.schur * x) < 1e-14);
    const Eigen::MatrixXd dense(assembled.schur);
    CHECK((dense - dense.transpose()).norm() < 1e-13);

    // (4): S λ = q − G v⁽¹⁾
    const auto direct = test::solve_dense(problem);
    CHECK(difference(assembled.schur * direct.impulse, assembled.target) < 1e-12);

    // One sweep from the rows of S does what one by way of the velocities does.
    Iterate by_bodies(problem);
    AssembledIterate by_rows(assembled);
    const SolveSettings three{.tolerance = 0.0, .max_sweeps = 3};
    solve_projected(by_bodies, three);
    solve_projected(by_rows, three);
    CHECK(difference(by_rows.impulse(), by_bodies.impulse()) < 1e-12);
}
