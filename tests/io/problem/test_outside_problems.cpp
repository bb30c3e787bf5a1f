// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/multibody/algorithm_3_1.hpp"
#include "io/problem/fclib_problem.hpp"
#include "io/text/input_error.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>

using namespace talus;
using namespace talus::multibody;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace
{

/// The nearest point of the Coulomb cone.
Vector3d on_cone(const Vector3d& z, double friction)
{
    const double tangent = z.tail<2>().norm();
    if (tangent <= friction * z[0]) return z;
    if (friction * tangent <= -z[0]) return Vector3d::Zero();
    Vector3d nearest;
    nearest[0] = (z[0] + friction * tangent) / (1.0 + friction * friction);
    nearest.tail<2>() = friction * nearest[0] * z.tail<2>() / tangent;
    return nearest;
}

/// ‖r − P(r − ũ/scale)‖ with ũ = u + μ|u_t| n (de Saxcé).
/// @param scale by row, of which that of the normal is taken
template <class AnyIterate> double de_saxce_map(const AnyIterate& x, const VectorXd& scale)
{
    double change = 0.0;
    VectorXd u(3);
    for (std::size_t k = 0; k < x.constraints().size(); ++k) {
        const Constraint& contact = x.constraints()[k];
        x.residual_of(k, u);
        u[0] += contact.friction * u.tail<2>().norm();
        const Vector3d r = x.impulse().template segment<3>(contact.first_row);
        change += (r - on_cone(r - u / scale[contact.first_row], contact.friction)).squaredNorm();
    }
    return std::sqrt(change);
}

/// Scaled with D_nn and relative to ‖r‖: the measure in which the sweeps below were counted.
template <class AnyIterate> double de_saxce_error(const AnyIterate& x, const DiagonalBlocks& blocks)
{
    return de_saxce_map(x, blocks.scale()) / x.impulse().norm();
}

/// The sweeps after which the error is first at most each of these, as many as the cap allows.
template <class AnyIterate>
std::vector<int> sweeps_needed(AnyIterate x, const std::vector<double>& errors, int cap, LocalSolve local)
{
    ProjectedGaussSeidel<AnyIterate> algorithm(x, local);
    const DiagonalBlocks blocks(x, LocalSolve::sequential);
    Traversal natural(Order::natural, x.constraints().size(), 0);
    std::vector<int> needed;
    for (int sweeps = 1; sweeps <= cap && needed.size() < errors.size(); ++sweeps) {
        algorithm.sweep(x, natural.next());
        while (needed.size() < errors.size() && de_saxce_error(x, blocks) <= errors[needed.size()])
            needed.push_back(sweeps);
    }
    return needed;
}

std::filesystem::path data(const std::string& name)
{
    return std::filesystem::path(TALUS_SOURCE_DIR) / "tests/data/fclib" / name;
}

std::vector<int> sweeps_needed(
    const std::string& name, const std::vector<double>& errors, int cap, LocalSolve local = LocalSolve::sequential)
{
    const auto file = read_fclib(data(name));
    if (file.form == FclibForm::local) {
        const auto problem = assembled(file, name);
        return sweeps_needed(AssembledIterate(problem), errors, cap, local);
    }
    const auto bodies = with_bodies(file, name);
    return sweeps_needed(Iterate(bodies.problem), errors, cap, local);
}

const auto spheres = "Spheres-i099-356-679.hdf5";
const auto spheres_in_a_box = "spheres-in-a-box-98-i10000-256-10.hdf5";
const auto capsules = "Capsules-i122-1617.hdf5";
const auto polyhedra = "LMGC_100_PR_PerioBox-i00361-60-03000.hdf5";
const auto boxes = "local_problem_test.hdf5";
const auto confeti = "Confeti-ex13.hdf5";

} // namespace

TEST_CASE("outside problems: the sequential local solve gets as far as another implementation, in as many sweeps",
    "[multibody]")
{
    // Counts of our own earlier implementation of the same rule, written apart from this one. Where it did not get to
    // the next error in 20 000 sweeps, the row ends.
    struct Row {
        std::string name;
        std::vector<double> errors;
        std::vector<int> sweeps;
    };
    const auto row = GENERATE(values<Row>(
        {{spheres, {1e-2, 1e-4, 1e-6, 1e-8}, {23, 90, 160, 230}}, {spheres_in_a_box, {1e-2, 1e-4}, {20, 750}},
            {capsules, {1e-2, 1e-4}, {10, 750}}, {polyhedra, {1e-2, 1e-4, 1e-6, 1e-8}, {14, 200, 970, 1950}},
            {boxes, {1e-2, 1e-4}, {36, 740}}, {confeti, {1e-2, 1e-4, 1e-6, 1e-8}, {5, 22, 35, 48}}}));
    CAPTURE(row.name);
    const auto needed = sweeps_needed(row.name, row.errors, 2500);
    REQUIRE(needed.size() == row.sweeps.size());
    for (std::size_t i = 0; i < needed.size(); ++i) CHECK(needed[i] <= std::lround(1.2 * row.sweeps[i]));
}

