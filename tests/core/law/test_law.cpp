// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/region.hpp"
#include "core/law/impact.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace talus;

namespace
{

constexpr double h = 1e-3;
constexpr double elastic = 0.02;                                     // [m/s]
constexpr double threshold = 0.03;                                   // [m/s]
constexpr double w = 2.0;                                            // [1/kg]
constexpr double d = 0.01;                                           // [m]
constexpr double nowhere = std::numeric_limits<double>::quiet_NaN(); // must not be read

/// A step in which matched contacts push out what overlaps with 0.05 m/s.
LawOfStep matched(double parts = 1.0)
{
    return {.h = h / parts,
        .threshold_speed = threshold,
        .elastic_speed = elastic,
        .push_out_speed = 0.05,
        .parts = parts,
        .min_diameter = d};
}

LawOfStep rigid()
{
    return {.h = h, .threshold_speed = threshold, .rigid = true, .push_out_speed = 0.05, .min_diameter = d};
}

/// A contact with W = 2/kg and e = 0.4 between rigid spheres.
ContactEvent<double> event(double gap, double u_n, double load = 0.0, double compression = 0.0)
{
    return {gap, d, 0.25 * d, u_n, u_n, nowhere, w, 0.4, infinity, load, compression, false};
}

/// Σ_n of that contact.
constexpr double sigma = 0.2 / 2 * w;

bool impact(double gap, double u_n, double closes, double load = 0.0, double restitution = 0.4)
{
    ContactEvent<double> at = event(gap, u_n, load);
    at.closes = closes;
    at.restitution = restitution;
    return is_impact<double>(at, matched());
}

NormalLaw<double> law_of(const ContactEvent<double>& at, const LawOfStep& step, bool is_impact = false)
{
    return normal_law<double>(at, is_impact, step);
}

/// The u_n that a contact asks for which bears nothing.
double most_asked(const ContactEvent<double>& at, const LawOfStep& step)
{
    const auto law = law_of(at, step);
    return std::min(law.target, law.parting);
}

double closing(const Vec3& across, const Vec3& velocity, double radii)
{
    return closing_time<double>(-across.dot(velocity), velocity.squaredNorm(), across.squaredNorm() - radii * radii);
}

/// Numbers at random, evenly between two.
struct Between {
    Random random;
    double operator()(double least, double most) { return least + (most - least) * uniform(random); }
};

/// q_n of a contact with this load beside an impact of 1 N s.
double target_beside(double load, double gap, double u_n, const LawOfStep& step)
{
    const auto law = beside_impact({.gap = gap,
                                       .u_n = u_n,
                                       .compression = 0.0,
                                       .impulse = load / step.parts,
                                       .was_impact = false,
                                       .impact = 1.0,
                                       .pressed = 0.0},
        step);
    REQUIRE(law);
    CHECK(law->kind == (load > 0.0 ? ContactKind::bearing : ContactKind::deferred));
    return law->target;
}

/// What a spring holds [J].
double spring_energy(double kappa, double u_n, double compliance, double inverse_mass_sum, const LawOfStep& step)
{
    const double square = spring_square<double>(kappa, u_n, compliance, inverse_mass_sum, step);
    return energy_of_square<double>(square, compliance, inverse_mass_sum, step);
}

} // namespace

TEST_CASE("spheres touch when the distance of their free paths is that of their radii", "[law]")
{
    CHECK(closing(Vec3(3, 0, 0), Vec3(-2, 0, 0), 2.0) == Approx(0.5));
    CHECK(closing(Vec3(2, 0, 0), Vec3(-2, 0, 0), 2.0) == 0.0);
    CHECK(closing(Vec3(1, 0, 0), Vec3(-2, 0, 0), 2.0) == Approx(-0.5)); // they have, half a second ago
    CHECK(closing(Vec3(3, 0, 0), Vec3(2, 0, 0), 2.0) == infinity);      // they part
    CHECK(closing(Vec3(3, 0, 0), Vec3::Zero(), 2.0) == infinity);       // at rest
    CHECK(closing(Vec3(3, 0, 2.001), Vec3(-2, 0, 0), 2.0) == infinity); // they pass by
    const Vec3 across(3, 1, -0.5), velocity(-2, 0.1, 0.2);
    const double closes = closing(across, velocity, 2.0);
    CHECK((across + closes * velocity).norm() == Approx(2.0));
    CHECK((across + 0.5 * closes * velocity).norm() > 2.0); // for the first time
}

