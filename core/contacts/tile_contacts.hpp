// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact.hpp"
#include "core/law/impact.hpp"
#include "core/packs/contact_pack.hpp"

#include <bit>
#include <ranges>
#include <vector>

namespace talus
{

/// The contacts of one kind in one tile, in packs. Contact k is lane k mod 8 of pack k / 8; not all lanes hold one.
class TileContacts
{
public:
    /// What there is of its contacts besides.
    struct Parts {
        bool rolling = false, moving_walls = false, attraction = false;
        bool walls = false; ///< they are contacts with walls
    };
    /// Begins anew.
    /// @param made_whole all lanes of a pack will be made at once, so that it need not be empty before
    void clear(const Parts& parts, bool made_whole = false);
    /// Adds a pack without contacts.
    void append_pack();
    /// Adds a contact behind the last one, whatever spheres it shares: for contacts that are not swept by packs.
    std::size_t append();
    /// A sphere, and another one or a wall, get lane k, which is to be made a contact.
    void place(std::size_t k, std::int32_t sphere, std::int32_t other, std::uint32_t slot)
    {
        packs_[k / pack_size].a[k % pack_size] = sphere;
        packs_[k / pack_size].b[k % pack_size] = other;
        records_[k / pack_size].slot[k % pack_size] = slot;
    }
    /// Contact k gets another normal law, since an impact is beside it.
    void set_law(std::size_t k, const BesideImpact& law);
    void set_rolling(std::size_t k, const RollingRow& row);
    void set_wall(std::size_t k, const WallRow& row);
    void set_wall_level(std::size_t k, double level) { level_[k / pack_size].level[k % pack_size] = level; }
    void set_touch(std::size_t k, TouchRecord touch)
    {
        records_[k / pack_size].touch[k % pack_size] = std::bit_cast<std::uint8_t>(touch);
    }
    void set_attraction(std::size_t k, const Vec3& impulse)
    {
        put(attraction_[k / pack_size].impulse, k % pack_size, impulse);
    }
    void set_impulse(std::size_t k, const Vec3& impulse) { put(packs_[k / pack_size].impulse, k % pack_size, impulse); }
    /// @param impulse the angular one in all, rolling and twisting
    void set_rolling_impulse(std::size_t k, const Vec3& impulse);

    std::size_t packs() const { return count_; }
    const ContactPack& pack(std::size_t p) const { return packs_[p]; }
    ContactPack& pack(std::size_t p) { return packs_[p]; }
    const RecordPack& record(std::size_t p) const { return records_[p]; }
    RecordPack& record(std::size_t p) { return records_[p]; }
    PackSpan span();

    bool has_rolling() const { return parts_.rolling; }
    bool has_moving_walls() const { return parts_.moving_walls; }
    bool has_attraction() const { return parts_.attraction; }
    /// The indices of the contacts, in the order in which they are swept.
    auto indices() const
    {
        return std::views::iota(std::size_t{0}, pack_size * count_) |
               std::views::filter([this](std::size_t k) { return records_[k / pack_size].holds(k % pack_size); });
    }
    /// Of these, those of which a sphere has an impact, once `stand_beside_impacts` has looked for them.
    const std::vector<std::size_t>& struck() const { return struck_; }
    std::vector<std::size_t>& struck() { return struck_; }
    std::size_t count() const
    {
        auto all = indices();
        return static_cast<std::size_t>(std::ranges::distance(all));
    }
    std::int32_t a(std::size_t k) const { return packs_[k / pack_size].a[k % pack_size]; }
    std::int32_t b(std::size_t k) const { return packs_[k / pack_size].b[k % pack_size]; }
    Vec3 normal(std::size_t k) const { return get(packs_[k / pack_size].normal, k % pack_size); }
    Vec3 impulse(std::size_t k) const { return get(packs_[k / pack_size].impulse, k % pack_size); }
    double normal_impulse(std::size_t k) const { return impulse(k).dot(normal(k)); }
    bool is_loaded(std::size_t k) const { return normal_impulse(k) > 0.0; }
    /// With which b draws a to itself [N s]; 0 where it does not.
    Vec3 attraction(std::size_t k) const
    {
        return parts_.attraction ? get(attraction_[k / pack_size].impulse, k % pack_size) : Vec3::Zero().eval();
    }
    bool attracts(std::size_t k) const { return parts_.attraction && !attraction(k).isZero(0.0); }
    double gap(std::size_t k) const { return records_[k / pack_size].gap[k % pack_size]; }
    double wall_level(std::size_t k) const { return parts_.walls ? level_[k / pack_size].level[k % pack_size] : 0.0; }
    std::uint32_t slot(std::size_t k) const { return records_[k / pack_size].slot[k % pack_size]; }
    bool hands_nothing_on(std::size_t k) const { return records_[k / pack_size].hands_on[k % pack_size] == 0.0F; }
    Contact contact(std::size_t k) const;
    TouchRecord touch(std::size_t k) const
    {
        return std::bit_cast<TouchRecord>(records_[k / pack_size].touch[k % pack_size]);
    }
    ContactKind kind(std::size_t k) const { return records_[k / pack_size].kind[k % pack_size]; }
    RollingRow rolling(std::size_t k) const;
    WallRow wall(std::size_t k) const;
    /// The angular one in all, rolling and twisting.
    Vec3 rolling_impulse(std::size_t k) const
    {
        const RollingPack& pack = rolling_[k / pack_size];
        return get(pack.impulse, k % pack_size) + pack.twist[k % pack_size] * normal(k);
    }

private:
    // Room for as many packs as there ever were: to give them back and take them again costs more than to make them.
    std::size_t count_ = 0; ///< of the packs in use
    std::vector<ContactPack> packs_;
    std::vector<RecordPack> records_;
    std::vector<RollingPack> rolling_;       ///< empty unless the scene has rolling resistance
    std::vector<WallPack> wall_;             ///< empty unless walls move, and between spheres
    std::vector<WallLevelPack> level_;       ///< empty between spheres
    std::vector<AttractionPack> attraction_; ///< empty unless the scene has attraction
    std::vector<std::size_t> struck_;
    Parts parts_;
    bool made_whole_ = false;

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