TEST_CASE("outside problems: (18)-(19) and (20)-(21) stall where blocks are coupled", "[multibody][note]")
{
    struct Row {
        std::string name;
        double error;
        bool by_block, along_sliding; ///< whether they get there
    };
    const auto row = GENERATE(values<Row>({{spheres, 1e-4, false, true}, {spheres_in_a_box, 1e-2, false, true},
        {spheres_in_a_box, 1e-4, false, false}, {capsules, 1e-2, false, false}, {confeti, 1e-2, false, true},
        {confeti, 1e-4, false, false}, {polyhedra, 1e-4, true, true}, {boxes, 1e-4, true, true}}));
    CAPTURE(row.name, row.error);
    CHECK(sweeps_needed(row.name, {row.error}, 1000, LocalSolve::block).size() == (row.by_block ? 1u : 0u));
    CHECK(sweeps_needed(row.name, {row.error}, 1000, LocalSolve::sliding).size() == (row.along_sliding ? 1u : 0u));
}

TEST_CASE("an error that adds velocities to impulses may look small where the solution is useless", "[multibody]")
{
    // Acary, Brémond & Huber 2017: ‖r − P(r − ũ)‖/‖q‖, in which a change of units changes everything.
    const auto file = read_fclib(data(confeti));
    const auto problem = assembled(file, confeti);
    AssembledIterate x(problem);
    solve_projected(x, {.tolerance = 0.0, .max_sweeps = 1000, .local = LocalSolve::block});
    CHECK(de_saxce_map(x, VectorXd::Ones(problem.target.size())) /
              std::max({file.q.norm(), x.impulse().norm(), (file.W * x.impulse() + file.q).norm()}) <
          1e-4);
    CHECK(measure_errors(x).natural_map > 0.5);
    CHECK(measure_errors(x).worst_velocity_violation > 500.0);
}

TEST_CASE("the chute, with rolling rows, is solved", "[multibody]")
{
    const auto file = read_fclib(data("Chute-ndof-768-nc-4-3.hdf5"));
    const auto bodies = with_bodies(file, "chute");
    Iterate x(bodies.problem);
    const auto report = solve_projected(x, {.tolerance = 1e-12, .max_sweeps = 100});
    CHECK(report.converged);
    const auto errors = measure_errors(x);
    CHECK(errors.worst_velocity_violation < 1e-12);
    CHECK(errors.worst_spin_violation < 1e-10);
    CHECK(errors.cone_violation < 1e-12 * x.impulse().norm());

    // The file's own words: M v = H r + f, u = Hᵀ v + w, and a contact that is loaded has no normal velocity.
    const VectorXd v = bodies.in_order_of_matrices(x.velocity());
    CHECK((file.M * v - file.H * x.impulse() - file.f).norm() < 1e-12 * file.f.norm());
    const VectorXd u = file.H.transpose() * v + file.w;
    for (Eigen::Index k = 0; k < file.contacts(); ++k) CHECK(std::abs(std::min(u[5 * k], x.impulse()[5 * k])) < 1e-12);
}

TEST_CASE("a global problem and its assembled twin take the same way", "[multibody][oracle]")
{
    const auto file = read_fclib(data(spheres_in_a_box));
    const auto bodies = with_bodies(file, spheres_in_a_box);
    const auto twin = assemble(bodies.problem);
    Iterate x(bodies.problem);
    AssembledIterate y(twin);
    const SolveSettings some{.tolerance = 0.0, .max_sweeps = 20};
    solve_projected(x, some);
    solve_projected(y, some);
    CHECK((x.impulse() - y.impulse()).norm() < 1e-10 * x.impulse().norm());
}

TEST_CASE("contacts in the plane, and contacts that nothing can answer, are refused with a sentence", "[fclib][errors]")
{
    FclibProblem file;
    file.rows_per_contact = 2;
    file.W = Eigen::MatrixXd::Identity(2, 2).sparseView();
    file.q = VectorXd::Zero(2);
    file.mu = VectorXd::Ones(1);
    CHECK_THROWS_WITH(assembled(file, "p.hdf5"),
        "p.hdf5: a problem in the plane, with two rows a contact; only those in space are solved");
    file.rows_per_contact = 3;
    file.q = VectorXd::Zero(3);
    file.W = Vector3d(1.0, 1.0, -1.0).asDiagonal().toDenseMatrix().sparseView();
    CHECK_THROWS_WITH(assembled(file, "p.hdf5"), "p.hdf5: contact 0: the diagonal of W is negative");
    file.W = Vector3d(0.0, 1.0, 1.0).asDiagonal().toDenseMatrix().sparseView();
    CHECK_THROWS_WITH(assembled(file, "p.hdf5"),
        "p.hdf5: contact 0: its reaction changes no velocity of its own; do its bodies move at all?");
    file.W = Vector3d(1.0, 1.0, 0.0).asDiagonal().toDenseMatrix().sparseView(); // a slider with one tangent
    CHECK_NOTHROW(assembled(file, "p.hdf5"));
}

