// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/vector.hpp"
#include "io/problem/fclib.hpp"
#include "io/text/csv.hpp"
#include "tests/app/program.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using Catch::Matchers::Contains;
using talus::read_fclib;

namespace
{

const std::string data = TALUS_SOURCE_DIR "/tests/data/fclib/";

/// Beads in a box a step before they come to rest on its floor, as step.hdf5.
void dump_beads(const Workplace& place)
{
    place.write("scene.toml", beads_in_a_box);
    const Outcome outcome = place.talus("dump scene.toml --at 0.045 -o step.hdf5");
    REQUIRE(outcome.exit_code == 0);
    CHECK_THAT(outcome.out, Contains("step.hdf5: "));
}

} // namespace

TEST_CASE("solve says how it went and writes the solution in FCLIB's place", "[app][solve]")
{
    const Workplace place;
    const std::string name = GENERATE(
        as<std::string>{}, "local_problem_test.hdf5", "Spheres-i099-356-679.hdf5", "Chute-ndof-768-nc-4-3.hdf5");
    const Outcome outcome = place.talus("solve " + data + name + " --tolerance 1e-3 -o solved.hdf5");
    CHECK(outcome.exit_code == 0);
    for (const char* told : {"contacts of", "sweeps: ", "residual: ", "worst velocity violation: ", "cone violation: ",
             "seconds: ", "contact updates per second: "})
        CHECK_THAT(outcome.out, Contains(told));

    const auto file = read_fclib(place.path("solved.hdf5"));
    const auto& [v, u, r, l] = file.solution;
    if (file.form == talus::FclibForm::local) {
        CHECK((file.W * r + file.q - u).norm() < 1e-10 * u.norm());
    } else {
        CHECK((file.M * v - file.H * r - file.f).norm() < 1e-10 * file.f.norm());
        CHECK((file.H.transpose() * v + file.w - u).norm() < 1e-10 * (u.norm() + file.w.norm()));
    }
    for (Eigen::Index k = 0; k < file.contacts(); ++k) CHECK(r[file.rows_per_contact * k] >= 0.0);
}

TEST_CASE("solve ends with 1 where the tolerance is not met, and writes the result all the same", "[app][solve]")
{
    const Workplace place;
    const Outcome outcome =
        place.talus("solve " + data + "local_problem_test.hdf5 --max-sweeps 5 -o solved.hdf5 --history history.csv");
    CHECK(outcome.exit_code == 1);
    CHECK_THAT(outcome.out, Contains("NOT MET"));
    CHECK_THAT(outcome.err, Contains("the tolerance was not met in 5 sweeps"));
    CHECK(read_fclib(place.path("solved.hdf5")).solution.r.norm() > 0.0);

    const talus::CsvTable history(place.path("history.csv"),
        {"sweep", "seconds", "residual", "worst_velocity_violation", "worst_spin_violation", "cone_violation"});
    REQUIRE(history.row_count() == 5);
    CHECK(history.value(4, history.column("sweep")) == 5.0);
    CHECK(history.value(4, history.column("residual")) < history.value(0, history.column("residual")));
    for (std::size_t row = 1; row < 5; ++row)
        CHECK(history.value(row, history.column("seconds")) >= history.value(row - 1, history.column("seconds")));
}

TEST_CASE("the choices of a solve choose", "[app][solve]")
{
    const Workplace place;
    const std::string problem =
        "solve " + data + "spheres-in-a-box-98-i10000-256-10.hdf5 --tolerance 1e-2 --max-sweeps 500 ";
    const auto sweeps = [&](const std::string& options) {
        const Outcome outcome = place.talus(problem + options);
        const auto at = outcome.out.find("sweeps: ");
        REQUIRE(at != std::string::npos);
        return std::stoi(outcome.out.substr(at + 8));
    };
    const int plain = sweeps("");
    CHECK(sweeps("--algorithm 3.1 --local sequential --order natural --omega 1") == plain);
    CHECK(sweeps("--order reversed") != plain);
    CHECK(sweeps("--order symmetric") != plain);
    CHECK(sweeps("--omega 0.5") > plain);
    CHECK(sweeps("--omega 0.5,1") < sweeps("--omega 0.5"));
    CHECK(sweeps("--order shuffled --seed 1") != sweeps("--order shuffled --seed 2"));
    CHECK(sweeps("--local block") == 500); // stalls: tests/results/local_solves.md
    CHECK(sweeps("--local sliding") < 500);
    CHECK(sweeps("--local scalar") < 500);
}

TEST_CASE("a dumped step can be solved, from its own guess too", "[app][dump]")
{
    const Workplace place;
    dump_beads(place);
    CHECK(place.talus("solve step.hdf5 -o step.hdf5").exit_code == 2); // would lose the problem
    const auto file = read_fclib(place.path("step.hdf5"));
    CHECK(file.contacts() >= 8);
    CHECK_THAT(file.description, Contains("contact problem of the step of"));
    REQUIRE(file.guesses.size() == 1);
    CHECK(place.talus("solve step.hdf5 --tolerance 1e-10").exit_code == 0);
    CHECK(place.talus("solve step.hdf5 --tolerance 1e-10 --guess 1 -o solved.hdf5").exit_code == 0);

    // The solution of a step is what the run goes on with: after it nothing sinks any deeper than the law allows.
    const auto solved = read_fclib(place.path("solved.hdf5"));
    for (Eigen::Index k = 0; k < solved.contacts(); ++k) {
        const double u_n = solved.solution.u[solved.rows_per_contact * k];
        CHECK(u_n > -1e-9);
        CHECK(std::abs(std::min(u_n, solved.solution.r[solved.rows_per_contact * k])) < 1e-9);
    }
}

