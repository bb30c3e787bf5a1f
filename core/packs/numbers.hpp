// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/packs/contact_pack.hpp"

#include <utility>

/// Numbers in registers of 2, 4 or 8, `width` of them, and vectors of such; one by one for what is no kernel.
///
/// Kernels are compiled for an instruction set of their own. Therefore nothing that they use may
/// be an inline function that another file could share: all are templates of the width, which belongs to one file only,
/// and nothing of Eigen or of the standard library is called.
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

/// All lanes, one or another.
template <int width> [[gnu::always_inline]] inline std::int64_t united(const Flags<width>& flags)
{
    if constexpr (width == 1)
        return flags[0];
    else if constexpr (width == 2)
        return flags[0] | flags[1];
    else if constexpr (width == 4)
        return united<2>(__builtin_shufflevector(flags, flags, 0, 1) | __builtin_shufflevector(flags, flags, 2, 3));
    else
        return united<4>(
            __builtin_shufflevector(flags, flags, 0, 1, 2, 3) | __builtin_shufflevector(flags, flags, 4, 5, 6, 7));
}

/// a + b, and what rounding has taken of it (Knuth).
template <int width>
[[gnu::always_inline]] inline Numbers<width> sum(
    const Numbers<width>& a, const Numbers<width>& b, Numbers<width>& error)
{
    const Numbers<width> both = a + b, of_b = both - a;
    error = (a - (both - of_b)) + (b - of_b);
    return both;
}

/// a b + c, rounded once, without an instruction for it (Boldo & Melquiond 2008): the product is exact in two numbers
/// (Veltkamp, Dekker), and what is added last is rounded to odd. Products so small that their lower half is not exact
/// are left to the library. (Inlined it takes a minute to compile, and is no faster.)
template <int width>
[[gnu::noinline]] Numbers<width> fused_by_parts(Numbers<width> a, Numbers<width> b, Numbers<width> c)
{
    constexpr double splits = 0x1p27 + 1.0;
    const Numbers<width> a_high = splits * a - (splits * a - a), a_low = a - a_high;
    const Numbers<width> b_high = splits * b - (splits * b - b), b_low = b - b_high;
    const Numbers<width> product = a * b;
    const Numbers<width> product_low = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
    Numbers<width> low, of_high, left;
    const Numbers<width> middle = sum<width>(c, product_low, low), high = sum<width>(product, middle, of_high);
    const Numbers<width> last = sum<width>(low, of_high, left);
    Flags<width> bits;
    __builtin_memcpy(&bits, &last, sizeof bits);
    const Flags<width> outwards = (left > 0.0) == (last > 0.0);
    bits += ((left != 0.0) & ((bits & 1) == 0)) & (outwards ? Flags<width>{} + 1 : Flags<width>{} - 1);
    Numbers<width> odd;
    __builtin_memcpy(&odd, &bits, sizeof odd);
    const Numbers<width> rounded = high + odd;
    // What is nothing gets its sign, and what splitting has made infinite its size.
    Numbers<width> all = (rounded - rounded == 0.0) & (rounded != 0.0) ? rounded : product + c;
    constexpr double smallest = 0x1p-960;
    const Flags<width> tiny = (product < smallest) & (product > -smallest) & (a != 0.0) & (b != 0.0);
    if (united<width>(tiny) != 0)
        for (int lane = 0; lane < width; ++lane)
            all[lane] = tiny[lane] ? __builtin_fma(a[lane], b[lane], c[lane]) : all[lane];
    return all;
}

