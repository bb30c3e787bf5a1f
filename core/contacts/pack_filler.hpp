// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/tile_contacts.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
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
        if (behind_.size() < spheres) behind_.resize(spheres, 0);
        begin_window();
    }

    /// A place for a contact between these spheres. @param b < 0: none
    std::size_t place(std::int32_t a, std::int32_t b)
    {
        const int behind = std::max(behind_[a], b >= 0 ? behind_[b] : std::uint8_t{0});
        std::uint64_t fits = behind < window ? open_ & (~std::uint64_t{0} << behind) : 0;
        if (fits == 0) fits = open_pack();
        const int p = std::countr_zero(fits);
        const std::uint64_t bit = std::uint64_t{1} << p;
        behind_[a] = static_cast<std::uint8_t>(p + 1);
        if (b >= 0) behind_[b] = behind_[a];
        spheres_.push_back(a);
        if (b >= 0) spheres_.push_back(b);
        const std::size_t k = pack_size * (first_ + static_cast<std::size_t>(p)) + count_[p];
        if (++count_[p] == pack_size) open_ &= ~bit;
        return k;
    }

    void end() { forget(); }

private:
    static constexpr int window = 64; ///< packs: bits of a word

    TileContacts* contacts_ = nullptr;
    std::vector<std::uint8_t> behind_;  ///< by sphere: one more than the last pack of the window that holds it
    std::vector<std::int32_t> spheres_; ///< for which this is not 0
    std::uint64_t open_ = 0;            ///< packs of the window with a free lane
    std::array<std::uint8_t, window> count_{};
    std::size_t first_ = 0; ///< pack of the window
    int packs_ = 0;         ///< of the window

    void forget()
    {
        for (const std::int32_t sphere : spheres_) behind_[sphere] = 0;
        spheres_.clear();
    }

    void begin_window()
    {
        forget();
        first_ = contacts_->packs();
        open_ = 0;
        packs_ = 0;
        count_.fill(0);
    }

    std::uint64_t open_pack()
    {
        if (packs_ == window) begin_window();
        contacts_->append_pack();
        const std::uint64_t bit = std::uint64_t{1} << packs_++;
        open_ |= bit;
        return bit;
    }
};

} // namespace talus