TEST_CASE("an impact is fast, closes in this step, and has no load to count", "[law]")
{
    CHECK(impact(-1e-5, -1.0, nowhere));
    CHECK(impact(-1e-5, -1.0, nowhere, 0.0, 0.0)); // without restitution too: it stops
    CHECK_FALSE(impact(-1e-5, -0.99 * threshold, nowhere));
    CHECK(impact(-1e-5, -1.01 * threshold, nowhere));
    CHECK(impact(1e-4, -1.0, 1e-4));           // an open gap that closes in this step
    CHECK_FALSE(impact(1e-3, -1.0, h));        // in the next one
    CHECK_FALSE(impact(1e-4, -1.0, infinity)); // or never
    CHECK_FALSE(impact(1e-4, 0.1, infinity));
    CHECK(impact(1e-10 * d, -1.0, infinity)); // touching, but for rounding
    // By itself it would have (1 + e) |u_n| / W; a ten-thousandth of that is a load.
    const double size = 1.4 * 1.0 / w;
    CHECK(impact_size<double>(event(-1e-5, -1.0)) == Approx(size));
    CHECK(impact_size<double>(event(-1e-5, 1.0)) == 0.0);
    CHECK(impact(-1e-5, -1.0, nowhere, 0.99e-4 * size));
    CHECK_FALSE(impact(-1e-5, -1.0, nowhere, 1.01e-4 * size));
    // What impacts have not stopped by 0.4 d of overlap is none any more, but yields.
    CHECK(impact(-0.399 * d, -1.0, nowhere));
    CHECK_FALSE(impact(-0.401 * d, -1.0, nowhere));
}

TEST_CASE("what has been an impact and would not rebound again rests, unless it has come apart since", "[law]")
{
    const auto again = [](double gap) {
        ContactEvent<double> at = event(gap, -2.0 * threshold); // it would rebound with 0.8 of the slowest impact
        at.closes = 0.5 * h;
        at.struck = true;
        return is_impact<double>(at, matched());
    };
    CHECK_FALSE(again(-1e-5));
    CHECK_FALSE(again(0.0));
    CHECK(again(1e-5));
}

TEST_CASE("an impact rebounds with e, however deep it is, and leaves no spring", "[law]")
{
    for (const LawOfStep& step : {matched(), rigid()})
        for (const double gap : {1e-4, 0.0, -1e-5, -0.1 * d}) {
            const auto law = law_of(event(gap, -1.0, 0.0, 1e-5), step, true);
            CHECK(law.target == Approx(0.4));
            CHECK(law.compliance == 0.0);
            CHECK(law.parting == infinity);
            CHECK(law.compression == -infinity);
        }
}

TEST_CASE("an open gap may close in one step, and takes no energy in", "[law]")
{
    for (const LawOfStep& step : {matched(), rigid()}) {
        const auto law = law_of(event(1e-4, -1.0), step);
        CHECK(law.target == Approx(-0.1));                         // u_n ≥ −g/h
        CHECK(law.compliance == Approx(step.rigid ? 0.0 : sigma)); // it is to be a spring
        CHECK(law.parting == infinity);
        CHECK(law.compression == -infinity);
        // Of one that parts it asks for no more than that it comes back as fast as it went.
        CHECK(law_of(event(1e-4, 0.5), step).target == Approx(-0.5));
    }
}

TEST_CASE("a spring asks for 4Υ κ/h, whatever its velocity is, and is as soft as sweeps or the material ask", "[law]")
{
    for (const double u_n : {-0.09, 0.0, 0.2}) {
        const auto law = law_of(event(-1e-5, u_n, 0.1, 1e-5), matched());
        CHECK(law.compression == Approx(1e-5));
        CHECK(law.target == Approx(4.0 / 9.0 * 1e-5 / h));
        CHECK(law.compliance == Approx(sigma));
        // It parts with e of what it might at most, or as fast as it closed.
        CHECK(law.parting == Approx(std::max(elastic / 3 + 0.4 * 1e-5 / h, -u_n)));
    }
    auto soft = event(-1e-5, 0.0, 0.1, 1e-5);
    soft.stiffness = 100.0;
    CHECK(law_of(soft, matched()).compliance == Approx(4.0 / 9.0 / (100.0 * h * h)));
    soft.stiffness = 1e12;
    CHECK(law_of(soft, matched()).compliance == Approx(sigma));
    LawOfStep more_sweeps = matched();
    more_sweeps.min_sweeps = 8.0;
    CHECK(law_of(soft, more_sweeps).compliance == Approx(sigma / 4));
}

