// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/tile_contacts.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

namespace talus
{

/// Finds places for the contacts of a tile, one after the other, so that no two of a pack share a sphere: each goes to
/// the first of the last 64 packs that has a free lane and comes after all that hold one of its spheres. So the sweep
/// of the packs is that of the contacts as they came, to the bit.
class PackFiller
{
public:
    /// @param spheres how many there are in all
    void begin(TileContacts& contacts, std::size_t spheres)
    {
        contacts_ = &contacts;
        if (stamp_.size() < spheres) stamp_.resize(spheres, 0);
        begin_window();
    }

    /// A place for a contact between these spheres. @param b < 0: none
    std::size_t place(std::int32_t a, std::int32_t b)
    {
        const std::uint32_t last = b >= 0 ? std::max(stamp_[a], stamp_[b]) : stamp_[a];
        const std::uint32_t behind = last > before_ ? last - before_ : 0;
        std::uint64_t fits = behind < window ? open_ & (~std::uint64_t{0} << behind) : 0;
        if (fits == 0) fits = open_pack();
        const int p = std::countr_zero(fits);
        stamp_[a] = before_ + static_cast<std::uint32_t>(p) + 1;
        if (b >= 0) stamp_[b] = stamp_[a];
        const std::size_t k = pack_size * (first_ + static_cast<std::size_t>(p)) + count_[p];
        if (++count_[p] == pack_size) open_ &= ~(std::uint64_t{1} << p);
        return k;
    }

private:
    static constexpr std::uint32_t window = 64; ///< packs: bits of a word

    TileContacts* contacts_ = nullptr;
    std::vector<std::uint32_t> stamp_; ///< by sphere: of the last pack that holds it
    std::uint32_t before_ = 0;         ///< greatest stamp of the windows before; that of pack p is p + 1 more
    std::uint64_t open_ = 0;           ///< packs of the window with a free lane
    std::array<std::uint8_t, window> count_{};
    std::size_t first_ = 0; ///< pack of the window
    int packs_ = 0;         ///< of the window

    void begin_window()
    {
        if (before_ > std::numeric_limits<std::uint32_t>::max() - 2 * window) {
            std::ranges::fill(stamp_, 0U);
            before_ = 0;
        } else
            before_ += window;
        first_ = contacts_->packs();
        open_ = 0;
        packs_ = 0;
        count_.fill(0);
    }

    std::uint64_t open_pack()
    {
        if (packs_ == static_cast<int>(window)) begin_window();
        contacts_->append_pack();
        const std::uint64_t bit = std::uint64_t{1} << packs_++;
        open_ |= bit;
        return bit;
    }
};

} // namespace talus
