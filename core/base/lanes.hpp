// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Arithmetic for one number (N = double) and for as many as a register holds, lane beside lane: what is not asked for
/// is worked out as well, and left aside.
namespace talus
{

/// Yes or no for each of these numbers.
template <class N> using Answer = decltype(N{} < N{});

/// Whether it is so for one of them at least: what only these need is not worked out for none.
template <class A> [[gnu::always_inline]] inline bool any_of(const A& answer)
{
    if constexpr (requires { answer[0]; }) {
        bool any = false;
        for (unsigned lane = 0; lane < sizeof(A) / sizeof answer[0]; ++lane) any |= answer[lane] != 0;
        return any;
    } else {
        return answer;
    }
}

template <class N> [[gnu::always_inline]] inline N smaller(const N& a, const N& b)
{
    return b < a ? b : a;
}

template <class N> [[gnu::always_inline]] inline N larger(const N& a, const N& b)
{
    return a < b ? b : a;
}

template <class N> [[gnu::always_inline]] inline N root(const N& square)
{
    if constexpr (requires { square[0]; }) {
        N roots;
        for (unsigned lane = 0; lane < sizeof(N) / sizeof(double); ++lane) roots[lane] = __builtin_sqrt(square[lane]);
        return roots;
    } else {
        return __builtin_sqrt(square);
    }
}

} // namespace talus
