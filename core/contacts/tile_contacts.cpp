// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contacts/tile_contacts.hpp"

namespace talus
{

void TileContacts::clear(bool rolling, bool moving_walls)
{
    packs_.clear();
    rolling_.clear();
    wall_.clear();
    geometry.clear();
    with_rolling_ = rolling;
    with_moving_walls_ = moving_walls;
}

void TileContacts::append_pack()
{
    ContactPack& pack = packs_.emplace_back();
    for (int lane = 0; lane < pack_size; ++lane) pack.a[lane] = pack.b[lane] = -1;
    if (with_rolling_) rolling_.emplace_back();
    if (with_moving_walls_) wall_.emplace_back();
    geometry.resize(pack_size * packs_.size());
}

std::size_t TileContacts::append()
{
    if (packs_.empty() || packs_.back().a[pack_size - 1] >= 0) append_pack();
    std::size_t k = pack_size * (packs_.size() - 1);
    while (a(k) >= 0) ++k;
    return k;
}

void TileContacts::set(std::size_t k, const Contact& contact, const ContactTerms& terms, const ContactGeometry& own)
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
    pack.compliance[lane] = terms.compliance;
    pack.normal_mass[lane] = terms.normal_mass;
    pack.tangent_mass[lane] = terms.tangent_mass;
    pack.inverse_mass_sum[lane] = terms.inverse_mass_sum;
    geometry[k] = own;
}

void TileContacts::copy(std::size_t k, const ContactPack& from, int lane, const ContactGeometry& own)
{
    ContactPack& pack = packs_[k / pack_size];
    const std::size_t to = k % pack_size;
    pack.a[to] = from.a[lane];
    pack.b[to] = from.b[lane];
    for (int d = 0; d < 3; ++d) {
        pack.normal[d][to] = from.normal[d][lane];
        pack.impulse[d][to] = from.impulse[d][lane];
    }
    pack.target[to] = from.target[lane];
    pack.arm_scale[to] = from.arm_scale[lane];
    pack.friction[to] = from.friction[lane];
    pack.compliance[to] = from.compliance[lane];
    pack.normal_mass[to] = from.normal_mass[lane];
    pack.tangent_mass[to] = from.tangent_mass[lane];
    pack.inverse_mass_sum[to] = from.inverse_mass_sum[lane];
    geometry[k] = own;
}

void TileContacts::remove(std::size_t k)
{
    std::size_t last = k - k % pack_size + pack_size - 1;
    while (a(last) < 0) --last;
    copy(k, packs_[last / pack_size], static_cast<int>(last % pack_size), geometry[last]);
    set(last, {.a = -1, .b = -1}, {}, {});
    if (with_rolling_) {
        set_rolling(k, rolling(last));
        set_rolling(last, {});
    }
    if (with_moving_walls_) set_wall(k, wall(last));
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
}

PackSpan TileContacts::span()
{
    return {packs_.data(), with_rolling_ ? rolling_.data() : nullptr, with_moving_walls_ ? wall_.data() : nullptr,
        packs_.size()};
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
    return {pack.arm_scale[lane], pack.friction[lane], pack.compliance[lane], pack.normal_mass[lane],
        pack.tangent_mass[lane], pack.inverse_mass_sum[lane]};
}

RollingRow TileContacts::rolling(std::size_t k) const
{
    const RollingPack& pack = rolling_[k / pack_size];
    return {rolling_impulse(k), pack.reach[k % pack_size], pack.inertia[k % pack_size]};
}

WallRow TileContacts::wall(std::size_t k) const
{
    return {get(wall_[k / pack_size].velocity, k % pack_size), get(wall_[k / pack_size].spin, k % pack_size)};
}

} // namespace talus
