// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/problem/fclib.hpp"
#include "io/problem/hdf5_writer.hpp"
#include "io/text/input_error.hpp"
#include "tests/io/scene_folder.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <variant>

using namespace talus;
using namespace talus::test;
using Eigen::Index;
using Eigen::VectorXd;

namespace
{

using Sparse = Eigen::SparseMatrix<double>;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
/// Where datasets claim more than there can be.
const std::string too_much = "with them the file says it has more than its ";

constexpr double infinity = std::numeric_limits<double>::infinity();

std::filesystem::path data_file(const std::string& name)
{
    return std::filesystem::path(TALUS_SOURCE_DIR) / "tests/data/fclib" / name;
}

VectorXd vector(std::initializer_list<double> values)
{
    return Eigen::Map<const VectorXd>(values.begin(), static_cast<Index>(values.size()));
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

// Files written dataset by dataset, some of them wrong.

using Value = std::variant<int, std::vector<int>, VectorXd, std::string>;
using Content = std::map<std::string, Value>;

/// One contact in the plane, W = (1 2; 3 4).
Content local_content()
{
    const std::string group = "/fclib_local";
    return {{group + "/spacedim", 2}, {group + "/vectors/mu", vector({0.5})}, {group + "/vectors/q", vector({-1, 2})},
        {group + "/W/m", 2}, {group + "/W/n", 2}, {group + "/W/nzmax", 4}, {group + "/W/nz", 4},
        {group + "/W/i", std::vector{0, 0, 1, 1}}, {group + "/W/p", std::vector{0, 1, 0, 1}},
        {group + "/W/x", vector({1, 2, 3, 4})}, {group + "/info/title", std::string("one contact")}};
}

/// One body of one coordinate, one contact with rolling friction, a constraint.
Content rolling_content()
{
    const std::string group = "/fclib_global_rolling";
    const auto one_entry = [](int columns) {
        return Content{{"/m", 1}, {"/n", columns}, {"/nzmax", 1}, {"/nz", 1}, {"/i", std::vector{0}},
            {"/p", std::vector{0}}, {"/x", vector({1})}};
    };
    Content content = {{group + "/spacedim", 5}, {group + "/vectors/mu", vector({0.5})},
        {group + "/vectors/mu_r", vector({0.1})}, {group + "/vectors/f", vector({1})},
        {group + "/vectors/w", vector({1, 2, 3, 4, 5})}, {group + "/vectors/b", vector({1})}};
    for (const auto& [matrix, columns] : {std::pair{"/M", 1}, {"/H", 5}, {"/G", 1}})
        for (const auto& [name, value] : one_entry(columns)) content[group + matrix + name] = value;
    return content;
}

std::string bytes_of(const Content& content)
{
    Hdf5Writer file("in memory");
    for (const auto& [path, value] : content) std::visit([&, &p = path](const auto& v) { file.add(p, v); }, value);
    return file.bytes();
}

std::string refusal_of(const std::string& bytes)
{
    return error_of<InputError>([&] { parse_fclib(bytes, "p.hdf5"); });
}

/// A change of one dataset and what is said about it, without the name of the file.
struct Fault {
    std::string path;
    std::optional<Value> value; ///< none: the dataset is missing
    std::string sentence;
};

void check_refusal(Content content, const Fault& fault)
{
    INFO(fault.path);
    content.erase(fault.path);
    if (fault.value) content[fault.path] = *fault.value;
    CHECK(refusal_of(bytes_of(content)) == "p.hdf5: " + fault.sentence);
}

/// The file of `content`, with one dataset taken out and `put` in its place by the means of HDF5.
std::string refusal_of_replaced(const std::string& path, const std::function<void(hid_t file, const char* path)>& put)
{
    const QuietHdf5 quiet;
    const SceneFolder folder;
    const auto name = folder.write("p.hdf5", bytes_of(local_content()));
    {
        const Hdf5Id file(H5Fopen(name.c_str(), H5F_ACC_RDWR, H5P_DEFAULT));
        H5Ldelete(file, path.c_str(), H5P_DEFAULT);
        put(file, path.c_str());
    }
    return folder.without_folder(error_of<InputError>([&] { read_fclib(name); }));
}

/// Makes a dataset of this extent that is never written, with settings.
Hdf5Id make_dataset(hid_t file, const char* path, hid_t type, std::vector<hsize_t> extent, hid_t settings = H5P_DEFAULT)
{
    const Hdf5Id space(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr));
    return Hdf5Id(H5Dcreate2(file, path, type, space, H5P_DEFAULT, settings, H5P_DEFAULT));
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

TEST_CASE("triplets, compressed columns and compressed rows give the same matrix", "[fclib]")
{
    Content content = local_content();
    const auto set = [&](const std::string& name, Value value) { content["/fclib_local/W/" + name] = value; };
    const Eigen::Matrix2d expected{{1, 2}, {3, 4}};
    const auto W = [&] { return Eigen::MatrixXd(parse_fclib(bytes_of(content), "p.hdf5").W); };
    CHECK(W() == expected);

    SECTION("compressed columns")
    {
        set("nz", -1);
        set("p", std::vector{0, 2, 4});
        set("i", std::vector{0, 1, 0, 1});
        set("x", vector({1, 3, 2, 4}));
        CHECK(W() == expected);
    }
    SECTION("compressed rows")
    {
        set("nz", -2);
        set("p", std::vector{0, 2, 4});
        set("i", std::vector{0, 1, 0, 1});
        CHECK(W() == expected);
    }
    SECTION("with more room than entries, which old releases of FCLIB wrote whole")
    {
        set("nzmax", 6);
        set("x", vector({1, 2, 3, 4, not_a_number, not_a_number}));
        CHECK(W() == expected);
    }
    SECTION("with an entry in two parts, and a zero")
    {
        set("nzmax", 6);
        set("nz", 6);
        set("i", std::vector{0, 0, 1, 1, 1, 0});
        set("p", std::vector{0, 1, 0, 1, 1, 1});
        set("x", vector({1, 2, 3, 3, 1, 0}));
        CHECK(W() == expected);
    }
}

TEST_CASE("a broken local problem is refused with what is wrong", "[fclib]")
{
    const std::string g = "/fclib_local", W = g + "/W";
    const std::vector<Fault> faults = {
        {g + "/spacedim", {}, "/fclib_local/spacedim is missing"},
        {g + "/spacedim", 5, "/fclib_local/spacedim must be 2 or 3, not 5"},
        {g + "/spacedim", 3, "/fclib_local/vectors/q must have 3 values, not 2"},
        {g + "/spacedim", vector({2}), "/fclib_local/spacedim must be a whole number of 8 to 64 bits"},
        {g + "/spacedim", std::vector{2, 2}, "/fclib_local/spacedim must be one number, not 2"},
        {g + "/vectors/mu", {}, "/fclib_local/vectors/mu is missing"},
        {g + "/vectors/mu", vector({-0.5}), "/fclib_local/vectors/mu[0] must be at least 0, not -0.5"},
        {g + "/vectors/mu", vector({not_a_number}), "/fclib_local/vectors/mu[0] is nan, not a finite number"},
        {g + "/vectors/mu", vector({1, 1}), "/fclib_local/vectors/q must have 4 values, not 2"},
        {g + "/vectors/q", {}, "/fclib_local/vectors/q is missing"},
        {g + "/vectors/q", vector({1, infinity}), "/fclib_local/vectors/q[1] is inf, not a finite number"},
        {g + "/vectors/q", 1, "/fclib_local/vectors/q must be floating-point numbers of 32 or 64 bits"},
        {g + "/vectors/q", std::string("1, 2"),
            "/fclib_local/vectors/q must be floating-point numbers of 32 or 64 bits"},
        {W + "/m", {}, "/fclib_local/W/m is missing"},
        {W + "/m", 3, "/fclib_local/W/m must be 2 to go with the vectors, not 3"},
        {W + "/m", 2000000000, "/fclib_local/W/m must be 2 to go with the vectors, not 2000000000"},
        {W + "/n", -2, "/fclib_local/W/n must be 2 to go with the vectors, not -2"},
        {W + "/nzmax", -1, "/fclib_local/W/nzmax must be from 0 to 2147483647, not -1"},
        {W + "/nzmax", 3, "/fclib_local/W/nz must be from -2 to 3, not 4"},
        {W + "/nz", -3, "/fclib_local/W/nz must be from -2 to 4, not -3"},
        {W + "/nz", 3, "/fclib_local/W/i must have 3 values, not 4"},
        {W + "/nz", -1, "/fclib_local/W/p must have 3 values, not 4"},
        {W + "/i", {}, "/fclib_local/W/i is missing"},
        {W + "/i", vector({0, 0, 1, 1}), "/fclib_local/W/i must be whole numbers of 8 to 64 bits"},
        {W + "/i", std::vector{0, 0, 1}, "/fclib_local/W/i must have 4 values, not 3"},
        {W + "/i", std::vector{0, 0, 1, 2}, "/fclib_local/W has an entry in row 2; its rows are 0 to 1"},
        {W + "/p", std::vector{0, -1, 0, 1}, "/fclib_local/W has an entry in column -1; its columns are 0 to 1"},
        {W + "/p", std::vector{0, 1}, "/fclib_local/W/p must have 4 values, not 2"},
        {W + "/x", {}, "/fclib_local/W/x is missing"},
        {W + "/x", vector({1, 2, 3}), "/fclib_local/W/x must have 4 values, not 3"},
        {W + "/x", vector({1, not_a_number, 3, 4}), "/fclib_local/W/x[1] is nan, not a finite number"},
        {g + "/info/title", 7, "/fclib_local/info/title must be one text"},
        {g + "/V/m", 2, "/fclib_local/V states constraints, which are read in the global form only"},
        {"/solution/r", vector({1}), "/solution/r must have 2 values, not 1"},
        {"/solution/v", vector({1}), "/solution/v must have 0 values, not 1"},
        {"/solution/u", vector({1, -infinity}), "/solution/u[1] is -inf, not a finite number"},
        {"/guesses/1/u", vector({1, 2}), "/guesses/number_of_guesses is missing"},
        {"/guesses/number_of_guesses", -1, "/guesses/number_of_guesses must be at least 0, not -1"},
        {"/guesses/number_of_guesses", 2000000000, "/guesses/1 is missing, but there must be 2000000000 guesses"},
    };
    for (const Fault& fault : faults) check_refusal(local_content(), fault);
}

TEST_CASE("broken pointers are refused", "[fclib]")
{
    const std::string W = "/fclib_local/W";
    Content content = local_content();
    content[W + "/nz"] = GENERATE(-1, -2);
    content[W + "/p"] = std::vector{0, 2, 4};
    const std::vector<Fault> faults = {
        {W + "/p", std::vector{0, 4}, W + "/p must have 3 values, not 2"},
        {W + "/p", std::vector{1, 2, 4}, W + "/p must begin with 0, not 1"},
        {W + "/p", std::vector{0, 3, 2}, W + "/p must not fall, as it does from 3 to 2"},
        {W + "/p", std::vector{0, 2, 5}, W + "/p must end with at most nzmax = 4, not 5"},
        {W + "/nzmax", 2147483647, W + "/i must have 2147483647 values, not 4"},
        {W + "/x", vector({1, 2, 3}), W + "/x must have 4 values, not 3"},
    };
    for (const Fault& fault : faults) check_refusal(content, fault);
}

TEST_CASE("a broken global problem is refused with what is wrong", "[fclib]")
{
    const std::string g = "/fclib_global_rolling";
    CHECK(refusal_of(bytes_of(rolling_content())) == "no error");
    const std::vector<Fault> faults = {
        {g + "/spacedim", 3, g + "/spacedim must be 5, not 3"},
        {g + "/vectors/mu_r", {}, g + "/vectors/mu_r is missing"},
        {g + "/vectors/mu_r", vector({1, 1}), g + "/vectors/mu_r must have 1 values, not 2"},
        {g + "/vectors/mu_r", vector({-1}), g + "/vectors/mu_r[0] must be at least 0, not -1"},
        {g + "/vectors/f", vector({1, 2}), g + "/M/m must be 2 to go with the vectors, not 1"},
        {g + "/vectors/w", vector({1, 2, 3}), g + "/vectors/w must have 5 values, not 3"},
        {g + "/vectors/b", {}, g + "/vectors/b is missing"},
        {g + "/vectors/b", vector({1, 2}), g + "/G/n must be 2 to go with the vectors, not 1"},
        {g + "/M/x", vector({-infinity}), g + "/M/x[0] is -inf, not a finite number"},
        {g + "/H/n", 4, g + "/H/n must be 5 to go with the vectors, not 4"},
        {g + "/H/p", std::vector{5}, g + "/H has an entry in column 5; its columns are 0 to 4"},
        {g + "/G/m", 2, g + "/G/m must be 1 to go with the vectors, not 2"},
        {"/solution/l", vector({1, 2}), "/solution/l must have 1 values, not 2"},
    };
    for (const Fault& fault : faults) check_refusal(rolling_content(), fault);
}

TEST_CASE("what is no contact problem is refused", "[fclib]")
{
    CHECK(refusal_of("not HDF5") == "p.hdf5: not an HDF5 file");
    CHECK(refusal_of(bytes_of({{"/fclib/W/m", 1}})) ==
          "p.hdf5: /fclib_local, /fclib_global and /fclib_global_rolling are missing: it holds no contact problem");
    CHECK(refusal_of(bytes_of({{"/fclib_local", 1}}))
              .starts_with("p.hdf5: /fclib_local/spacedim cannot be read by HDF5: "));
    const SceneFolder folder;
    const auto refusal = [&](const std::filesystem::path& path) {
        return folder.without_folder(error_of<InputError>([&] { read_fclib(path); }));
    };
    CHECK(refusal(folder.path() / "none.hdf5") == "none.hdf5: no such file");
    CHECK(refusal(folder.write("empty.hdf5", "")) == "empty.hdf5: the file is empty");
    CHECK(refusal(folder.path()) == folder.path().string() + ": not an HDF5 file");
}

TEST_CASE("a file that was cut is refused, wherever it was cut", "[fclib]")
{
    const std::string whole = read_file(data_file("local_problem_test.hdf5"));
    CHECK(refusal_of(whole.substr(0, whole.size() - 1)) ==
          "p.hdf5: HDF5 cannot read it: truncated file: eof = 82175, sblock->base_addr = 0, stored_eof = 82176");
    CHECK(refusal_of(whole.substr(0, 7)) == "p.hdf5: not an HDF5 file");
    for (const std::size_t size : {8, 20, 60, 96, 500, 2000, 4096, 40000, 80000}) {
        INFO(size);
        CHECK(refusal_of(whole.substr(0, size)).starts_with("p.hdf5: HDF5 cannot read it: "));
    }
}

TEST_CASE("a file on which HDF5 crashes is refused", "[fclib]")
{
    std::string bytes = bytes_of(local_content());
    const std::size_t heap = bytes.find("HEAP"); // of the names in the first group
    REQUIRE(heap != std::string::npos);
    bytes.replace(heap + 24, 8, 8, '\xff'); // the address of its data is none: release 1.10.8 crashes
    const SceneFolder folder;
    const auto path = folder.write("p.hdf5", bytes);
    CHECK_THAT(folder.without_folder(error_of<InputError>([&] { read_fclib(path); })), Catch::StartsWith("p.hdf5: "));
}

TEST_CASE("a dataset that is not plainly stored is refused before any room is made for it", "[fclib]")
{
    const std::string q = "/fclib_local/vectors/q";
    const std::string storage =
        "p.hdf5: " + q + " must be stored in one piece, uncompressed (as h5repack -f NONE -l CONTI does)";
    constexpr hsize_t huge = hsize_t{1} << 40;

    CHECK(refusal_of_replaced(q, [](hid_t file, const char* path) {
        make_dataset(file, path, H5T_IEEE_F64LE, {huge});
    }) == "p.hdf5: " + q + " has 1099511627776 values; " + too_much + "10296 bytes can hold");
    CHECK(refusal_of_replaced(q, [](hid_t file, const char* path) {
        make_dataset(file, path, H5T_IEEE_F64LE, {1, 2});
    }) == "p.hdf5: " + q + " must be a list, not an array of 2 dimensions");
    CHECK(refusal_of_replaced(q, [](hid_t file, const char* path) {
        const Hdf5Id type(H5Tcreate(H5T_OPAQUE, 8));
        make_dataset(file, path, type, {0});
    }) == "p.hdf5: " + q + " must be floating-point numbers of 32 or 64 bits");
    CHECK(refusal_of_replaced(q, [](hid_t file, const char* path) {
        const Hdf5Id settings(H5Pcreate(H5P_DATASET_CREATE));
        const hsize_t chunk = 2;
        H5Pset_chunk(settings, 1, &chunk);
        make_dataset(file, path, H5T_IEEE_F64LE, {huge}, settings);
    }) == storage);
    CHECK(refusal_of_replaced(q, [](hid_t file, const char* path) {
        const Hdf5Id settings(H5Pcreate(H5P_DATASET_CREATE));
        H5Pset_external(settings, "/dev/zero", 0, H5F_UNLIMITED);
        make_dataset(file, path, H5T_IEEE_F64LE, {2}, settings);
    }) == storage);
}

TEST_CASE("links to other places are not followed", "[fclib]")
{
    const std::string group = "/fclib_local/vectors";
    const std::string refusal = "p.hdf5: " + group + " is a link to another place, which is not followed";
    CHECK(refusal_of_replaced(group, [](hid_t file, const char* path) {
        H5Lcreate_soft("/fclib_local/W", file, path, H5P_DEFAULT, H5P_DEFAULT);
    }) == refusal);
    CHECK(refusal_of_replaced(group, [](hid_t file, const char* path) {
        H5Lcreate_external("other.hdf5", "/vectors", file, path, H5P_DEFAULT, H5P_DEFAULT);
    }) == refusal);
}

TEST_CASE("guesses that share their place are not read over and over", "[fclib]")
{
    const QuietHdf5 quiet;
    const SceneFolder folder;
    const auto path = folder.path() / "p.hdf5";
    FclibProblem problem = small_problem(FclibForm::local, 3, 20);
    problem.guesses.resize(1); // 960 bytes
    write_fclib(problem, path);
    {
        constexpr int count = 2000;
        const Hdf5Id file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT));
        const Hdf5Id number(H5Dopen2(file, "/guesses/number_of_guesses", H5P_DEFAULT));
        H5Dwrite(number, H5T_NATIVE_INT, H5S_ALL, H5S_ALL, H5P_DEFAULT, &count);
        for (int k = 2; k <= count; ++k) {
            const std::string again = "/guesses/" + std::to_string(k);
            H5Lcreate_hard(file, "/guesses/1", file, again.c_str(), H5P_DEFAULT, H5P_DEFAULT);
        }
    }
    CHECK_THAT(error_of<InputError>([&] { read_fclib(path); }), Catch::Contains(" has 60 values; " + too_much));
}

TEST_CASE("a text of variable length is taken from the heap only where both agree on its length", "[fclib]")
{
    std::string bytes = read_file(data_file("Capsules-i122-1617.hdf5"));
    const std::size_t heap = bytes.find("GCOL");
    REQUIRE(heap != std::string::npos);
    const std::string place = "p.hdf5: /fclib_local/info/";
    SECTION("length")
    {
        // The dataset of the title: length, address of the heap, index of the text in it.
        std::string address(8, '\0');
        for (std::size_t i = 0; i < 8; ++i) address[i] = static_cast<char>(heap >> 8 * i);
        const std::size_t title = bytes.find(std::string("\x08\0\0\0", 4) + address);
        REQUIRE(title != std::string::npos);
        bytes[title + 3] = 0x70;
        CHECK(refusal_of(bytes) == place + "title must be 1879048200 bytes of text, but the file's heap has 8");
    }
    SECTION("signature")
    {
        bytes[heap] = 'g';
        CHECK(refusal_of(bytes) == place + "title is in a heap that is not in the file");
    }
    SECTION("length in the heap")
    {
        bytes[heap + 16 + 15] = 0x70;
        CHECK(refusal_of(bytes) == place + "title is not in the file's heap");
    }
}
