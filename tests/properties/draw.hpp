// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/vector.hpp"

#include <cmath>
#include <cstdint>
#include <initializer_list>

namespace talus::test
{

/// Random numbers of a seed, the same everywhere; seeds that follow each other have nothing in common (SplitMix64).
class Draw
{
public:
    explicit Draw(std::uint64_t seed) : state_(mixed(seed ^ 0x632be59bd9b4e019U)) {}

    double uniform(double from, double to)
    {
        return from + (to - from) * 0x1.0p-53 * static_cast<double>(next() >> 11);
    }
    /// Its logarithm is uniform.
    double log_uniform(double from, double to) { return std::exp(uniform(std::log(from), std::log(to))); }
    bool chance(double probability) { return uniform(0, 1) < probability; }
    int integer(int from, int to) ///< both ends included
    {
        return from + static_cast<int>(next() % static_cast<std::uint64_t>(to - from + 1));
    }
    template <class T> T one_of(std::initializer_list<T> choices)
    {
        return choices.begin()[integer(0, static_cast<int>(choices.size()) - 1)];
    }
    double sign() { return chance(0.5) ? 1.0 : -1.0; }
    Vec3 in_cube() { return {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}; }
    Vec3 direction()
    {
        for (;;)
            if (const Vec3 v = in_cube(); v.squaredNorm() < 1.0 && v.squaredNorm() > 1e-4) return v.normalized();
    }

private:
    std::uint64_t state_;

    std::uint64_t next() { return mixed(state_ += 0x9e3779b97f4a7c15U); }

    static std::uint64_t mixed(std::uint64_t z)
    {
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
        return z ^ (z >> 31);
    }
};

} // namespace talus::test
