// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/supply/size_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace talus
{
namespace
{

/// Φ, the share of the standard normal distribution below z.
double normal_below(double z)
{
    return 0.5 * std::erfc(-z / std::numbers::sqrt2);
}

double normal_density(double z)
{
    return std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
}

/// The standard normal variable with a share u of the distribution between a and b below it.
double draw_between(double a, double b, double u)
{
    const double share = std::lerp(normal_below(a), normal_below(b), u);
    // Bisection, because it cannot fail. Beyond 40 standard deviations there is nothing.
    double low = std::max(a, -40.0), high = std::min(b, 40.0);
    for (double middle = std::midpoint(low, high); low < middle && middle < high; middle = std::midpoint(low, high))
        (normal_below(middle) < share ? low : high) = middle;
    return high;
}

/// Where min and max cut a normal or lognormal distribution, in standard deviations from its centre.
std::pair<double, double> cuts(const SizeDistribution& sizes)
{
    const auto standard = [&](double d) {
        return ((sizes.law == SizeDistribution::Law::normal ? d : std::log(d)) - sizes.center) / sizes.spread;
    };
    return {standard(sizes.min), standard(sizes.max)};
}

/// Mean of d^power, power 1 or 3, over a normal distribution cut at both sides.
double normal_moment(const SizeDistribution& sizes, int power)
{
    const auto [a, b] = cuts(sizes);
    const double share = normal_below(b) - normal_below(a);
    const double at_a = normal_density(a) / share, at_b = normal_density(b) / share;
    // The moments of the cut standard distribution, each by parts from the one two below.
    const double first = at_a - at_b;
    const double second = 1.0 + a * at_a - b * at_b;
    const double third = 2.0 * first + a * a * at_a - b * b * at_b;
    const double m = sizes.center, s = sizes.spread;
    if (power == 1) return m + s * first;
    return m * m * m + 3.0 * m * m * s * first + 3.0 * m * s * s * second + s * s * s * third;
}

/// Mean of d^power over a lognormal distribution cut at both sides: d^k weights it into another lognormal, of a centre
/// that lies k s² higher.
double lognormal_moment(const SizeDistribution& sizes, int power)
{
    const auto [a, b] = cuts(sizes);
    const double m = sizes.center, s = sizes.spread;
    return std::exp(power * m + 0.5 * power * power * s * s) *
           (normal_below(b - power * s) - normal_below(a - power * s)) / (normal_below(b) - normal_below(a));
}

/// The diameter in a class below which a share u of its spheres lies.
double draw_in(const SieveClass& sieve, double u)
{
    const double fine = 1.0 / (sieve.min * sieve.min), coarse = 1.0 / (sieve.max * sieve.max);
    return std::clamp(1.0 / std::sqrt(std::lerp(fine, coarse, u)), sieve.min, sieve.max);
}

double mean_of(const SieveClass& sieve)
{
    return 2.0 * sieve.min * sieve.max / (sieve.min + sieve.max);
}

/// Mean of d³, by number.
double mean_cube_of(const SieveClass& sieve)
{
    return sieve.min * sieve.max * mean_of(sieve);
}

double draw_sieved(const std::vector<SieveClass>& classes, double u)
{
    for (const SieveClass& sieve : classes) {
        if (u < sieve.number) return draw_in(sieve, u / sieve.number);
        u -= sieve.number;
    }
    return classes.back().max; // the numbers add up to 1 but for rounding
}

double mean_sieved(const std::vector<SieveClass>& classes, double (*mean)(const SieveClass&))
{
    double sum = 0.0;
    for (const SieveClass& sieve : classes) sum += sieve.number * mean(sieve);
    return sum;
}

} // namespace

double SizeDistribution::draw(Random& random) const
{
    const double u = uniform(random);
    if (law == Law::uniform) return min + (max - min) * u;
    if (law == Law::sieve) return draw_sieved(classes, u);
    const auto [a, b] = cuts(*this);
    const double d = center + spread * draw_between(a, b, u);
    return std::clamp(law == Law::normal ? d : std::exp(d), min, max);
}

double SizeDistribution::mean() const
{
    switch (law) {
    case Law::normal:
        return normal_moment(*this, 1);
    case Law::lognormal:
        return lognormal_moment(*this, 1);
    case Law::sieve:
        return mean_sieved(classes, mean_of);
    case Law::uniform:
        break;
    }
    return 0.5 * (min + max);
}

double SizeDistribution::mean_volume() const
{
    constexpr double of_unit_sphere = std::numbers::pi / 6.0;
    switch (law) {
    case Law::normal:
        return of_unit_sphere * normal_moment(*this, 3);
    case Law::lognormal:
        return of_unit_sphere * lognormal_moment(*this, 3);
    case Law::sieve:
        return of_unit_sphere * mean_sieved(classes, mean_cube_of);
    case Law::uniform:
        break;
    }
    // The mean of d³ over a uniform distribution: (max⁴ − min⁴) / (4 (max − min)), written without the difference.
    return 0.25 * of_unit_sphere * (max + min) * (max * max + min * min);
}

double SizeDistribution::share_inside() const
{
    if (law != Law::normal && law != Law::lognormal) return 1.0;
    const auto [a, b] = cuts(*this);
    return normal_below(b) - normal_below(a);
}

SizeDistribution sieved_sizes(const std::vector<double>& sizes, const std::vector<double>& passing)
{
    SizeDistribution distribution;
    distribution.law = SizeDistribution::Law::sieve;
    double sum = 0.0;
    for (std::size_t k = 1; k < sizes.size(); ++k) {
        SieveClass sieve{sizes[k - 1], sizes[k], 0.0};
        sieve.number = (passing[k] - passing[k - 1]) / mean_cube_of(sieve);
        if (sieve.number <= 0.0) continue;
        sum += sieve.number;
        distribution.classes.push_back(sieve);
    }
    for (SieveClass& sieve : distribution.classes) sieve.number /= sum;
    distribution.min = distribution.classes.front().min;
    distribution.max = distribution.classes.back().max;
    return distribution;
}

} // namespace talus
