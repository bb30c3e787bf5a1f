// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contacts/beside_impacts.hpp"

#include <algorithm>
#include <bit>

namespace talus
{
namespace
{

/// The contacts of one kind of a tile.
class Bystanders
{
public:
    Bystanders(TileContacts& contacts, const std::vector<SphereImpacts>& impacts, const State& state, const LawOfStep& step)
        : contacts_(contacts), impacts_(impacts), state_(state), step_(step)
    {
    }

    /// @param velocity_of_other(k) of b at contact k
    template <class Velocity> double settle(bool with_walls, Velocity&& velocity_of_other)
    {
        double ratio = 0.0;
        for (std::size_t p = 0; p < contacts_.packs(); ++p)
            for (unsigned lanes = struck_lanes(p, with_walls); lanes != 0; lanes &= lanes - 1) {
                const std::size_t k = pack_size * p + static_cast<std::size_t>(std::countr_zero(lanes));
                const double impact = with_walls ? size(contacts_.a(k)) : std::max(size(contacts_.a(k)), size(contacts_.b(k)));
                if (!settle_one(k, impact, velocity_of_other(k))) continue;
                ratio = std::max(ratio, mass_ratio(contacts_.a(k)));
                if (!with_walls) ratio = std::max(ratio, mass_ratio(contacts_.b(k)));
            }
        return ratio;
    }

private:
    TileContacts& contacts_;
    const std::vector<SphereImpacts>& impacts_;
    const State& state_;
    const LawOfStep& step_;

    double size(std::int32_t sphere) const { return impacts_[sphere].size; }
    double mass_ratio(std::int32_t sphere) const { return impacts_[sphere].mass * state_.motion[sphere].inverse_mass; }

    /// The lanes of contacts of which a sphere has an impact, as bits.
    unsigned struck_lanes(std::size_t p, bool with_walls) const
    {
        const ContactPack& pack = contacts_.pack(p);
        unsigned lanes = 0;
        for (unsigned lane = 0; lane < pack_size && pack.a[lane] >= 0; ++lane) {
            const bool struck = size(pack.a[lane]) > 0.0 || (!with_walls && size(pack.b[lane]) > 0.0);
            lanes |= static_cast<unsigned>(struck) << lane;
        }
        return lanes & contacts_.record(p).in_problem;
    }

    /// Returns whether it bears.
    bool settle_one(std::size_t k, double impact, const Vec3& velocity_of_other)
    {
        const ContactGeometry own = contacts_.geometry(k);
        if (own.kind == ContactKind::impact) return false;
        const Contact c = contacts_.contact(k);
        const double load = c.impulse.dot(c.normal);
        const double u_n = c.normal.dot(state_.motion[c.a].velocity - velocity_of_other);
        const bool parts = own.touch.was_impact() && u_n > 0.0;
        if (load < load_share * impact && !own.touch.was_impact()) {
            contacts_.set_law(k, ContactKind::deferred, deferred_target(own.gap, u_n, step_), -INFINITY, load);
            return false;
        }
        if (parts || (load >= load_share * impact && load < light_share * impact)) {
            const auto kappa = static_cast<float>(borne_compression(own.compression, u_n, step_));
            contacts_.set_law(k, ContactKind::bearing, bearing_target(own.gap, u_n, step_), kappa, load);
        }
        return !parts;
    }
};

} // namespace

double stand_beside_impacts(ContactNetwork& network, const State& state, const Model& model, const LawOfStep& step)
{
    StepContacts& contacts = network.contacts;
    const auto tiles = static_cast<std::int64_t>(contacts.spheres.size());
    double ratio = 0.0;
#pragma omp parallel for schedule(dynamic) reduction(max : ratio) if (tiles > 16)
    for (std::int64_t t = 0; t < tiles; ++t) {
        const auto tile = static_cast<std::size_t>(t);
        TileContacts &spheres = contacts.spheres[tile], &walls = contacts.walls[tile];
        const double between = Bystanders(spheres, contacts.impacts, state, step)
                                   .settle(false, [&](std::size_t k) { return state.motion[spheres.b(k)].velocity; });
        const double at_walls = Bystanders(walls, contacts.impacts, state, step).settle(true, [&](std::size_t k) {
            return walls.has_moving_walls() ? walls.wall(k).velocity : Vec3::Zero().eval();
        });
        ratio = std::max({ratio, between, at_walls});
    }
    const TileContacts& pistons = contacts.pistons;
    const double at_pistons =
        Bystanders(contacts.pistons, contacts.impacts, state, step).settle(true, [&](std::size_t k) {
            const auto piston = static_cast<std::size_t>(model.walls[pistons.b(k)].piston);
            const PistonState& own = state.pistons[piston];
            return Vec3(own.velocity + own.spin.cross(contacts.piston_arms[k]));
        });
    return std::max(ratio, at_pistons);
}

} // namespace talus
