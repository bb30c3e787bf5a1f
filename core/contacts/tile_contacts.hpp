// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact.hpp"
#include "core/packs/contact_pack.hpp"

#include <iterator>
#include <vector>

namespace talus
{

/// The lanes of packs that hold a contact.
class LanesInUse
{
public:
    class Iterator
    {
    public:
        using difference_type = std::ptrdiff_t;
        using value_type = std::size_t;
        using pointer = const std::size_t*;
        using reference = std::size_t;
        using iterator_category = std::forward_iterator_tag;

        Iterator() = default;
        Iterator(const ContactPack* packs, std::size_t lane, std::size_t end) : packs_(packs), lane_(lane), end_(end)
        {
            skip();
        }
        std::size_t operator*() const { return lane_; }
        Iterator& operator++()
        {
            ++lane_;
            skip();
            return *this;
        }
        Iterator operator++(int)
        {
            const Iterator before = *this;
            ++*this;
            return before;
        }
        bool operator==(const Iterator& other) const { return lane_ == other.lane_; }

    private:
        const ContactPack* packs_ = nullptr;
        std::size_t lane_ = 0, end_ = 0;

        /// To the next pack, where the lanes that are left are empty.
        void skip()
        {
            while (lane_ < end_ && packs_[lane_ / pack_size].a[lane_ % pack_size] < 0)
                lane_ += pack_size - lane_ % pack_size;
        }
    };

    LanesInUse(const ContactPack* packs, std::size_t count) : packs_(packs), end_(pack_size * count) {}
    Iterator begin() const { return {packs_, 0, end_}; }
    Iterator end() const { return {packs_, end_, end_}; }

private:
    const ContactPack* packs_;
    std::size_t end_;
};

/// The contacts of one kind in one tile, in packs. Contact k is lane k mod 8 of pack k / 8; not all lanes are in use.
class TileContacts
{
public:
    std::vector<ContactGeometry> geometry; ///< by contact

    /// Begins anew. @param rolling, moving_walls what the scene needs besides
    void clear(bool rolling, bool moving_walls);
    /// Adds a pack without contacts.
    void append_pack();
    /// Adds a contact behind the last one, whatever spheres it shares: for contacts that are not swept by packs.
    std::size_t append();
    void set(std::size_t k, const Contact& contact, const ContactTerms& terms, const ContactGeometry& own);
    /// Contact k becomes what stands in a lane of another pack.
    void copy(std::size_t k, const ContactPack& from, int lane, const ContactGeometry& own);
    /// Takes contact k away; the last one of its pack takes its place.
    void remove(std::size_t k);
    void set_rolling(std::size_t k, const RollingRow& row);
    void set_wall(std::size_t k, const WallRow& row);
    void set_impulse(std::size_t k, const Vec3& impulse) { put(packs_[k / pack_size].impulse, k % pack_size, impulse); }
    void set_rolling_impulse(std::size_t k, const Vec3& impulse)
    {
        put(rolling_[k / pack_size].impulse, k % pack_size, impulse);
    }

    std::size_t packs() const { return packs_.size(); }
    const ContactPack& pack(std::size_t p) const { return packs_[p]; }
    PackSpan span();

    bool has_rolling() const { return with_rolling_; }
    bool has_moving_walls() const { return with_moving_walls_; }
    /// The indices of the contacts, in the order in which they are swept.
    LanesInUse indices() const { return {packs_.data(), packs_.size()}; }
    std::size_t count() const
    {
        const LanesInUse all = indices();
        return static_cast<std::size_t>(std::distance(all.begin(), all.end()));
    }
    std::int32_t a(std::size_t k) const { return packs_[k / pack_size].a[k % pack_size]; }
    std::int32_t b(std::size_t k) const { return packs_[k / pack_size].b[k % pack_size]; }
    Vec3 normal(std::size_t k) const { return get(packs_[k / pack_size].normal, k % pack_size); }
    Vec3 impulse(std::size_t k) const { return get(packs_[k / pack_size].impulse, k % pack_size); }
    double friction(std::size_t k) const { return packs_[k / pack_size].friction[k % pack_size]; }
    Contact contact(std::size_t k) const;
    ContactTerms terms(std::size_t k) const;
    RollingRow rolling(std::size_t k) const;
    WallRow wall(std::size_t k) const;
    Vec3 rolling_impulse(std::size_t k) const { return get(rolling_[k / pack_size].impulse, k % pack_size); }

private:
    std::vector<ContactPack> packs_;
    std::vector<RollingPack> rolling_; ///< empty unless the scene has rolling resistance
    std::vector<WallPack> wall_;       ///< empty unless walls move, and between spheres
    bool with_rolling_ = false, with_moving_walls_ = false;

    static Vec3 get(const double (&rows)[3][pack_size], std::size_t lane)
    {
        return {rows[0][lane], rows[1][lane], rows[2][lane]};
    }
    static void put(double (&rows)[3][pack_size], std::size_t lane, const Vec3& value)
    {
        for (int d = 0; d < 3; ++d) rows[d][lane] = value[d];
    }
};

} // namespace talus
