// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contacts/rolling_rows.hpp"

#include "core/law/coulomb.hpp"

namespace talus
{
namespace
{

/// 1/I of a solid sphere [1/(kg m²)].
double inverse_inertia(const Motion& m)
{
    return inverse_inertia_factor * m.inverse_mass / (m.radius * m.radius);
}

RollingRow rolling_row(const Contact& c, bool with_wall, const Vec3& carried, const State& state, const Model& model)
{
    const Motion &a = state.motion[c.a], &b = state.motion[with_wall ? c.a : c.b];
    const int other = with_wall ? model.walls[c.b].material : state.material[c.b];
    const double radius = with_wall ? a.radius : a.radius * b.radius / (a.radius + b.radius);
    const ContactLaw& law = model.materials.between(state.material[c.a], other);
    RollingRow row{Vec3::Zero(), law.rolling_friction * radius,
        1.0 / (inverse_inertia(a) + (with_wall ? 0.0 : inverse_inertia(b)))};
    if (c.kind == ContactKind::impact) return row;
    row.impulse = carried - carried.dot(c.normal) * c.normal;
    cut_to_disk<double>(row.impulse, row.reach * c.normal_impulse());
    return row;
}

} // namespace

void make_rolling_rows(TileContacts& contacts, std::size_t pack, bool with_walls, const std::vector<Vec3>& carried,
    const State& state, const Model& model)
{
    const RecordPack& record = contacts.record(pack);
    for (std::size_t lane = 0; lane < pack_size; ++lane) {
        const std::size_t k = pack_size * pack + lane;
        contacts.set_rolling(k,
            record.holds(lane) ? rolling_row(contacts.contact(k), with_walls, carried[record.slot[lane]], state, model)
                               : RollingRow{});
    }
}

} // namespace talus
