// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/loop/run_statistics.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

using talus::EnergyBalance;
using talus::LogHistogram;
using talus::StepReport;

namespace
{

StepReport report(double kinetic, double potential, double contact_at_beginning)
{
    StepReport r;
    r.bodies.kinetic_energy = kinetic;
    r.bodies.potential_energy = potential;
    r.contacts.stored_energy = contact_at_beginning;
    return r;
}

} // namespace

TEST_CASE("energy that goes into the contacts and comes back is neither lost nor gained", "[app][energy]")
{
    // 1 J in all at the end of every step; the contacts' share of it is reported one step later
    EnergyBalance balance;
    balance.add(report(1.0, 0.0, 0.0), false);
    balance.add(report(0.4, 0.0, 0.0), true);
    balance.add(report(0.7, 0.0, 0.6), true);
    balance.add(report(1.0, 0.0, 0.3), true);
    balance.add(report(1.0, 0.0, 0.0), true);
    CHECK(balance.lost() == Approx(0.0).margin(1e-15));
    CHECK(balance.gained() == Approx(0.0).margin(1e-15));
}

TEST_CASE("falls and rises of the energy are summed apart", "[app][energy]")
{
    EnergyBalance balance;
    for (const double total : {5.0, 4.0, 4.5, 1.0, 1.0, 1.25})
        balance.add(report(0.25 * total, 0.75 * total, 0.0), true);
    balance.add(report(0.0, 0.0, 0.0), true); // the energy at the end of a step is known with the next
    CHECK(balance.lost() == Approx(1.0 + 3.5));
    CHECK(balance.gained() == Approx(0.5 + 0.25));
}

TEST_CASE("what loads and walls put in is no gain", "[app][energy]")
{
    EnergyBalance balance;
    balance.add(report(0.0, 0.0, 0.0), true);
    for (const double energy : {2.0, 5.0, 5.0}) {
        StepReport r = report(energy, 0.0, 0.0);
        r.outcome.wall_work = energy == 2.0 ? 1.5 : 0.0;
        r.bodies.load_work = energy == 2.0 ? 0.5 : balance.put_in() < 4.0 ? 3.0 : 0.0;
        balance.add(r, true);
    }
    CHECK(balance.put_in() == Approx(5.0));
    CHECK(balance.gained() == 0.0);
    CHECK(balance.lost() == 0.0);
}

TEST_CASE("what is lost in steps in which spheres come and go counts, and what they carry does not", "[app][energy]")
{
    EnergyBalance balance;
    const auto step = [&](double carried, double energy) {
        StepReport r = report(energy, 0.0, 0.0);
        r.exchange.energy = carried;
        balance.add(r, true);
    };
    step(0.0, 3.0);
    step(2.0, 4.0);  // of 5
    step(-1.5, 2.0); // of 2.5
    step(0.0, 2.0);
    step(0.0, 2.0);
    CHECK(balance.lost() == Approx(1.5));
    CHECK(balance.gained() == 0.0);
}

TEST_CASE("what spheres bring in and take away is not the steps' doing", "[app][energy]")
{
    EnergyBalance balance;
    balance.add(report(1.0, 0.0, 0.0), false);
    balance.add(report(1.0, 0.0, 0.0), true);
    balance.add(report(9.0, 0.0, 0.0), false);
    balance.add(report(9.0, 0.0, 0.0), true);
    balance.add(report(2.0, 0.0, 0.0), false);
    balance.add(report(2.0, 0.0, 0.0), true);
    balance.add(report(2.0, 0.0, 0.0), true);
    CHECK(balance.lost() == 0.0);
    CHECK(balance.gained() == 0.0);
}

TEST_CASE("percentiles of residuals are those of the sorted list to 2.4 %, mean and worst exact", "[app][statistics]")
{
    std::mt19937_64 random(1);
    std::normal_distribution<double> exponent(-2.0, 1.0);
    LogHistogram histogram;
    std::vector<double> all;
    double sum = 0.0;
    for (int k = 0; k < 10000; ++k) {
        all.push_back(std::pow(10.0, exponent(random)));
        histogram.add(all.back());
        sum += all.back();
    }
    std::sort(all.begin(), all.end());
    for (const double share : {0.01, 0.5, 0.95, 0.999}) {
        const double exact = all[static_cast<std::size_t>(share * 10000.0) - 1];
        CHECK(histogram.percentile(share) >= exact * (1 - 1e-12));
        CHECK(histogram.percentile(share) <= exact * 1.024);
    }
    CHECK(histogram.mean() == Approx(sum / 10000.0));
    CHECK(histogram.worst() == all.back());
    CHECK(histogram.percentile(1.0) <= all.back());
}

TEST_CASE("steps without contacts have residual 0, and no steps have none", "[app][statistics]")
{
    LogHistogram histogram;
    CHECK(histogram.percentile(0.95) == 0.0);
    CHECK(histogram.mean() == 0.0);
    for (int k = 0; k < 100; ++k) histogram.add(0.0);
    CHECK(histogram.percentile(0.95) == 0.0);
    histogram.add(1e9);
    CHECK(histogram.percentile(1.0) >= 1e3);
}