TEST_CASE("of an overlap, compression is what a load has pressed and what is pushed out since", "[law][spring]")
{
    const double gained = 0.05 * h;
    const auto compression = [&](double gap, double before) {
        return law_of(event(gap, -0.01, 0.1, before), matched()).compression;
    };
    CHECK(compression(-1e-4, 0.0) == Approx(gained));
    CHECK(compression(-1e-4, 2e-5) == Approx(2e-5 + gained));
    CHECK(compression(-1e-5, 1e-3) == 1e-5);                 // never more than the overlap
    CHECK(compression(-1e-4, 0.9e-9 * d) == Approx(gained)); // no more than rounding: none
    CHECK(compression(1e-5, 1e-3) == -infinity);             // apart
    CHECK(law_of(event(-1e-5, -0.01, 0.1, 1e-5), rigid()).compression == -infinity);
}

TEST_CASE("an overlap without a spring becomes one only where it does not part", "[law][spring]")
{
    CHECK(law_of(event(-1e-5, -0.01), matched()).compression == 1e-5);
    CHECK(law_of(event(-1e-5, 0.0), matched()).compression == 1e-5);
    CHECK(law_of(event(-1e-5, 0.01), matched()).compression == -infinity);
    CHECK(law_of(event(-1e-5, 0.01, 0.1, 1e-5), matched()).compression == 1e-5); // it is one
}

TEST_CASE("a rigid contact stops what comes, and does not hold what leaves", "[law]")
{
    CHECK(most_asked(event(-1e-5, -0.09, 0.0, 1e-5), rigid()) == 0.0);
    CHECK(law_of(event(-1e-5, -0.09, 0.0, 1e-5), rigid()).parting == 0.0);
    CHECK(most_asked(event(-1e-5, 0.5), rigid()) == -0.5); // and so takes no energy in
    // But for what sweeps leave undone of a load, up to the speed of pushing out.
    CHECK(most_asked(event(-1e-3, 0.5, 0.05), rigid()) == Approx(2 * undone_share * w * 0.05 - 0.5));
    CHECK(most_asked(event(-1e-3, 0.5, 50.0), rigid()) == Approx(2 * 0.05 - 0.5));
    CHECK(most_asked(event(-1e-5, 0.5, 50.0), rigid()) == Approx(8.0 / 9.0 * 1e-5 / h - 0.5));
    CHECK(most_asked(event(-1e-3, 0.01, 0.5), rigid()) == 0.0);
}

TEST_CASE("a rigid contact is so where it is shallow, and bears what its overlap would as a spring", "[law][press]")
{
    CHECK(law_of(event(-0.01 * d, -0.1), rigid()).target == Approx(4.0 / 9.0 * 0.01 * d / h));
    CHECK(law_of(event(-0.01 * d, -0.1), rigid()).parting == 0.0);
    const auto compliance = [](double overlap) { return law_of(event(-overlap * d, -0.1), rigid()).compliance / w; };
    CHECK(compliance(0.0) == 0.0);
    CHECK(compliance(1e-4) < 1e-9);
    CHECK(compliance(0.5 * rigid_yield_overlap) == Approx(rigid_softness / 16));
    CHECK(compliance(rigid_yield_overlap) == Approx(rigid_softness));
    CHECK(compliance(0.2) == Approx(rigid_softness));
}

TEST_CASE(
    "against a wall that gets faster a contact is passive as its sphere was, and an impact as it is", "[law][walls]")
{
    // The wall gains 0.1 m/s towards a sphere that has gone with it: that is no velocity which it may give back.
    const auto of = [](double gap, double u_n_before, const LawOfStep& step, bool is_impact = false) {
        auto at = event(gap, u_n_before - 0.1);
        at.u_n_before = u_n_before;
        return law_of(at, step, is_impact);
    };
    for (const double u_n : {0.0, 0.2})
        CHECK(std::min(of(-1e-5, u_n, rigid()).target, of(-1e-5, u_n, rigid()).parting) == -u_n);
    CHECK(of(1e-5, 0.2, matched()).target == -0.2);
    CHECK(of(-1e-5, 0.0, matched()).compression == 1e-5);
    CHECK(of(-1e-5, 0.05, matched()).compression == -infinity);
    CHECK(of(-1e-5, -0.4, matched(), true).target == Approx(0.4 * 0.5));
}

