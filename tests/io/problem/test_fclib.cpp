// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/problem/fclib.hpp"
#include "tests/io/scene_folder.hpp"

#include <catch2/catch.hpp>

using namespace talus;
using namespace talus::test;
using Eigen::Index;
using Eigen::VectorXd;

namespace
{

using Sparse = Eigen::SparseMatrix<double>;

std::filesystem::path data_file(const std::string& name)
{
    return std::filesystem::path(TALUS_SOURCE_DIR) / "tests/data/fclib" / name;
}

// What h5py and numpy find in a file of tests/data/fclib.

struct KnownMatrix {
    Index rows, columns, entries;
    double moment; ///< Σ (row + 1) (2 column + 1) value: another one if rows and columns were exchanged
};

struct KnownFile {
    const char* name;
    FclibForm form;
    int rows_per_contact;
    Index contacts;
    const char* title;
    std::size_t description;   ///< its length
    KnownMatrix first, second; ///< W and none; or M and H
    double sum_q_or_f, sum_w, sum_mu, last_mu;
    std::size_t guesses;
    double sum_u; ///< of the solution
};

const std::vector<KnownFile> known_files = {
    {"Capsules-i122-1617.hdf5", FclibForm::local, 3, 296, "Capsules", 48, {888, 888, 12420, 1807080298.2954118}, {},
        14.791756862984863, 0, 207.2, 0.7, 0, 0},
    {"Chute-ndof-768-nc-4-3.hdf5", FclibForm::global_rolling, 5, 4, "Chute with rolling friction", 169,
        {768, 768, 1536, 105208762.51675555}, {768, 20, 91, 6209.1506134822503}, -130.45057544210391,
        3.9357063531093172e-06, 4, 1, 0, 0.98008290643737261},
    {"Confeti-ex13.hdf5", FclibForm::local, 3, 107, "Confeti", 48, {321, 321, 17949, 3673.7085004402434}, {},
        -2623.614089343735, 0, 4.28, 0.04, 0, 0},
    {"LMGC_100_PR_PerioBox-i00361-60-03000.hdf5", FclibForm::local, 3, 60, "LMGC dump in hdf5", 84,
        {180, 180, 9576, 160.82929110933389}, {}, -2.6778908434310145, 0, 21.2, 0.3, 0, 0},
    {"Spheres-i099-356-679.hdf5", FclibForm::global, 3, 356, "Spheres Tower", 171,
        {12000, 12000, 12000, 688765379721.10278}, {12000, 1068, 9110, -4854466662.1569653}, -18170.697367342396, 0,
        249.2, 0.7, 1, 0.18743904030633463},
    {"local_problem_test.hdf5", FclibForm::local, 3, 48, "Boxes Stack", 168, {144, 144, 4896, 2780189579.7221017}, {},
        -0.019619983933013275, 0, 33.6, 0.7, 1, 2.9812371810700124e-07},
    {"spheres-in-a-box-98-i10000-256-10.hdf5", FclibForm::global, 3, 256, "SpheresBox", 313,
        {588, 588, 588, 3868.555906444702}, {588, 768, 7046, -4615381.2406072877}, -5.0751165603013327e-05, 0, 25.6,
        0.1, 1, 0.0050982634913306381},
};

/// Sums in another order differ by rounding: 1e-11 of the largest term is far above it, far below any wrong entry.
Approx about(double value)
{
    return Approx(value).epsilon(1e-11).margin(1e-18);
}

void check_matrix(const Sparse& matrix, const KnownMatrix& known)
{
    CHECK(matrix.rows() == known.rows);
    CHECK(matrix.cols() == known.columns);
    CHECK(matrix.nonZeros() == known.entries);
    double moment = 0.0;
    for (int column = 0; column < matrix.outerSize(); ++column)
        for (Sparse::InnerIterator entry(matrix, column); entry; ++entry)
            moment += static_cast<double>((entry.row() + 1) * (2 * entry.col() + 1)) * entry.value();
    CHECK(moment == about(known.moment));
}

// Problems of a few contacts, every number another.

VectorXd numbered(Index size, double first)
{
    return VectorXd::LinSpaced(size, first, first + static_cast<double>(size) - 1.0) / 7.0;
}

Sparse numbered_matrix(Index rows, Index columns)
{
    Sparse matrix(rows, columns);
    for (Index column = 0; column < columns; ++column)
        for (Index row = column % 2; row < rows; row += 2)
            matrix.insert(row, column) = static_cast<double>(1 + row + 100 * column) / 3.0;
    matrix.makeCompressed();
    return matrix;
}

FclibGuess numbered_guess(const FclibProblem& problem, double first)
{
    const Index rows = problem.rows_per_contact * problem.contacts();
    return {numbered(problem.f.size(), first), numbered(rows, first + 1), numbered(rows, first + 2),
        numbered(problem.b.size(), first + 3)};
}

FclibProblem small_problem(FclibForm form, int rows_per_contact, Index contacts = 2)
{
    const Index rows = rows_per_contact * contacts, bodies = 4, constraints = 1;
    FclibProblem problem;
    problem.form = form;
    problem.rows_per_contact = rows_per_contact;
    problem.mu = numbered(contacts, 1);
    if (form == FclibForm::local) {
        problem.W = numbered_matrix(rows, rows);
        problem.q = numbered(rows, -3);
    } else {
        problem.M = numbered_matrix(bodies, bodies);
        problem.H = numbered_matrix(bodies, rows);
        problem.G = numbered_matrix(bodies, constraints);
        problem.f = numbered(bodies, -1);
        problem.w = numbered(rows, -2);
        problem.b = numbered(constraints, 9);
    }
    if (form == FclibForm::global_rolling) problem.mu_r = numbered(contacts, 2);
    problem.title = "Würfel";
    problem.description = "two lines\nof text";
    problem.guesses = {numbered_guess(problem, 20), numbered_guess(problem, 30)};
    problem.solution = numbered_guess(problem, 40);
    return problem;
}

FclibProblem through_file(const FclibProblem& problem)
{
    const SceneFolder folder;
    write_fclib(problem, folder.path() / "problem.hdf5");
    CHECK_FALSE(std::filesystem::exists(folder.path() / "problem.hdf5.tmp"));
    return read_fclib(folder.path() / "problem.hdf5");
}

bool same(const Sparse& a, const Sparse& b)
{
    return a.rows() == b.rows() && a.cols() == b.cols() && a.nonZeros() == b.nonZeros() && (a - b).norm() == 0.0;
}

bool same(const FclibGuess& a, const FclibGuess& b)
{
    const auto equal = [](const VectorXd& c, const VectorXd& d) { return c.size() == d.size() && c == d; };
    return equal(a.v, b.v) && equal(a.u, b.u) && equal(a.r, b.r) && equal(a.l, b.l);
}

void check_same(const FclibProblem& a, const FclibProblem& b)
{
    CHECK(a.form == b.form);
    CHECK(a.rows_per_contact == b.rows_per_contact);
    for (const auto matrix : {&FclibProblem::W, &FclibProblem::M, &FclibProblem::H, &FclibProblem::G})
        CHECK(same(a.*matrix, b.*matrix));
    for (const auto list : {&FclibProblem::q, &FclibProblem::f, &FclibProblem::w, &FclibProblem::b, &FclibProblem::mu,
             &FclibProblem::mu_r}) {
        REQUIRE((a.*list).size() == (b.*list).size());
        CHECK(a.*list == b.*list);
    }
    CHECK(a.title == b.title);
    CHECK(a.description == b.description);
    REQUIRE(a.guesses.size() == b.guesses.size());
    for (std::size_t k = 0; k < a.guesses.size(); ++k) CHECK(same(a.guesses[k], b.guesses[k]));
    CHECK(same(a.solution, b.solution));
}

} // namespace

