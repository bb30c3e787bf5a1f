// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contacts/tile_contacts.hpp"

namespace talus
{
namespace
{

/// With room for an eighth more at most: packs are the most of what a step holds in memory.
template <class Pack> void add_one(std::vector<Pack>& packs)
{
    if (packs.size() == packs.capacity()) packs.reserve(packs.size() + packs.size() / 8 + 1);
    packs.emplace_back();
}

} // namespace

void TileContacts::clear(const Parts& parts, bool made_whole)
{
    count_ = 0;
    parts_ = parts;
    made_whole_ = made_whole;
    // What the scene needs may have changed: a wall may be driven that has stood still.
    if (parts.rolling) rolling_.resize(packs_.size());
    if (parts.moving_walls) wall_.resize(packs_.size());
    if (parts.attraction) attraction_.resize(packs_.size());
    if (parts.walls) level_.resize(packs_.size());
}

void TileContacts::append_pack()
{
    const std::size_t p = count_++;
    if (packs_.size() < count_) {
        add_one(packs_);
        add_one(records_);
        if (parts_.rolling) add_one(rolling_);
        if (parts_.moving_walls) add_one(wall_);
        if (parts_.attraction) add_one(attraction_);
        if (parts_.walls) add_one(level_);
    } else if (!made_whole_) {
        packs_[p] = {};
        records_[p] = {};
        if (parts_.rolling) rolling_[p] = {};
        if (parts_.moving_walls) wall_[p] = {};
    }
    for (int lane = 0; lane < pack_size; ++lane) packs_[p].a[lane] = packs_[p].b[lane] = -1;
    records_[p].in_problem = 0;
}

std::size_t TileContacts::append()
{
    if (count_ == 0 || packs_[count_ - 1].a[pack_size - 1] >= 0) append_pack();
    std::size_t k = pack_size * (count_ - 1);
    while (a(k) >= 0) ++k;
    return k;
}

void TileContacts::set_law(std::size_t k, const BesideImpact& law)
{
    ContactPack& pack = packs_[k / pack_size];
    RecordPack& record = records_[k / pack_size];
    const std::size_t lane = k % pack_size;
    pack.target[lane] = law.target;
    record.compliance[lane] = 0.0;
    pack.parting[lane] = infinity;
    pack.normal_mass[lane] = 1.0 / record.inverse_mass_sum[lane];
    record.kind[lane] = law.kind;
    record.compression[lane] = static_cast<float>(law.compression);
    record.hands_on[lane] = static_cast<float>(law.hands_on);
    record.push[lane] = 0.0F;
}

void TileContacts::set_rolling(std::size_t k, const RollingRow& row)
{
    RollingPack& pack = rolling_[k / pack_size];
    const std::size_t lane = k % pack_size;
    put(pack.impulse, lane, row.impulse);
    pack.twist[lane] = row.twist;
    pack.reach[lane] = row.reach;
    pack.twist_reach[lane] = row.twist_reach;
    pack.inertia[lane] = row.inertia;
}

void TileContacts::set_rolling_impulse(std::size_t k, const Vec3& impulse)
{
    RollingPack& pack = rolling_[k / pack_size];
    const std::size_t lane = k % pack_size;
    pack.twist[lane] = pack.twist_reach[lane] > 0.0 ? impulse.dot(normal(k)) : 0.0;
    put(pack.impulse, lane, impulse - pack.twist[lane] * normal(k));
}

void TileContacts::set_wall(std::size_t k, const WallRow& row)
{
    put(wall_[k / pack_size].velocity, k % pack_size, row.velocity);
    put(wall_[k / pack_size].spin, k % pack_size, row.spin);
    wall_[k / pack_size].gain[k % pack_size] = row.gain;
}

PackSpan TileContacts::span()
{
    return {packs_.data(), parts_.rolling ? rolling_.data() : nullptr, parts_.moving_walls ? wall_.data() : nullptr,
        count_};
}

Contact TileContacts::contact(std::size_t k) const
{
    const ContactPack& pack = packs_[k / pack_size];
    const RecordPack& record = records_[k / pack_size];
    const std::size_t lane = k % pack_size;
    return {.a = pack.a[lane],
        .b = pack.b[lane],
        .normal = normal(k),
        .impulse = impulse(k),
        .kind = record.kind[lane],
        .target = pack.target[lane],
        .compliance = record.compliance[lane],
        .parting = pack.parting[lane],
        .friction = pack.friction[lane],
        .arm_scale = pack.arm_scale[lane],
        .inverse_mass_sum = record.inverse_mass_sum[lane],
        .attraction = attraction(k),
        .gap = record.gap[lane],
        .wall_level = wall_level(k),
        .compression = record.compression[lane],
        .touch = touch(k),
        .slot = record.slot[lane]};
}

RollingRow TileContacts::rolling(std::size_t k) const
{
    const RollingPack& pack = rolling_[k / pack_size];
    const std::size_t lane = k % pack_size;
    return {get(pack.impulse, lane), pack.twist[lane], pack.reach[lane], pack.twist_reach[lane], pack.inertia[lane]};
}

WallRow TileContacts::wall(std::size_t k) const
{
    return {get(wall_[k / pack_size].velocity, k % pack_size), get(wall_[k / pack_size].spin, k % pack_size),
        wall_[k / pack_size].gain[k % pack_size]};
}

} // namespace talus