namespace
{

/// Where a contact begins to yield, in reduced radii: sought.
double yields_at(double u_n, double reduced_radius = 0.25 * d)
{
    double shallow = 0.0, deep = 0.5;
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (shallow + deep);
        auto at = event(-middle * reduced_radius, u_n);
        at.reduced_radius = reduced_radius;
        (overstrained<double>(at, matched()) ? deep : shallow) = middle;
    }
    return deep;
}

} // namespace

TEST_CASE(
    "a deep contact yields: it bears as a spring that all of its overlap has pressed, and parts slowly", "[law][press]")
{
    LawOfStep step = matched();
    for (const double u_n : {-1.0, 0.0, 1.0}) CHECK(yields_at(u_n) == Approx(yield_overlap));
    CHECK(yields_at(0.0, 0.5 * d) == Approx(yield_overlap)); // at a wall

    const double begins = yield_overlap * 0.25 * d, overlap = begins * (1 + 1e-9);
    const auto barely = law_of(event(-overlap, -0.01, 1.0, d), step);
    CHECK(barely.compliance == sigma);
    CHECK(barely.target == Approx(4.0 / 9.0 * overlap / h)); // as the spring that it was
    CHECK(barely.target == Approx(law_of(event(-begins * (1 - 1e-9), -0.01, 1.0, d), step).target));
    CHECK(barely.parting == Approx(0.05 * step.push_out_speed)); // p times its overlap over R* …
    CHECK(law_of(event(-2 * begins, -0.01), step).parting == Approx(0.1 * step.push_out_speed));
    CHECK(
        law_of(event(-0.4 * d, -0.01), step).parting == Approx(step.elastic_speed)); // … no faster than impacts begin,
    // What a load has pressed, it keeps until there: 0.01 m/s take half of their way in this step from it.
    CHECK(barely.compression == Approx(begins - 0.5 * h * 0.01));
    // The deeper it is, the less is left of it.
    CHECK(law_of(event(-10 * begins, 0.0, 1.0, d), step).compression == Approx(begins / 10));
    step.push_out_speed = 0.5 * step.elastic_speed;
    CHECK(law_of(event(-0.2 * d, -1.0), step).parting == Approx(0.8 * step.push_out_speed));
    CHECK(law_of(event(-0.4 * d, -1.0), step).parting == step.push_out_speed); // … nor than with p
    CHECK(law_of(event(-0.2 * d, -1.0), step).target == Approx(4.0 / 9.0 * 0.2 * d / h));
    CHECK(law_of(event(-0.2 * d, 0.2), matched()).parting <= 0.0); // it adds no energy: what parts is left to do so

    // Deeper than a quarter it gets stiffer, with one over the square of how far the centre is, at half a diameter of
    // overlap, but for a thousandth of one.
    const auto stiffer = [&](double at) { return barely.compliance / law_of(event(-at * d, -0.1), step).compliance; };
    CHECK(stiffer(0.25) == Approx(1.0));
    CHECK(stiffer(0.375) == Approx(4.0));
    CHECK(stiffer(0.499) == Approx(std::pow(0.25 / least_rest, 2)));
    CHECK(stiffer(0.9) == Approx(std::pow(0.25 / least_rest, 2)));

    const auto of_rigid = law_of(event(-0.375 * d, -0.1), rigid());
    CHECK(of_rigid.compliance == Approx(rigid_softness * w / 4.0));
    CHECK(of_rigid.parting == 0.0);
}

TEST_CASE("springs of a split step bear at rest what those of the whole step would", "[law][sub_steps]")
{
    // Force λ/h of a contact at rest, u_n⁺ = 0.
    const auto force = [](double stiffness, double parts) {
        const LawOfStep step = matched(parts);
        auto at = event(-1e-5, 0.0, 0.1, 1e-5);
        at.stiffness = stiffness;
        const auto law = law_of(at, step);
        return law.target / law.compliance / step.h;
    };
    // As stiff as sweeps can carry in the whole step: 4Υ/(Σ h²) = 2.2e6 N/m, and in a ninth of it 81 times that.
    const double stiffest = 4.0 / 9.0 / (sigma * h * h);
    for (const double parts : {1.0, 2.0, 9.0}) {
        CAPTURE(parts);
        CHECK(force(infinity, parts) == Approx(stiffest * 1e-5));
        CHECK(force(10.0 * stiffest, parts) == Approx(stiffest * 1e-5));
        CHECK(force(0.1 * stiffest, parts) == Approx(0.1 * stiffest * 1e-5));
    }
}