TEST_CASE("matrices that are no masses are refused with a sentence", "[fclib][errors]")
{
    FclibProblem file;
    file.form = FclibForm::global;
    const int dofs = 2000;
    file.M.resize(dofs, dofs);
    for (int i = 0; i < dofs; ++i) file.M.insert(i, i) = 1.0;
    file.H.resize(dofs, 3);
    for (int i = 0; i < 3; ++i) file.H.insert(i, i) = 1.0;
    file.f = VectorXd::Zero(dofs);
    file.w = VectorXd::Zero(3);
    file.mu = VectorXd::Ones(1);
    const auto refused = [&](const FclibProblem& broken) -> std::string {
        try {
            with_bodies(broken, "p.hdf5");
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    CHECK(refused(file).empty());

    FclibProblem broken = file;
    broken.M.coeffRef(7, 7) = -1.0;
    CHECK(refused(broken) == "p.hdf5: the mass matrix is not positive definite (block of row 7)");
    broken = file;
    broken.M.insert(4, 3) = 0.5;
    CHECK(refused(broken) == "p.hdf5: the mass matrix is not symmetric (block of row 3)");
    broken = file;
    broken.H.coeffRef(0, 0) = 0.0;
    CHECK(refused(broken) ==
          "p.hdf5: contact 0: its reaction changes no velocity of its own; do its bodies move at all?");
    broken = file; // a chain through all of them: a dense block would have a million entries and more
    for (int i = 1; i < dofs; ++i) broken.M.insert(i, i - 1) = broken.M.insert(i - 1, i) = 0.1;
    CHECK(refused(broken) ==
          "p.hdf5: the mass matrix couples too many degrees of freedom with each other: its blocks are taken as dense");
}

TEST_CASE("what is written in FCLIB's words comes back as the same problem, compliance and all", "[multibody][fclib]")
{
    Problem problem;
    for (const double mass : {1.0, 2.0})
        problem.add_body(mass * Eigen::MatrixXd::Identity(3, 3), mass * Vector3d(0.3, -0.2, -1.0));
    const Eigen::MatrixXd rows = (Eigen::MatrixXd(3, 3) << 0, 0, 1, 1, 0, 0, 0, 1, 0).finished();
    const Constraint law{.law = Law::contact, .friction = 0.3};
    problem.add_constraint(law, {{0, rows}}, Vector3d(0.2, 0.0, 0.0), Vector3d(0.1, 0.0, 0.05));
    problem.add_constraint(law, {{1, rows}, {0, -rows}}, Vector3d::Zero(), Vector3d::Zero());
    Iterate x(problem);
    const SolveSettings some{.tolerance = 0.0, .max_sweeps = 7};
    solve_projected(x, some);

    const auto file = to_fclib(problem, x.impulse());
    REQUIRE(file.guesses.size() == 1);
    const auto again = with_bodies(file, "again");
    Iterate y(again.problem);
    solve_projected(y, some);
    CHECK((y.impulse() - file.guesses[0].r).norm() < 1e-14);
    CHECK((again.in_order_of_matrices(y.velocity()).head(6) - x.velocity()).norm() < 1e-14);
}

TEST_CASE("a contact that parts no faster than it may does so as it is read back", "[multibody][fclib]")
{
    // A ball on a spring that would part with 0.5 m/s, and asks for 0.2 m/s; what falls on it takes it further down,
    // until it is as soft as the spring.
    for (const double fall : {0.0, 0.4, 3.0}) {
        CAPTURE(fall);
        Problem problem;
        for (const double velocity : {0.0, -fall})
            problem.add_body(Eigen::MatrixXd::Identity(3, 3), Vector3d(0.3, -0.2, velocity));
        const Eigen::MatrixXd rows = (Eigen::MatrixXd(3, 3) << 0, 0, 1, 1, 0, 0, 0, 1, 0).finished();
        const Constraint spring{.law = Law::contact, .friction = 0.3, .headroom = -0.3, .compliance = 0.5};
        const Constraint rigid{.law = Law::contact, .friction = 0.3, .headroom = -0.1}; // asks for −0.1 m/s
        problem.add_constraint(spring, {{0, rows}}, Vector3d(0.5, 0.0, 0.0), Vector3d(0.5, 0.0, 0.0));
        problem.add_constraint(rigid, {{1, rows}, {0, -rows}}, Vector3d::Zero(), Vector3d::Zero());
        Iterate x(problem);
        const SolveSettings exact{.tolerance = 1e-14, .max_sweeps = 10000};
        REQUIRE(solve_projected(x, exact).converged);
        const double u = x.velocity()[2];
        CHECK(u == Approx(std::min(0.2, 0.5 - 0.5 * x.impulse()[0])));

        const auto file = to_fclib(problem, x.impulse());
        REQUIRE(file.contacts() == 3);
        const auto again = with_bodies(file, "again");
        Iterate y(again.problem);
        REQUIRE(solve_projected(y, exact).converged);
        CHECK((again.in_order_of_matrices(y.velocity()).head(6) - x.velocity()).norm() < 1e-10);
        CHECK((y.impulse() - file.guesses[0].r).norm() < 1e-10);
    }
}
