// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/supply/size_distribution.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace talus;

namespace
{

using Law = SizeDistribution::Law;

const SizeDistribution uniform_sizes{.min = 0.002, .max = 0.01};
const SizeDistribution normal_sizes{.min = 0.004, .max = 0.009, .law = Law::normal, .center = 0.006, .spread = 0.002};
const SizeDistribution lognormal_sizes{
    .min = 0.001, .max = 0.012, .law = Law::lognormal, .center = std::log(0.005), .spread = 0.5};

/// Mean of f(d) over a density that is known but for a factor, by Simpson's rule: right to ten digits.
double quadrature_mean(double min, double max, auto&& density, auto&& f)
{
    constexpr int intervals = 20000;
    double sum = 0.0, weight = 0.0;
    for (int k = 0; k <= intervals; ++k) {
        const double d = min + (max - min) * k / intervals;
        const double w = (k == 0 || k == intervals ? 1.0 : k % 2 ? 4.0 : 2.0) * density(d);
        weight += w;
        sum += w * f(d);
    }
    return sum / weight;
}

double normal_density(double d)
{
    return std::exp(-0.5 * std::pow((d - 0.006) / 0.002, 2));
}

double lognormal_density(double d)
{
    return std::exp(-0.5 * std::pow(std::log(d / 0.005) / 0.5, 2)) / d;
}

double volume_of(double d)
{
    return std::numbers::pi / 6.0 * d * d * d;
}

} // namespace

TEST_CASE("the means of cut normal and lognormal diameters are those of their densities", "[size_distribution]")
{
    const auto diameter = [](double d) { return d; };
    CHECK(normal_sizes.mean() == Approx(quadrature_mean(0.004, 0.009, normal_density, diameter)).epsilon(1e-9));
    CHECK(normal_sizes.mean_volume() == Approx(quadrature_mean(0.004, 0.009, normal_density, volume_of)).epsilon(1e-9));
    CHECK(lognormal_sizes.mean() == Approx(quadrature_mean(0.001, 0.012, lognormal_density, diameter)).epsilon(1e-9));
    CHECK(lognormal_sizes.mean_volume() ==
          Approx(quadrature_mean(0.001, 0.012, lognormal_density, volume_of)).epsilon(1e-9));
}

TEST_CASE("wide cuts leave the moments of the normal and the lognormal distribution", "[size_distribution]")
{
    const SizeDistribution normal{.min = 1.0, .max = 19.0, .law = Law::normal, .center = 10.0, .spread = 1.0};
    CHECK(normal.mean() == Approx(10.0).epsilon(1e-12));
    CHECK(normal.mean_volume() == Approx(std::numbers::pi / 6.0 * (1000.0 + 3.0 * 10.0)).epsilon(1e-12));
    const SizeDistribution lognormal{.min = 1e-3, .max = 1e3, .law = Law::lognormal, .center = 0.0, .spread = 0.3};
    CHECK(lognormal.mean() == Approx(std::exp(0.5 * 0.09)).epsilon(1e-12));
    CHECK(lognormal.mean_volume() == Approx(std::numbers::pi / 6.0 * std::exp(4.5 * 0.09)).epsilon(1e-12));
}

TEST_CASE("drawn diameters keep to their range and have the mean diameter and volume of their law", "[size_distribution]")
{
    const std::vector<SizeDistribution> laws = {
        uniform_sizes, normal_sizes, lognormal_sizes, sieved_sizes({0.001, 0.002, 0.004, 0.008}, {0.0, 0.2, 0.9, 1.0})};
    const auto& sizes = laws[GENERATE(range(std::size_t{0}, std::size_t{4}))];
    Random random(1);
    constexpr int draws = 100000;
    double sum = 0.0, squares = 0.0, volume = 0.0, volume_squares = 0.0;
    for (int k = 0; k < draws; ++k) {
        const double d = sizes.draw(random);
        REQUIRE((d >= sizes.min && d <= sizes.max));
        sum += d;
        squares += d * d;
        volume += volume_of(d);
        volume_squares += volume_of(d) * volume_of(d);
    }
    const auto standard_error = [](double total, double total_of_squares) {
        const double mean = total / draws;
        return std::sqrt((total_of_squares / draws - mean * mean) / draws);
    };
    CAPTURE(static_cast<int>(sizes.law));
    CHECK(std::abs(sum / draws - sizes.mean()) < 4.0 * standard_error(sum, squares));
    CHECK(std::abs(volume / draws - sizes.mean_volume()) < 4.0 * standard_error(volume, volume_squares));
}

TEST_CASE("sieved diameters reproduce the masses of their sieves, and between two sieves half of the mass at half way",
    "[size_distribution]")
{
    const std::vector<double> sizes = {0.001, 0.002, 0.004, 0.005, 0.008}, passing = {0.0, 0.2, 0.9, 0.9, 1.0};
    const auto distribution = sieved_sizes(sizes, passing);
    CHECK(distribution.min == 0.001);
    CHECK(distribution.max == 0.008);
    Random random(1);
    double mass = 0.0;
    // The mass that passes each sieve, and one half way from 2 to 4 mm.
    const std::vector<double> limits = {0.002, 0.003, 0.004, 0.005};
    std::vector<double> below(limits.size(), 0.0);
    for (int k = 0; k < 400000; ++k) {
        const double d = distribution.draw(random);
        CHECK_FALSE((d > 0.004 && d < 0.005)); // nothing is left on the sieve of 4 mm
        mass += volume_of(d);
        for (std::size_t i = 0; i < limits.size(); ++i)
            if (d <= limits[i]) below[i] += volume_of(d);
    }
    // The coarsest class is 0.6 % of the spheres, 2400 here: its mass is uncertain by 2 % and some, which is 0.25 % of
    // the whole.
    const std::vector<double> wanted = {0.2, 0.55, 0.9, 0.9};
    for (std::size_t i = 0; i < limits.size(); ++i) CHECK(below[i] / mass == Approx(wanted[i]).margin(0.008));
}

TEST_CASE("a normal distribution is drawn right from its tail", "[size_distribution]")
{
    // From 2 standard deviations above the mean on: 2.3 % of the distribution, of which 5.9 % lie above 3.
    const SizeDistribution tail{.min = 3.0, .max = 9.0, .law = Law::normal, .center = 1.0, .spread = 1.0};
    CHECK(tail.share_inside() == Approx(0.0227501319).epsilon(1e-8));
    Random random(3);
    int above = 0;
    for (int k = 0; k < 100000; ++k) above += tail.draw(random) > 4.0;
    CHECK(above / 100000.0 == Approx(0.0013498980 / 0.0227501319).margin(0.003)); // four standard errors
}