TEST_CASE("a loaded spring beside any other contacts takes (u_n⁺ + u_n)²/(4 Σ_n) out of the energy", "[law][energy]")
{
    // E = ½ λ (u⁺ + u) + what the spring holds after less what it held; others make u⁺ whatever it is, and λ follows.
    Between between{Random(1)};
    for (int k = 0; k < 200; ++k) {
        CAPTURE(k);
        const LawOfStep step = matched(k % 2 ? 1.0 : 3.0);
        const double kappa = between(1e-6, 1e-4), u_before = between(-0.02, 0.02), u_after = between(-0.02, 0.002);
        auto at = event(-kappa, u_before, 0.1, kappa);
        at.stiffness = k % 3 ? infinity : between(1e5, 1e7);
        const auto law = law_of(at, step);
        REQUIRE(law.compression == kappa);
        const double impulse = (law.target - u_after) / law.compliance;
        if (impulse <= 0.0) continue;
        const double after = compression_after<double>(kappa, -kappa, u_after, 1.0, step);
        if (after <= 0.0) continue;
        const auto holds = [&](double compression, double u_n) {
            return spring_energy(compression, u_n, law.compliance, w, step);
        };
        const double change = 0.5 * impulse * (u_after + u_before) + holds(after, u_after) - holds(kappa, u_before);
        const double sum = u_after + u_before;
        CHECK(change == Approx(-sum * sum / (4.0 * law.compliance)).epsilon(1e-9).margin(1e-12));
    }
}

TEST_CASE(
    "a contact that yields puts in no more than its push and what pushing out adds to its spring", "[law][energy]")
{
    Between between{Random(7)};
    int bears = 0, parts = 0;
    for (int k = 0; k < 2000; ++k) {
        CAPTURE(k);
        const LawOfStep step = matched(k % 2 ? 1.0 : 3.0);
        const double gap = between(-0.4 * d, -0.013 * d), u_before = between(-0.3, 0.1);
        const auto at = event(gap, u_before, 0.1, std::min(-gap, between(0.0, 0.1 * d)));
        const auto law = law_of(at, step);
        REQUIRE(overstrained<double>(at, step));
        const auto holds = [&](double compression, double u_n) {
            return compression > 0.0 ? spring_energy(compression, u_n, sigma, w, step) : 0.0;
        };
        const double u_after = std::min(between(-0.3, 0.1), law.parting);
        const double most = (law.target - u_after) / law.compliance;
        const bool opens = u_after == law.parting; // then any impulse up to that obeys its law
        const double impulse = opens ? between(0.0, std::max(0.0, most)) : most;
        if (impulse <= 0.0) continue;
        ++(opens ? parts : bears);
        const double after = compression_after<double>(law.compression, gap, u_after, 1.0, step);
        const double grown = law.compression > 0.0
                                 ? holds(law.compression, u_before) - holds(law.compression - law.grown, u_before)
                                 : 0.0;
        const double change =
            0.5 * impulse * (u_after + u_before) + holds(after, u_after) - holds(at.compression, u_before);
        CHECK(change <= law.push * impulse + std::max(0.0, grown) + 1e-12);
    }
    CHECK(bears > 300);
    CHECK(parts > 200);
}

TEST_CASE("a row without a spring puts in no more than λ_n times the speed with which it pushes", "[law][energy]")
{
    // A rigid row that has an impulse ends with u_n⁺ = q, and adds ½ λ (q + u_n), or less with Σ λ or a parting speed.
    Between between{Random(2)};
    int pushing = 0;
    for (int k = 0; k < 1000; ++k) {
        CAPTURE(k);
        const LawOfStep step = k % 2 ? rigid() : matched(k % 4 ? 1.0 : 3.0);
        const auto at = event(between(-0.24 * d, 0.04 * d), between(-0.2, 0.2), step.rigid ? between(0.0, 0.1) : 0.0);
        const auto law = law_of(at, step);
        const double per_impulse = 0.5 * (std::min(law.target, law.parting) + at.u_n);
        const double push = at.gap > 0.0 ? 0.0 : std::min(step.push_out_speed, 4.0 / 9.0 * -at.gap / step.h);
        CHECK(per_impulse <= push * (1 + 1e-12) + 1e-15);
        // What is reported of a contact that keeps no spring is no less than that, and no more than its speed.
        if (law.compression > 0.0 && !overstrained<double>(at, step)) {
            CHECK(law.push == 0.0); // a spring has its own books
            continue;
        }
        CHECK(law.push >= per_impulse * (1 - 1e-12) - 1e-15);
        CHECK(law.push <= push * (1 + 1e-12));
        pushing += per_impulse > 0.5 * law.push;
    }
    CHECK(pushing > 50);
}

