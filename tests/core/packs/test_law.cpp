// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/vector.hpp"
#include "core/packs/law.hpp"

#include <catch2/catch.hpp>

using namespace talus;

namespace
{

constexpr double h = 1e-3;
constexpr double threshold = 0.03;                                   // [m/s]
constexpr double w = 2.0;                                            // [1/kg]
constexpr double nowhere = std::numeric_limits<double>::quiet_NaN(); // must not be read

bool impact(double gap, double u_n, double closes, bool loaded, double restitution = 0.5)
{
    return is_impact<double>(gap, u_n, closes, loaded, restitution, {.h = h, .threshold_speed = threshold});
}

/// A contact of this kind with W = 2/kg and e = 0.4 between rigid spheres.
ContactEvent<double> event(ContactKind kind, double gap, double u_n)
{
    return {kind == ContactKind::impact, kind == ContactKind::open, gap, u_n, w, 0.4, infinity};
}

} // namespace

TEST_CASE("an impact is fast, new, and only where there is restitution", "[stabilisation]")
{
    CHECK(impact(-1e-5, -1.0, nowhere, false));
    CHECK_FALSE(impact(-1e-5, -1.0, nowhere, true));              // loaded in the step before
    CHECK_FALSE(impact(-1e-5, -0.5 * threshold, nowhere, false)); // too slow
    CHECK_FALSE(impact(-1e-5, -1.0, nowhere, false, 0.0));        // no restitution
    CHECK(impact(1e-4, -1.0, 1e-4, false));                       // an open gap that closes in this step
    CHECK(impact(1e-4, -1.0, 1e-4, true));
    CHECK_FALSE(impact(1e-2, -1.0, 1e-2, false));     // one that does not
    CHECK_FALSE(impact(1e-4, -1.0, infinity, false)); // or passes by
    CHECK_FALSE(impact(1e-4, 0.1, infinity, false));
}

TEST_CASE("each kind of contact gets its law", "[stabilisation]")
{
    const auto struck = normal_law(event(ContactKind::impact, -1e-5, -1.0), {h});
    CHECK(struck.target == Approx(0.4));
    CHECK(struck.compliance == 0.0);

    const auto open = normal_law(event(ContactKind::open, 1e-4, nowhere), {h});
    CHECK(open.target == Approx(-0.1)); // may close the gap in one step: u_n ≥ −g/h, without Υ
    CHECK(open.compliance == 0.0);

    const auto resting = normal_law(event(ContactKind::resting, -1e-5, -0.09), {h});
    CHECK(resting.compliance == Approx(0.2 / 2 * w));                   // σ W, σ = 0.2 / N_min
    CHECK(resting.target == Approx(4.0 / 9.0 * 1e-5 / h - 0.09 / 9.0)); // 4Υ κ/h + Υ u_n

    const auto rigid = normal_law(event(ContactKind::resting, -1e-5, -0.09), {.h = h, .rigid = true});
    CHECK(rigid.target == 0.0);
    CHECK(rigid.compliance == 0.0);
}

TEST_CASE("a stiffness softer than the sweeps can carry decides the compliance", "[stabilisation]")
{
    const double k = 100.0;
    CHECK(matched_compliance<double>(k, 2.0, h, 2) == Approx(4.0 / 9.0 / (k * h * h)));
    CHECK(matched_compliance<double>(1e12, 2.0, h, 2) == Approx(0.2));
}

TEST_CASE("a jammed contact parts with the push-out speed at most", "[stabilisation][press]")
{
    LawOfStep step{.h = h, .push_out_speed = 0.05};
    const auto target = [&](double gap) {
        auto jammed = event(ContactKind::resting, gap, -0.1);
        jammed.jammed = true;
        return normal_law(jammed, step).target;
    };
    CHECK(target(-1e-2) == step.push_out_speed);
    CHECK(target(-1e-5) == Approx(4.0 / 9.0 * 1e-5 / h));
    step.rigid = true;
    CHECK(target(-1e-2) == 0.0);
}

TEST_CASE("a rigid contact gives back half of the turn of a concave wall, and never more than it takes",
    "[stabilisation][tube]")
{
    LawOfStep step{.h = h, .rigid = true};
    const auto target = [&](double gap, double u_n, double turned) {
        auto at_wall = event(gap > 0.0 ? ContactKind::open : ContactKind::resting, gap, u_n);
        at_wall.u_n_turned = turned;
        return normal_law(at_wall, step).target;
    };
    CHECK(target(-1e-5, -0.5, -0.8) == Approx(0.4)); // on the chords of a circle u_n is half of the turn
    CHECK(target(-1e-5, -0.8, -0.8) == Approx(0.4)); // from its tangent
    CHECK(target(-1e-5, -0.1, -0.8) == Approx(0.1)); // no more than it comes with
    CHECK(target(-1e-5, 0.1, -0.8) == 0.0);
    CHECK(target(-1e-5, -0.5, 0.8) == 0.0); // a convex wall
    CHECK(target(1e-4, -0.5, -0.8) == Approx(0.4 - 0.1));
    step.rigid = false;
    CHECK(target(1e-4, -0.5, -0.8) == Approx(-0.1));
}

TEST_CASE("what a load presses is compression at once, any other overlap with the push-out speed",
    "[stabilisation][compression]")
{
    const double h_before = 2.0 * h, gained = 0.05 * h;
    const LawOfStep step{.h = h, .h_before = h_before, .push_out_speed = 0.05};
    const auto compressed = [&](double gap, double before, double u_n, bool loaded) {
        return compression<double>(gap, before, u_n, loaded, step);
    };
    CHECK(compressed(-1.0, nowhere, nowhere, false) == Approx(gained)); // fresh, or closed by what it has not borne
    CHECK(compressed(-1.0, 0.1, -2.0, true) == Approx(0.1 + 2.0 * h_before + gained));
    CHECK(compressed(-1.0, 0.1, 2.0, true) == Approx(0.1 - 2.0 * h_before + gained));
    CHECK(compressed(-1.0, h, 2.0, true) == Approx(gained)); // all of it has been given back
    CHECK(compressed(-0.1, 0.2, -2.0, true) == 0.1);         // never more than the overlap
    CHECK(compressed(1e-4, 0.2, -2.0, true) == 0.0);
}
