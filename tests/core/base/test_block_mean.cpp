// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/block_mean.hpp"
#include "core/base/region.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace talus;

TEST_CASE("the mean weighs its samples and leaves out what is not a number", "[block_mean]")
{
    BlockMean mean;
    mean.add(1.0, 3.0);
    mean.add(5.0, 1.0);
    mean.add(NAN, 1.0);
    mean.add(7.0, 0.0);
    CHECK(mean.mean() == Approx(2.0));
}

TEST_CASE("without samples there is neither mean nor error", "[block_mean][degenerate]")
{
    BlockMean mean;
    CHECK(std::isnan(mean.mean()));
    CHECK(std::isnan(mean.standard_error()));
    mean.add(1.0);
    CHECK(mean.mean() == 1.0);
    CHECK(std::isnan(mean.standard_error()));
}

TEST_CASE("the error is that of the mean, for samples that remember as for those that do not", "[block_mean]")
{
    // x_k+1 = a x_k + noise, of variance 1 in all: the variance of the mean of n is (1 + a) / (1 − a) / n.
    const double a = GENERATE(0.0, 0.9);
    constexpr int n = 5000, runs = 60;
    Random random(1);
    double errors = 0.0, estimates = 0.0;
    for (int run = 0; run < runs; ++run) {
        BlockMean mean;
        double x = 0.0;
        for (int k = 0; k < n; ++k) {
            x = a * x + std::sqrt(12.0 * (1.0 - a * a)) * (uniform(random) - 0.5);
            mean.add(x);
        }
        errors += mean.mean() * mean.mean() / runs;
        estimates += mean.standard_error() * mean.standard_error() / runs;
    }
    const double expected = (1.0 + a) / (1.0 - a) / n;
    CHECK(errors == Approx(expected).epsilon(0.6));    // a mean square of 60 numbers: 18 % of error, three times that
    CHECK(estimates == Approx(expected).epsilon(0.3)); // of 60 times seven or more: 7 %, and what blocks share
}

TEST_CASE("a mean that was stored goes on as if nothing had been", "[block_mean][persist]")
{
    BlockMean whole, first;
    for (int k = 0; k < 37; ++k) {
        whole.add(k * k);
        first.add(k * k);
    }
    Archive stored;
    first.persist(stored);
    BlockMean second;
    Archive archive(stored.bytes());
    second.persist(archive);
    CHECK(archive.at_end());
    for (int k = 37; k < 100; ++k) {
        whole.add(k * k);
        second.add(k * k);
    }
    CHECK(second.mean() == whole.mean());
    CHECK(second.standard_error() == whole.standard_error());
}