TEST_CASE("a rigid row without a load, and an open one, put no energy in", "[law][energy]")
{
    Between between{Random(3)};
    for (int k = 0; k < 200; ++k) {
        const auto at = event(between(-0.06 * d, 0.01 * d), between(-0.2, 0.2));
        const auto law = law_of(at, rigid());
        CHECK(0.5 * (std::min(law.target, law.parting) + at.u_n) <= 1e-15); // for each N s
        if (at.gap > 0.0) CHECK(0.5 * (law_of(at, matched()).target + at.u_n) <= 1e-15);
    }
}

TEST_CASE("a spring gives back what it was pressed, and what e leaves of it where it is fast", "[law][spring]")
{
    const auto after = [](double kappa, double u_n, double restitution) {
        return compression_after<double>(kappa, -kappa, u_n, restitution, matched());
    };
    for (const double restitution : {1.0, 0.5, 0.0}) {
        CHECK(after(1e-4, -0.02, restitution) == Approx(1e-4 + h * 0.02));
        CHECK(after(1e-4, -1.0, restitution) == Approx(1e-4 + h * 1.0)); // pressed, however fast
        CHECK(after(1e-4, elastic, restitution) == Approx(1e-4 - h * elastic));
    }
    // What parts faster gives way 1/e² as fast, by what it is faster: four times.
    CHECK(after(1e-4, elastic + 0.01, 1.0) == Approx(1e-4 - h * (elastic + 0.01)));
    CHECK(after(1e-4, elastic + 0.01, 0.5) == Approx(1e-4 - h * (elastic + 4 * 0.01)));
    CHECK(after(1e-4, elastic + 0.01, 0.0) == Approx(1e-4 - h * (elastic + 16 * 0.01)));
    CHECK(after(-infinity, -0.1, 1.0) == -infinity);
}

TEST_CASE("a spring that a load has left holds no more than it did, and κ goes with its gap", "[law][spring]")
{
    const LawOfStep step = matched();
    const auto holds = [&](double kappa, double u_n) { return spring_square<double>(kappa, u_n, sigma, w, step); };
    Between between{Random(9)};
    for (int k = 0; k < 500; ++k) {
        CAPTURE(k);
        const double kappa = between(1e-6, 1e-4), before = between(-0.1, 0.1), u_n = between(-0.1, 0.1);
        const double restitution = between(0.0, 1.0), gap = -kappa;
        const double handed = handed_on<double>(kappa, holds(kappa, before), u_n, 0.0, sigma, w, step);
        CHECK(handed == holds(kappa, before));
        const double taken = taken_over<double>(std::sqrt(handed), false, gap, u_n, restitution, sigma, w, step);
        if (taken > 0.0) CHECK(holds(taken, u_n) <= handed * (1 + 1e-12));
    }
    // What was at rest and opens has lost the way that it has opened, and more where that was fast and e is small.
    const auto opened = [&](double u_n, double restitution) {
        return taken_over<double>(1e-4, false, -1e-4, u_n, restitution, sigma, w, step);
    };
    CHECK(opened(elastic, 0.0) == Approx(1e-4 - h * elastic));
    CHECK(opened(elastic + 0.01, 0.5) == Approx(1e-4 - h * (elastic + 4 * 0.01)));
}

