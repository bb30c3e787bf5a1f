// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/loop/log_histogram.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

using talus::LogHistogram;

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