/// a b + c, rounded once, in all instruction sets: so results have the same bits.
template <int width>
[[gnu::always_inline]] inline Numbers<width> fused(
    const Numbers<width>& a, const Numbers<width>& b, const Numbers<width>& c)
{
    if constexpr (width == 1) return Numbers<1>{__builtin_fma(a[0], b[0], c[0])};
#if defined(__AVX512F__) && !defined(__clang__)
    if constexpr (width == 8) return __builtin_ia32_vfmaddpd512_mask(a, b, c, -1, 4);
#endif
#if defined(__FMA__) && !defined(__clang__)
    if constexpr (width == 4) return __builtin_ia32_vfmaddpd256(a, b, c);
#endif
#ifdef __FP_FAST_FMA
    Numbers<width> numbers;
    for (int lane = 0; lane < width; ++lane) numbers[lane] = __builtin_fma(a[lane], b[lane], c[lane]);
    return numbers;
#else
    return fused_by_parts<width>(a, b, c);
#endif
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
    [[gnu::always_inline]] Numbers<width> dot(const Vector& o) const
    {
        return fused<width>(x, o.x, fused<width>(y, o.y, z * o.z));
    }
    [[gnu::always_inline]] Vector cross(const Vector& o) const
    {
        return {fused<width>(y, o.z, -(z * o.y)), fused<width>(z, o.x, -(x * o.z)), fused<width>(x, o.y, -(y * o.x))};
    }
    /// This and o f.
    [[gnu::always_inline]] Vector plus(const Vector& o, const Numbers<width>& f) const
    {
        return {fused<width>(o.x, f, x), fused<width>(o.y, f, y), fused<width>(o.z, f, z)};
    }
    /// This and a × b.
    [[gnu::always_inline]] Vector plus_cross(const Vector& a, const Vector& b) const
    {
        return {fused<width>(a.y, b.z, fused<width>(-a.z, b.y, x)), fused<width>(a.z, b.x, fused<width>(-a.x, b.z, y)),
            fused<width>(a.x, b.y, fused<width>(-a.y, b.x, z))};
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

/// In each half of width / 2 registers rows become columns.
template <int width, int stride = width / 4> [[gnu::always_inline]] inline void transpose_halves(Numbers<width>* rows)
{
    if constexpr (stride > 0) {
#pragma GCC unroll 4
        for (int row = 0; row < width / 2; ++row)
            if (!(row & stride))
                exchange<width, stride>(rows[row], rows[row + stride], std::make_integer_sequence<int, width>{});
        transpose_halves<width, stride / 2>(rows);
    }
}

/// A register of which each half comes from its own place. (Written as a shuffle, GCC 12 makes one of it where a load
/// would do, and a processor has one unit for shuffles, which limits a sweep.)
template <int width> [[gnu::always_inline]] inline Numbers<width> load_halves(const double* low, const double* high)
{
    if constexpr (width == 2) return Numbers<width>{*low, *high};
#if defined(__AVX512F__) && !defined(__clang__)
    if constexpr (width == 8) {
        const auto first = __builtin_ia32_pd512_256pd(load<4>(low));
        return __builtin_ia32_insertf64x4_mask(first, load<4>(high), 1, first, -1);
    }
#endif
    if constexpr (width == 4) return __builtin_shufflevector(load<2>(low), load<2>(high), 0, 1, 2, 3);
    if constexpr (width == 8) return __builtin_shufflevector(load<4>(low), load<4>(high), 0, 1, 2, 3, 4, 5, 6, 7);
}

/// Stores one half of a register alone.
template <int width> [[gnu::always_inline]] inline void store_low_half(double* to, const Numbers<width>& numbers)
{
    if constexpr (width == 2) *to = numbers[0];
    if constexpr (width == 4) store<2>(to, __builtin_shufflevector(numbers, numbers, 0, 1));
    if constexpr (width == 8) store<4>(to, __builtin_shufflevector(numbers, numbers, 0, 1, 2, 3));
}

template <int width> [[gnu::always_inline]] inline void store_high_half(double* to, const Numbers<width>& numbers)
{
    if constexpr (width == 2) *to = numbers[1];
#if defined(__AVX__) && !defined(__clang__)
    if constexpr (width == 4) return store<2>(to, __builtin_ia32_vextractf128_pd256(numbers, 1));
#endif
#if defined(__AVX512F__) && !defined(__clang__)
    if constexpr (width == 8) return store<4>(to, __builtin_ia32_extractf64x4_mask(numbers, 1, Numbers<4>{}, -1));
#endif
    if constexpr (width == 4) store<2>(to, __builtin_shufflevector(numbers, numbers, 2, 3));
    if constexpr (width == 8) store<4>(to, __builtin_shufflevector(numbers, numbers, 4, 5, 6, 7));
}

/// Records of `count` numbers, number beside number.
template <int width, int count>
[[gnu::always_inline]] inline void gather(Numbers<width> (&numbers)[count], const double* const* records)
{
    if constexpr (width == 1) {
        for (int k = 0; k < count; ++k) numbers[k][0] = records[0][k];
    } else {
        constexpr int half = width / 2;
#pragma GCC unroll 8
        for (int block = 0; block < count; block += half) {
#pragma GCC unroll 4
            for (int k = 0; k < half; ++k)
                numbers[block + k] = load_halves<width>(records[k] + block, records[k + half] + block);
            transpose_halves<width>(numbers + block);
        }
    }
}

/// Puts records where they belong, those of lanes that have a place. @tparam full all have
template <int width, int count, bool full = false>
[[gnu::always_inline]] inline void scatter(Numbers<width> (&numbers)[count], double* const* records)
{
    if constexpr (width == 1) {
        for (int k = 0; k < count; ++k) records[0][k] = numbers[k][0];
    } else {
        constexpr int half = width / 2;
#pragma GCC unroll 8
        for (int block = 0; block < count; block += half) {
            transpose_halves<width>(numbers + block);
#pragma GCC unroll 4
            for (int k = 0; k < half; ++k) {
                if (full || records[k]) store_low_half<width>(records[k] + block, numbers[block + k]);
                if (full || records[k + half]) store_high_half<width>(records[k + half] + block, numbers[block + k]);
            }
        }
    }
}

} // namespace talus::packs