TEST_CASE("what a spring hands on is its energy, and the same κ where its normal does not turn", "[law][spring]")
{
    LawOfStep step = matched();
    step.parts = GENERATE(1.0, 4.0);
    constexpr double w = 2.0, sigma = 0.1 * w;
    const auto hands_on = [&](double kappa, double u_n) {
        return std::sqrt(handed_on<double>(kappa, 0.0, u_n, 0.1, sigma, w, step));
    };
    const auto takes_over = [&](double handed, double u_n) {
        return taken_over<double>(handed, true, -1e-4, u_n, 0.4, sigma, w, step);
    };
    const auto energy = [&](double kappa, double u_n) { return spring_energy(kappa, u_n, sigma, w, step); };
    for (const double u_n : {-0.01, 0.0, 0.01})
        for (const double turned : {u_n - 0.01, u_n, u_n + 0.01}) {
            const double kappa = takes_over(hands_on(1e-4, u_n), turned);
            REQUIRE(kappa > 0.0);
            CHECK(energy(kappa, turned) == Approx(energy(1e-4, u_n)));
            if (turned == u_n) CHECK(kappa == Approx(1e-4));
        }
    CHECK(takes_over(hands_on(1e-6, 0.0), 1.0) == 0.0); // no spring holds so little at that speed
    CHECK(hands_on(0.0, 0.1) == 0.0);                   // no spring
    CHECK(hands_on(0.9e-9 * d, 0.1) == 0.0);
    CHECK(hands_on(compression_after<double>(1e-5, -1e-5, 0.02, 1.0, step), 0.02) == 0.0); // all is given back
    CHECK(hands_on(compression_after<double>(1e-4, -1e-4, elastic + 0.5, 0.0, step), elastic + 0.5) == 0.0);
    CHECK(hands_on(-infinity, -0.1) == 0.0);
    CHECK(takes_over(0.0, -0.1) == 0.0);
    // A spring that a step has pressed is handed on as one, however fast.
    const double after = compression_after<double>(1e-6, -1e-6, -5.0, 0.4, step);
    CHECK(takes_over(hands_on(after, -5.0), -5.0) == Approx(1e-6 + h * 5.0));
}

TEST_CASE("beside an impact a contact without a load closes to 0.4 smallest diameters at most", "[law][impact]")
{
    const LawOfStep step = matched();
    for (const double gap : {1e-4, -1e-4, -0.1 * d}) {
        // With u_n⁺ = q the overlap after the step is −(g + h q).
        CHECK(-(gap + h * target_beside(0.0, gap, -1.0, step)) == Approx(0.4 * d));
        CHECK(target_beside(0.0, gap, 50.0, step) == -50.0); // and it takes no energy in
    }
    // One that is deeper is let out, as fast as it comes at most.
    CHECK(target_beside(0.0, -0.5 * d, -0.1, step) == Approx(0.1));
    CHECK(target_beside(0.0, -0.5 * d, -5.0, step) == Approx(0.1 * d / h));
}

TEST_CASE("beside an impact a contact with a load is rigid, and takes no energy in", "[law][impact]")
{
    CHECK(target_beside(0.01, -1e-4, -0.3, matched()) == 0.0);
    CHECK(target_beside(0.01, 1e-4, -0.3, matched()) == Approx(-0.1)); // to where it touches
    for (const double gap : {1e-4, -1e-4}) CHECK(target_beside(0.01, gap, 0.3, matched()) == -0.3);
}

TEST_CASE("a spring that bears an impact comes to hold no more than it did", "[law][impact][energy]")
{
    CHECK(borne_compression<double>(1e-4, 0.05, matched()) == 1e-4);
    CHECK(borne_compression<double>(1e-4, -0.05, matched()) == Approx(1e-4 - 0.5 * h * 0.05));
    CHECK(borne_compression<double>(1e-5, -0.05, matched()) == -infinity);
    Between between{Random(4)};
    int kept = 0;
    for (int k = 0; k < 200; ++k) {
        const LawOfStep step = matched(k % 2 ? 1.0 : 3.0);
        const double kappa = between(1e-6, 1e-4), u_n = between(-0.05, 0.02);
        const double begins = borne_compression<double>(kappa, u_n, step),
                     u_after = target_beside(0.01, -kappa, u_n, step);
        const double after = compression_after<double>(begins, -begins, u_after, 1.0, step);
        const auto holds = [&](double compression, double speed) {
            return spring_energy(compression, speed, sigma, w, step);
        };
        if (!(after > 0.0)) continue;
        ++kept;
        CHECK(holds(after, u_after) <= holds(kappa, u_n) * (1 + 1e-12));
        // One that parted comes back with as much: it holds what it did.
        if (u_n > 0.0) CHECK(holds(after, u_after) == Approx(holds(kappa, u_n)));
    }
    CHECK(kept > 50);
}