TEST_CASE("every file of other people's problems is read as h5py reads it", "[fclib]")
{
    const KnownFile& known = GENERATE(from_range(known_files));
    INFO(known.name);
    const FclibProblem problem = read_fclib(data_file(known.name));
    const bool local = known.form == FclibForm::local;
    CHECK(problem.form == known.form);
    CHECK(problem.rows_per_contact == known.rows_per_contact);
    CHECK(problem.contacts() == known.contacts);
    CHECK(problem.title == known.title);
    CHECK(problem.description.size() == known.description);
    check_matrix(local ? problem.W : problem.M, known.first);
    if (!local) check_matrix(problem.H, known.second);
    CHECK(problem.G.cols() == 0);
    CHECK((local ? problem.q : problem.f).sum() == about(known.sum_q_or_f));
    CHECK(problem.w.sum() == about(known.sum_w));
    CHECK(problem.mu.sum() == about(known.sum_mu));
    CHECK(problem.mu.tail<1>()[0] == known.last_mu);
    CHECK(problem.guesses.size() == known.guesses);
    CHECK(problem.solution.u.sum() == about(known.sum_u));
    CHECK(problem.solution.r.norm() == 0.0); // no reference reaction in any of them
}

TEST_CASE("single numbers stand where h5py finds them", "[fclib]")
{
    const FclibProblem columns = read_fclib(data_file("Capsules-i122-1617.hdf5"));
    CHECK(columns.W.coeff(417, 419) == -0.48919537170978761);
    const FclibProblem rows = read_fclib(data_file("LMGC_100_PR_PerioBox-i00361-60-03000.hdf5"));
    CHECK(rows.W.coeff(179, 71) == -4.1228586433499271e-06);
    const FclibProblem triplets = read_fclib(data_file("spheres-in-a-box-98-i10000-256-10.hdf5"));
    CHECK(triplets.H.coeff(361, 400) == 0.5086733932528944);
    const FclibProblem rolling = read_fclib(data_file("Chute-ndof-768-nc-4-3.hdf5"));
    CHECK(rolling.mu_r == VectorXd::Constant(4, 0.1));
    CHECK(rolling.H.coeff(119, 19) == 0.27517375045051434);
    const FclibProblem guessed = read_fclib(data_file("local_problem_test.hdf5"));
    CHECK(guessed.guesses.at(0).r.sum() == about(0.00382593546953732));
    CHECK(guessed.guesses.at(0).v.size() == 0);
}

