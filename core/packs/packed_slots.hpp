// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/packs/numbers.hpp"

/// What the slots of a tile carry, as kernels read and write it: CarriedContact, four numbers each.
namespace talus::packs
{

/// Records of four numbers with which a slot keeps what it carries: λ, and κ beside the TouchRecord in one number.
template <int width> struct CarriedRecords {
    static constexpr int touch_bits = 32;                                          ///< behind those of κ
    static constexpr std::size_t touch_byte = 3 * sizeof(double) + touch_bits / 8; ///< and the next says: attached

    Vector<width> impulse;
    Numbers<width> compression;
    Flags<width> touch;

    [[gnu::always_inline]] static CarriedRecords gather(const std::uint32_t* slot, const double* carried)
    {
        const double* records[width];
        for (int lane = 0; lane < width; ++lane) records[lane] = carried + std::size_t{4} * slot[lane];
        Numbers<width> numbers[4];
        packs::gather<width>(numbers, records);
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
        packs::scatter<width>(numbers, records);
    }

    /// Whether something is known of the contact of a slot.
    [[gnu::always_inline]] static bool is_known(const double* carried, std::uint32_t slot)
    {
        std::uint32_t known;
        __builtin_memcpy(
            &known, reinterpret_cast<const char*>(carried + std::size_t{4} * slot) + touch_byte, sizeof known);
        return known != 0;
    }
};

} // namespace talus::packs
