// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contacts/law.hpp"

#include <catch2/catch.hpp>

using namespace talus;

namespace
{

constexpr double h = 1e-3;
constexpr double threshold = 0.03;                                   // [m/s]
constexpr double nowhere = std::numeric_limits<double>::quiet_NaN(); // must not be read

ContactKind kind(double gap, double u_n, double closes, bool loaded, double restitution = 0.5)
{
    return contact_kind(gap, u_n, closes, loaded, {0.5, restitution, 0.0, infinity}, h, threshold);
}

} // namespace

TEST_CASE("an impact is fast, new, and only where there is restitution", "[stabilisation]")
{
    CHECK(kind(-1e-5, -1.0, nowhere, false) == ContactKind::impact);
    CHECK(kind(-1e-5, -1.0, nowhere, true) == ContactKind::resting);              // loaded in the step before
    CHECK(kind(-1e-5, -0.5 * threshold, nowhere, false) == ContactKind::resting); // too slow
    CHECK(kind(-1e-5, -1.0, nowhere, false, 0.0) == ContactKind::resting);        // no restitution
    CHECK(kind(1e-4, -1.0, 1e-4, false) == ContactKind::impact); // an open gap that closes in this step
    CHECK(kind(1e-4, -1.0, 1e-4, true) == ContactKind::impact);
    CHECK(kind(1e-2, -1.0, 1e-2, false) == ContactKind::open);     // one that does not
    CHECK(kind(1e-4, -1.0, infinity, false) == ContactKind::open); // or passes by
    CHECK(kind(1e-4, 0.1, infinity, false) == ContactKind::open);
}

TEST_CASE("each kind of contact gets its law", "[stabilisation]")
{
    SolverSettings solver;
    const ContactLaw law{0.5, 0.4, 0.0, infinity};
    const double w = 2.0;

    const auto impact = normal_law({ContactKind::impact, -1e-5, -1.0, w, 0.0}, law, solver, {h});
    CHECK(impact.target == Approx(0.4));
    CHECK(impact.compliance == 0.0);

    const auto open = normal_law({ContactKind::open, 1e-4, nowhere, w, nowhere}, law, solver, {h});
    CHECK(open.target == Approx(-0.1)); // may close the gap in one step: u_n ≥ −g/h, without Υ
    CHECK(open.compliance == 0.0);

    const auto resting = normal_law({ContactKind::resting, -1e-5, -0.09, w, 0.0}, law, solver, {h});
    CHECK(resting.compliance == Approx(0.2 / 2 * w));                   // σ W, σ = 0.2 / N_min
    CHECK(resting.target == Approx(4.0 / 9.0 * 1e-5 / h - 0.09 / 9.0)); // −(4/h) Υ g + Υ u_n

    solver.stabilisation = Stabilisation::projected;
    const auto rigid = normal_law({ContactKind::resting, -1e-5, -0.09, w, nowhere}, law, solver, {h});
    CHECK(rigid.target == 0.0);
    CHECK(rigid.compliance == 0.0);
}

TEST_CASE("a stiffness softer than the sweeps can carry decides the compliance", "[stabilisation]")
{
    const double k = 100.0;
    CHECK(matched_compliance({0, 0, 0, k}, 2.0, h, 2) == Approx(4.0 / 9.0 / (k * h * h)));
    CHECK(matched_compliance({0, 0, 0, 1e12}, 2.0, h, 2) == Approx(0.2));
}

TEST_CASE("only the excess of the push-out over what the carried impulse needs is capped", "[stabilisation]")
{
    SolverSettings solver;
    solver.push_out_speed = 0.05;
    const double w = 2.0, carried = 1.0; // held: Σ λ = 0.2 · 1
    const auto deep = normal_law({ContactKind::resting, -1e-2, 0.0, w, carried}, {}, solver, {h});
    CHECK(deep.target == Approx(0.2 + 0.05));
    // In equilibrium the overlap's feedback is just what the impulse needs, however large that is.
    const double gap = -0.2 * h / (4.0 / 9.0);
    CHECK(normal_law({ContactKind::resting, gap, 0.0, w, carried}, {}, solver, {h}).target == Approx(0.2));
}

TEST_CASE("a jammed contact does not hold the impulse that it carries", "[stabilisation][press]")
{
    SolverSettings solver;
    solver.push_out_speed = 0.05;
    const double w = 2.0, carried = GENERATE(0.0, 1.0, 100.0);
    const auto target = [&](double gap) {
        return normal_law({ContactKind::resting, gap, -0.1, w, carried, true}, {}, solver, {h}).target;
    };
    CHECK(target(-1e-2) == solver.push_out_speed);
    CHECK(target(-1e-5) == Approx(4.0 / 9.0 * 1e-5 / h));
    solver.stabilisation = Stabilisation::projected;
    CHECK(target(-1e-2) == 0.0);
}

TEST_CASE("a rigid contact gives back half of the turn of a concave wall, and never more than it takes",
    "[stabilisation][tube]")
{
    SolverSettings solver;
    solver.stabilisation = Stabilisation::projected;
    const auto target = [&](double gap, double u_n, double turned) {
        const auto kind = gap > 0.0 ? ContactKind::open : ContactKind::resting;
        return normal_law({kind, gap, u_n, 2.0, 0.0, false, turned}, {}, solver, {h}).target;
    };
    CHECK(target(-1e-5, -0.5, -0.8) == Approx(0.4)); // on the chords of a circle u_n is half of the turn
    CHECK(target(-1e-5, -0.8, -0.8) == Approx(0.4)); // from its tangent
    CHECK(target(-1e-5, -0.1, -0.8) == Approx(0.1)); // no more than it comes with
    CHECK(target(-1e-5, 0.1, -0.8) == 0.0);
    CHECK(target(-1e-5, -0.5, 0.8) == 0.0); // a convex wall
    CHECK(target(1e-4, -0.5, -0.8) == Approx(0.4 - 0.1));
    solver.stabilisation = Stabilisation::matched;
    CHECK(target(1e-4, -0.5, -0.8) == Approx(-0.1));
}
