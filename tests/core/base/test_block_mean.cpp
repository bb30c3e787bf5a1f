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
    CHECK(std::isnan(mean.error().error));
    mean.add(1.0);
    CHECK(mean.mean() == 1.0);
    CHECK(std::isnan(mean.error().error));
}

namespace
{

/// x_k+1 = a x_k + noise, of variance 1 in all: the variance of the mean of n is (1 + a) / (1 − a) / n, as if so many
/// samples were worth an independent one.
BlockMean mean_of_series(double a, int n, Random& random)
{
    BlockMean mean;
    double x = std::sqrt(12.0) * (uniform(random) - 0.5);
    for (int k = 0; k < n; ++k) {
        mean.add(x);
        x = a * x + std::sqrt(12.0 * (1.0 - a * a)) * (uniform(random) - 0.5);
    }
    return mean;
}

} // namespace

TEST_CASE("the error is that of the mean, for samples that remember as for those that do not", "[block_mean]")
{
    const double a = GENERATE(0.0, 0.5, 0.9);
    constexpr int n = 5000, runs = 60;
    Random random(1);
    double errors = 0.0, estimates = 0.0, independent = 0.0;
    for (int run = 0; run < runs; ++run) {
        const BlockMean mean = mean_of_series(a, n, random);
        CHECK_FALSE(mean.error().too_few);
        errors += mean.mean() * mean.mean() / runs;
        estimates += mean.error().error * mean.error().error / runs;
        independent += mean.error().independent / runs;
    }
    const double worth = (1.0 + a) / (1.0 - a);
    CHECK(errors == Approx(worth / n).epsilon(0.6));    // a mean square of 60 numbers: 18 % of error, three times that
    CHECK(estimates == Approx(worth / n).epsilon(0.2)); // of 60 times 19 blocks or more: 4 %, and what blocks share
    CHECK(independent == Approx(n / worth).epsilon(0.3));
}

TEST_CASE("samples that remember longer than blocks can be are said to be too few", "[block_mean]")
{
    // 400 samples, of which 400 are worth an independent one, or 2000: what error is reported is too small.
    const double a = GENERATE(0.995, 0.999);
    Random random(1);
    int told = 0;
    for (int run = 0; run < 100; ++run) told += mean_of_series(a, 400, random).error().too_few;
    CHECK(told >= 95);
}

TEST_CASE("so few samples that their scatter tells nothing are said to be too few", "[block_mean][degenerate]")
{
    BlockMean mean;
    for (const double x : {1.0, 2.0, 4.0}) {
        mean.add(x);
        CHECK(mean.error().too_few);
    }
    CHECK(mean.error().error == Approx(std::sqrt(7.0 / 9.0)));
}

TEST_CASE("what does not change has no error", "[block_mean][degenerate]")
{
    BlockMean mean;
    for (int k = 0; k < 100; ++k) mean.add(3.0, 2.0);
    CHECK(mean.error().error == 0.0);
    CHECK_FALSE(mean.error().too_few);
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
    CHECK(second.error().error == whole.error().error);
}
