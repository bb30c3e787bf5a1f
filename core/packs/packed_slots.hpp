// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/packs/numbers.hpp"

/// What the slots of a tile carry, as kernels read and write it: CarriedContact, four numbers each.
namespace talus::packs
{

/// Records of four numbers, number beside number.
template <int width>
[[gnu::always_inline]] inline void gather_four(Numbers<width>* numbers, const double* const* records)
{
    constexpr auto lanes = std::make_integer_sequence<int, width>{};
    if constexpr (width == 2) {
        for (int block = 0; block < 4; block += width) {
            for (int lane = 0; lane < width; ++lane) numbers[block + lane] = load<width>(records[lane] + block);
            transpose<width>(numbers + block);
        }
    } else {
        for (int row = 0; row < 4; ++row) {
            if constexpr (width == 8)
                numbers[row] =
                    __builtin_shufflevector(load<4>(records[row]), load<4>(records[row + 4]), 0, 1, 2, 3, 4, 5, 6, 7);
            else
                numbers[row] = load<width>(records[row]);
        }
        exchange<width, 2>(numbers[0], numbers[2], lanes);
        exchange<width, 2>(numbers[1], numbers[3], lanes);
        exchange<width, 1>(numbers[0], numbers[1], lanes);
        exchange<width, 1>(numbers[2], numbers[3], lanes);
    }
}

/// Puts records of four numbers where they belong, those of lanes that are not empty.
template <int width> [[gnu::always_inline]] inline void scatter_four(Numbers<width>* numbers, double* const* records)
{
    constexpr auto lanes = std::make_integer_sequence<int, width>{};
    if constexpr (width == 2) {
        for (int block = 0; block < 4; block += width) {
            transpose<width>(numbers + block);
            for (int lane = 0; lane < width; ++lane)
                if (records[lane]) store<width>(records[lane] + block, numbers[block + lane]);
        }
    } else {
        exchange<width, 1>(numbers[0], numbers[1], lanes);
        exchange<width, 1>(numbers[2], numbers[3], lanes);
        exchange<width, 2>(numbers[0], numbers[2], lanes);
        exchange<width, 2>(numbers[1], numbers[3], lanes);
#pragma GCC unroll 4
        for (int row = 0; row < 4; ++row) {
            if constexpr (width == 8) {
                if (records[row])
                    store<4>(records[row], __builtin_shufflevector(numbers[row], numbers[row], 0, 1, 2, 3));
                if (records[row + 4])
                    store<4>(records[row + 4], __builtin_shufflevector(numbers[row], numbers[row], 4, 5, 6, 7));
            } else if (records[row])
                store<width>(records[row], numbers[row]);
        }
    }
}

/// Records of four numbers with which a slot keeps what it carries: λ, and κ beside the TouchRecord in one number.
template <int width> struct CarriedRecords {
    static constexpr int touch_bits = 32; ///< behind those of κ
    static constexpr std::size_t touch_byte = 3 * sizeof(double) + touch_bits / 8;

    Vector<width> impulse;
    Numbers<width> compression;
    Flags<width> touch;

    [[gnu::always_inline]] static CarriedRecords gather(const std::uint32_t* slot, const double* carried)
    {
        const double* records[width];
        for (int lane = 0; lane < width; ++lane) records[lane] = carried + std::size_t{4} * slot[lane];
        Numbers<width> numbers[4];
        gather_four<width>(numbers, records);
        Flags<width> both;
        __builtin_memcpy(&both, &numbers[3], sizeof both);
        const auto low = __builtin_convertvector(both, typename Register<width>::Words);
        typename Register<width>::Floats kappa;
        __builtin_memcpy(&kappa, &low, sizeof kappa);
        return {{numbers[0], numbers[1], numbers[2]}, __builtin_convertvector(kappa, Numbers<width>),
            (both >> touch_bits) & 255};
    }

    /// Puts them where they belong, those that have a place.
    [[gnu::always_inline]] void scatter(double* const* records) const
    {
        const auto kappa = __builtin_convertvector(compression, typename Register<width>::Floats);
        typename Register<width>::Words low;
        __builtin_memcpy(&low, &kappa, sizeof low);
        const Flags<width> both = __builtin_convertvector(low, Flags<width>) | (touch << touch_bits);
        Numbers<width> numbers[4] = {impulse.x, impulse.y, impulse.z};
        __builtin_memcpy(&numbers[3], &both, sizeof both);
        scatter_four<width>(numbers, records);
    }

    /// Whether something is known of the contact of a slot.
    [[gnu::always_inline]] static bool is_known(const double* carried, std::uint32_t slot)
    {
        return reinterpret_cast<const std::uint8_t*>(carried + std::size_t{4} * slot)[touch_byte] != 0;
    }
};

} // namespace talus::packs