TEST_CASE("a problem that is written is read again as it was", "[fclib]")
{
    SECTION("local")
    {
        check_same(through_file(small_problem(FclibForm::local, 3)), small_problem(FclibForm::local, 3));
    }
    SECTION("local, in the plane")
    {
        check_same(through_file(small_problem(FclibForm::local, 2)), small_problem(FclibForm::local, 2));
    }
    SECTION("global")
    {
        check_same(through_file(small_problem(FclibForm::global, 3)), small_problem(FclibForm::global, 3));
    }
    SECTION("with rolling friction")
    {
        const FclibProblem problem = small_problem(FclibForm::global_rolling, 5);
        check_same(through_file(problem), problem);
    }
    SECTION("without contacts, constraints, guesses, solution and texts")
    {
        FclibProblem problem = small_problem(FclibForm::global, 3, 0);
        problem.G.resize(4, 0);
        problem.b.resize(0);
        problem.title = problem.description = "";
        problem.guesses.clear();
        problem.solution = {};
        check_same(through_file(problem), problem);
    }
    SECTION("one of the files of others, with a solution put in")
    {
        FclibProblem problem = read_fclib(data_file("Chute-ndof-768-nc-4-3.hdf5"));
        problem.solution = numbered_guess(problem, 1);
        check_same(through_file(problem), problem);
    }
}

TEST_CASE("the same problem gives the same bytes", "[fclib]")
{
    const SceneFolder folder;
    for (const char* name : {"a.hdf5", "b.hdf5"})
        write_fclib(small_problem(FclibForm::global, 3), folder.path() / name);
    CHECK(read_file(folder.path() / "a.hdf5") == read_file(folder.path() / "b.hdf5"));
}
