// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contacts/rolling_rows.hpp"

#include "core/law/coulomb.hpp"

#include <algorithm>

namespace talus
{
namespace
{

RollingRow rolling_row(const Contact& c, bool with_wall, const Vec3& carried, const State& state, const Model& model)
{
    const double a = state.radius[c.a], b = with_wall ? infinity : state.radius[c.b];
    const int other = with_wall ? model.walls[c.b].material : state.material[c.b];
    const double reduced_radius = with_wall ? a : a * b / (a + b);
    const ContactLaw& law = model.materials.between(state.material[c.a], other);
    RollingRow row{Vec3::Zero(), 0.0, law.rolling_friction * reduced_radius, law.twisting_friction * reduced_radius,
        1.0 / (state.body(c.a).inverse_inertia() + (with_wall ? 0.0 : state.body(c.b).inverse_inertia()))};
    if (c.kind == ContactKind::impact) return row;
    const double along = carried.dot(c.normal), most = row.twist_reach * c.normal_impulse();
    row.impulse = carried - along * c.normal;
    cut_to_disk<double>(row.impulse, row.reach * c.normal_impulse());
    row.twist = std::clamp(along, -most, most);
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
