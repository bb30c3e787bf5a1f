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

void TileContacts::clear(bool rolling, bool moving_walls, bool made_whole)
{
    count_ = 0;
    with_rolling_ = rolling;
    with_moving_walls_ = moving_walls;
    made_whole_ = made_whole;
    // What the scene needs may have changed: a wall may be driven that has stood still.
    if (rolling) rolling_.resize(packs_.size());
    if (moving_walls) wall_.resize(packs_.size());
}

void TileContacts::append_pack()
{
    const std::size_t p = count_++;
    if (packs_.size() < count_) {
        add_one(packs_);
        add_one(records_);
        if (with_rolling_) add_one(rolling_);
        if (with_moving_walls_) add_one(wall_);
    } else if (!made_whole_) {
        packs_[p] = {};
        records_[p] = {};
        if (with_rolling_) rolling_[p] = {};
        if (with_moving_walls_) wall_[p] = {};
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

void TileContacts::set(std::size_t k, const Contact& contact, const ContactTerms& terms, const ContactGeometry& own)
{
    set(k, contact, terms);
    RecordPack& record = record_at(k);
    const std::size_t lane = k % pack_size;
    const auto bit = static_cast<std::uint8_t>(1U << lane);
    record.gap[lane] = own.gap;
    record.wall_level[lane] = own.wall_level;
    record.compression[lane] = own.compression;
    record.held[lane] = own.held;
    record.spring[lane] = own.spring;
    record.restitution[lane] = own.restitution;
    record.hands_on[lane] = own.hands_on;
    record.push[lane] = own.push;
    record.slot[lane] = own.slot;
    record.kind[lane] = own.kind;
    set_touch(k, own.touch);
    record.in_problem |= bit;
}

void TileContacts::set(std::size_t k, const Contact& contact, const ContactTerms& terms)
{
    ContactPack& pack = packs_[k / pack_size];
    const std::size_t lane = k % pack_size;
    pack.a[lane] = contact.a;
    pack.b[lane] = contact.b;
    put(pack.normal, lane, contact.normal);
    put(pack.impulse, lane, contact.impulse);
    pack.target[lane] = contact.target;
    pack.arm_scale[lane] = terms.arm_scale;
    pack.friction[lane] = terms.friction;
    pack.parting[lane] = terms.parting;
    pack.normal_mass[lane] = terms.normal_mass;
    pack.tangent_mass[lane] = terms.tangent_mass;
    RecordPack& record = record_at(k);
    record.inverse_mass_sum[lane] = terms.inverse_mass_sum;
    record.compliance[lane] = terms.compliance;
}

void TileContacts::copy(
    std::size_t k, const ContactPack& from, const TouchPack& touch, std::size_t lane, const ContactGeometry& own)
{
    const Contact contact{
        from.a[lane], from.b[lane], get(from.normal, lane), from.target[lane], get(from.impulse, lane)};
    set(k, contact,
        {from.arm_scale[lane], from.friction[lane], touch.compliance[lane], from.parting[lane], from.normal_mass[lane],
            from.tangent_mass[lane], touch.inverse_mass_sum[lane]},
        own);
}

void TileContacts::set_law(std::size_t k, ContactKind kind, double target, float compression, double hands_on)
{
    ContactPack& pack = packs_[k / pack_size];
    RecordPack& record = record_at(k);
    const std::size_t lane = k % pack_size;
    pack.target[lane] = target;
    record.compliance[lane] = 0.0;
    pack.parting[lane] = infinity;
    pack.normal_mass[lane] = 1.0 / record.inverse_mass_sum[lane];
    record.kind[lane] = kind;
    record.compression[lane] = compression;
    record.hands_on[lane] = static_cast<float>(hands_on);
    record.push[lane] = 0.0F;
}

void TileContacts::set_rolling(std::size_t k, const RollingRow& row)
{
    RollingPack& pack = rolling_[k / pack_size];
    put(pack.impulse, k % pack_size, row.impulse);
    pack.reach[k % pack_size] = row.reach;
    pack.inertia[k % pack_size] = row.inertia;
}

void TileContacts::set_wall(std::size_t k, const WallRow& row)
{
    put(wall_[k / pack_size].velocity, k % pack_size, row.velocity);
    put(wall_[k / pack_size].spin, k % pack_size, row.spin);
    wall_[k / pack_size].gain[k % pack_size] = row.gain;
}

PackSpan TileContacts::span()
{
    return {
        packs_.data(), with_rolling_ ? rolling_.data() : nullptr, with_moving_walls_ ? wall_.data() : nullptr, count_};
}

Contact TileContacts::contact(std::size_t k) const
{
    const ContactPack& pack = packs_[k / pack_size];
    return {a(k), b(k), normal(k), pack.target[k % pack_size], impulse(k)};
}

ContactTerms TileContacts::terms(std::size_t k) const
{
    const ContactPack& pack = packs_[k / pack_size];
    const std::size_t lane = k % pack_size;
    const RecordPack& record = records_[k / pack_size];
    return {pack.arm_scale[lane], pack.friction[lane], record.compliance[lane], pack.parting[lane],
        pack.normal_mass[lane], pack.tangent_mass[lane], record.inverse_mass_sum[lane]};
}

ContactGeometry TileContacts::geometry(std::size_t k) const
{
    const RecordPack& record = records_[k / pack_size];
    const std::size_t lane = k % pack_size;
    return {record.gap[lane], record.wall_level[lane], record.slot[lane], record.kind[lane], touch(k),
        record.compression[lane], record.held[lane], record.spring[lane], record.restitution[lane],
        record.hands_on[lane], record.push[lane]};
}

RollingRow TileContacts::rolling(std::size_t k) const
{
    const RollingPack& pack = rolling_[k / pack_size];
    return {rolling_impulse(k), pack.reach[k % pack_size], pack.inertia[k % pack_size]};
}

WallRow TileContacts::wall(std::size_t k) const
{
    return {get(wall_[k / pack_size].velocity, k % pack_size), get(wall_[k / pack_size].spin, k % pack_size),
        wall_[k / pack_size].gain[k % pack_size]};
}

} // namespace talus
