// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/packs/contact_pack.hpp"

#include <utility>

/// Numbers in registers of 2, 4 or 8, `width` of them, and vectors of such.
///
/// Files that include this are compiled for an instruction set of their own. Therefore nothing that they use may be an
/// inline function that another file could share: all are templates of the width, which belongs to one file only, and
/// nothing of Eigen or of the standard library is called.
namespace talus::packs
{

template <int width> struct Register {
    typedef double Numbers __attribute__((vector_size(width * sizeof(double)), may_alias));
    typedef std::int64_t Flags __attribute__((vector_size(width * sizeof(double)), may_alias));
    // In memory they may begin anywhere. (A memcpy moves 16 bytes at a time, and what is stored in halves has to reach
    // the cache before it can be read as a whole: a quarter of a sweep's time.)
    typedef Numbers StoredNumbers __attribute__((aligned(8)));
    typedef Flags StoredFlags __attribute__((aligned(8)));
    typedef float Floats __attribute__((vector_size(width * sizeof(float))));
    typedef std::uint32_t Words __attribute__((vector_size(width * sizeof(float))));
    typedef std::uint8_t Bytes __attribute__((vector_size(width)));
};
/// One number for each of `width` contacts.
template <int width> using Numbers = typename Register<width>::Numbers;
/// −1 for true, 0 for false.
template <int width> using Flags = typename Register<width>::Flags;

template <int width> [[gnu::always_inline]] inline Numbers<width> load(const double* from)
{
    return *reinterpret_cast<const typename Register<width>::StoredNumbers*>(from);
}

template <int width> [[gnu::always_inline]] inline Flags<width> load_flags(const std::int64_t* from)
{
    return *reinterpret_cast<const typename Register<width>::StoredFlags*>(from);
}

template <int width> [[gnu::always_inline]] inline void store(double* to, const Numbers<width>& numbers)
{
    *reinterpret_cast<typename Register<width>::StoredNumbers*>(to) = numbers;
}

template <int width> [[gnu::always_inline]] inline void store(std::int64_t* to, const Flags<width>& flags)
{
    *reinterpret_cast<typename Register<width>::StoredFlags*>(to) = flags;
}

template <int width> [[gnu::always_inline]] inline Numbers<width> root(const Numbers<width>& square)
{
    Numbers<width> numbers;
    for (int lane = 0; lane < width; ++lane) numbers[lane] = __builtin_sqrt(square[lane]);
    return numbers;
}

/// All lanes, one or another.
template <int width> [[gnu::always_inline]] inline std::int64_t united(const Flags<width>& flags)
{
    if constexpr (width == 2)
        return flags[0] | flags[1];
    else if constexpr (width == 4)
        return united<2>(__builtin_shufflevector(flags, flags, 0, 1) | __builtin_shufflevector(flags, flags, 2, 3));
    else
        return united<4>(
            __builtin_shufflevector(flags, flags, 0, 1, 2, 3) | __builtin_shufflevector(flags, flags, 4, 5, 6, 7));
}

template <int width> [[gnu::always_inline]] inline bool any(const Flags<width>& flags)
{
    return united<width>(flags) != 0;
}

/// 0, step, 2 step, …
template <int width> [[gnu::always_inline]] inline Flags<width> stairs(std::int64_t step)
{
    Flags<width> flags;
    for (int lane = 0; lane < width; ++lane) flags[lane] = step * lane;
    return flags;
}

/// A bit for each lane.
template <int width> [[gnu::always_inline]] inline unsigned bits(const Flags<width>& flags)
{
    return static_cast<unsigned>(united<width>((flags & 1) << stairs<width>(1)));
}

/// Bytes as wide numbers, and back.
template <int width> [[gnu::always_inline]] inline Flags<width> widened(const std::uint8_t* from)
{
    typename Register<width>::Bytes bytes;
    __builtin_memcpy(&bytes, from, sizeof bytes);
    return __builtin_convertvector(bytes, Flags<width>);
}
template <int width> [[gnu::always_inline]] inline void narrow(std::uint8_t* to, const Flags<width>& flags)
{
    const std::int64_t bytes = united<width>((flags & 255) << stairs<width>(8));
    __builtin_memcpy(to, &bytes, width); // the lowest byte comes first
}

template <int width> [[gnu::always_inline]] inline void store_floats(float* to, const Numbers<width>& numbers)
{
    const auto floats = __builtin_convertvector(numbers, typename Register<width>::Floats);
    __builtin_memcpy(to, &floats, sizeof floats);
}

template <int width> [[gnu::always_inline]] inline Numbers<width> load_floats(const float* from)
{
    typename Register<width>::Floats floats;
    __builtin_memcpy(&floats, from, sizeof floats);
    return __builtin_convertvector(floats, Numbers<width>);
}

template <int width> struct Vector {
    Numbers<width> x, y, z;

    [[gnu::always_inline]] static Vector load(const double (&rows)[3][pack_size], int first)
    {
        return {packs::load<width>(rows[0] + first), packs::load<width>(rows[1] + first),
            packs::load<width>(rows[2] + first)};
    }
    [[gnu::always_inline]] void store(double (&rows)[3][pack_size], int first) const
    {
        packs::store<width>(rows[0] + first, x);
        packs::store<width>(rows[1] + first, y);
        packs::store<width>(rows[2] + first, z);
    }
    [[gnu::always_inline]] Vector operator+(const Vector& o) const { return {x + o.x, y + o.y, z + o.z}; }
    [[gnu::always_inline]] Vector operator-(const Vector& o) const { return {x - o.x, y - o.y, z - o.z}; }
    [[gnu::always_inline]] Vector operator*(const Numbers<width>& f) const { return {f * x, f * y, f * z}; }
    [[gnu::always_inline]] Numbers<width> dot(const Vector& o) const { return x * o.x + y * o.y + z * o.z; }
    [[gnu::always_inline]] Vector cross(const Vector& o) const
    {
        return {y * o.z - z * o.y, z * o.x - x * o.z, x * o.y - y * o.x};
    }
};

/// Two registers, of which `stride` numbers in turn change places.
template <int width, int stride, int... i>
[[gnu::always_inline]] inline void exchange(Numbers<width>& low, Numbers<width>& high, std::integer_sequence<int, i...>)
{
    const Numbers<width> a = low, b = high;
    low = __builtin_shufflevector(a, b, (i & stride ? width + i - stride : i)...);
    high = __builtin_shufflevector(a, b, (i & stride ? width + i : i + stride)...);
}

/// Rows become columns.
template <int width, int stride = width / 2> [[gnu::always_inline]] inline void transpose(Numbers<width>* rows)
{
#pragma GCC unroll 8
    for (int row = 0; row < width; ++row)
        if (!(row & stride))
            exchange<width, stride>(rows[row], rows[row + stride], std::make_integer_sequence<int, width>{});
    if constexpr (stride > 1) transpose<width, stride / 2>(rows);
}

/// Records of eight numbers, number beside number.
template <int width> [[gnu::always_inline]] inline void gather(Numbers<width>* numbers, const double* const* records)
{
#pragma GCC unroll 4
    for (int block = 0; block < pack_size; block += width) {
#pragma GCC unroll 8
        for (int lane = 0; lane < width; ++lane) numbers[block + lane] = load<width>(records[lane] + block);
        transpose<width>(numbers + block);
    }
}

} // namespace talus::packs