TEST_CASE("a dumped file says which spheres and contacts are its bodies and constraints", "[app][dump]")
{
    const Workplace place;
    place.write("scene.toml", beads_in_a_box);
    REQUIRE(place.talus("dump scene.toml --at 0.1 --set time.duration=0.1 --set fill.0.count=30 --quiet -o step.hdf5")
                .exit_code == 0);
    const auto file = read_fclib(place.path("step.hdf5"));
    for (const std::string list : talus::origin_lists) CHECK(file.origin.at(list).size() > 0);
    const auto number = [&](const std::string& list, Eigen::Index k) { return file.origin.at(list)[k]; };
    const auto vector = [&](const std::string& list, Eigen::Index k) {
        return talus::Vec3(file.origin.at(list).segment<3>(3 * k));
    };
    const Eigen::Index spheres = file.origin.at("bodies/id").size();
    for (Eigen::Index i = 0; i < spheres; ++i) {
        CHECK(number("bodies/id", i) == static_cast<double>(i)); // none has left: bodies stand in the order of ids
        CHECK(file.M.coeff(6 * i, 6 * i) ==
              Approx(2500.0 * 4.0 / 3.0 * std::acos(-1.0) * std::pow(number("bodies/radius", i), 3)));
    }
    REQUIRE(file.origin.at("contacts/gap").size() == file.contacts());
    int with_walls = 0;
    for (Eigen::Index k = 0; k < file.contacts(); ++k) {
        const auto a = static_cast<Eigen::Index>(number("contacts/id_a", k));
        const double half_gap = 0.5 * number("contacts/gap", k);
        const double from_a = (vector("contacts/point", k) - vector("bodies/position", a)).norm();
        CHECK(from_a == Approx(number("bodies/radius", a) + half_gap).epsilon(1e-12));
        CHECK(file.H.coeff(6 * a, 3 * k) * file.H.coeff(6 * a, 3 * k) +
                  file.H.coeff(6 * a + 1, 3 * k) * file.H.coeff(6 * a + 1, 3 * k) +
                  file.H.coeff(6 * a + 2, 3 * k) * file.H.coeff(6 * a + 2, 3 * k) ==
              Approx(1.0)); // its normal, in the rows of sphere a
        CHECK((number("contacts/kind", k) >= 0.0 && number("contacts/kind", k) <= 2.0));
        with_walls += number("contacts/wall", k) >= 0.0;
        if (number("contacts/wall", k) >= 0.0) {
            CHECK(number("contacts/id_b", k) == -1.0);
            continue;
        }
        const auto b = static_cast<Eigen::Index>(number("contacts/id_b", k));
        // The normal of a gap is that of where paths meet: along it the point is in the middle.
        const talus::Vec3 normal(
            file.H.coeff(6 * a, 3 * k), file.H.coeff(6 * a + 1, 3 * k), file.H.coeff(6 * a + 2, 3 * k));
        const talus::Vec3 from_b = vector("contacts/point", k) - vector("bodies/position", b);
        CHECK(from_b.dot(normal) == Approx(number("bodies/radius", b) + half_gap).epsilon(1e-12));
        if (half_gap <= 0.0) CHECK(from_b.norm() == Approx(number("bodies/radius", b) + half_gap).epsilon(1e-9));
    }
    CHECK(with_walls > 0);
    CHECK(with_walls < file.contacts());
}

TEST_CASE("a dump has the same bytes whatever the number of threads", "[app][dump][determinism]")
{
    const Workplace place;
    place.write("scene.toml", beads_in_a_box);
    for (const char* threads : {"1", "2"})
        CHECK(place
                  .talus(
                      std::string("dump scene.toml --at 0.03 --quiet -o step") + threads + ".hdf5 --threads " + threads)
                  .exit_code == 0);
    CHECK(place.read("step1.hdf5") == place.read("step2.hdf5"));
}

TEST_CASE("algorithms 2.1 and 2.2 solve a problem of equalities from a file", "[app][solve]")
{
    // Two masses that a rod without mass holds together: G^T v = 0.
    const Workplace place;
    talus::FclibProblem problem;
    problem.form = talus::FclibForm::global;
    problem.M.resize(2, 2);
    problem.M.insert(0, 0) = 1.0;
    problem.M.insert(1, 1) = 3.0;
    problem.H.resize(2, 0);
    problem.G.resize(2, 1);
    problem.G.insert(0, 0) = 1.0;
    problem.G.insert(1, 0) = -1.0;
    problem.f = Eigen::Vector2d(4.0, 0.0);
    problem.b = Eigen::VectorXd::Zero(1);
    write_fclib(problem, place.path("rod.hdf5"));
    for (const std::string algorithm : {"2.1", "2.2", "3.1"}) {
        CAPTURE(algorithm);
        CHECK(place.talus("solve rod.hdf5 -o solved.hdf5 --force --algorithm " + algorithm).exit_code == 0);
        const auto solved = read_fclib(place.path("solved.hdf5"));
        CHECK((solved.solution.v - Eigen::Vector2d(1.0, 1.0)).norm() < 1e-14);
        CHECK(solved.solution.l[0] == Approx(-3.0));
    }
}
