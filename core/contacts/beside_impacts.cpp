// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contacts/beside_impacts.hpp"

#include <algorithm>
#include <bit>

namespace talus
{
namespace
{

/// The contacts of a tile, between spheres or with walls, of which a sphere has an impact.
class Bystanders
{
public:
    Bystanders(TileContacts& contacts, bool with_walls, std::vector<BodyImpacts>& impacts, const State& state)
        : contacts_(contacts), with_walls_(with_walls), impacts_(impacts), state_(state)
    {
    }

    void find()
    {
        contacts_.struck().clear();
        for (std::size_t p = 0; p < contacts_.packs(); ++p)
            for (unsigned lanes = struck_lanes(p); lanes != 0; lanes &= lanes - 1)
                contacts_.struck().push_back(pack_size * p + static_cast<std::size_t>(std::countr_zero(lanes)));
    }

    /// Notes what other spheres press on spheres with.
    void note_loads()
    {
        for (const std::size_t k : contacts_.struck()) {
            const double load = contacts_.normal_impulse(k);
            impacts_[contacts_.a(k)].note_load(load);
            impacts_[contacts_.b(k)].note_load(load);
        }
    }

    /// Gives each its law. Returns the greatest ratio of masses of those that bear.
    /// @param velocity_of_other(k) of b at contact k
    template <class Velocity> double settle(const LawOfStep& step, Velocity&& velocity_of_other)
    {
        double ratio = 0.0;
        for (const std::size_t k : contacts_.struck()) {
            const double u_n = contacts_.normal(k).dot(state_.body(contacts_.a(k)).velocity - velocity_of_other(k));
            if (!settle_one(k, u_n, step)) continue;
            const std::int32_t a = contacts_.a(k);
            ratio = std::max(ratio, ratio_at(a, with_walls_ ? 0.0 : state_.body(contacts_.b(k)).inverse_mass));
            if (!with_walls_) ratio = std::max(ratio, ratio_at(contacts_.b(k), state_.body(a).inverse_mass));
        }
        return ratio;
    }

private:
    TileContacts& contacts_;
    const bool with_walls_;
    std::vector<BodyImpacts>& impacts_;
    const State& state_;

    /// Of what strikes a sphere, to the sphere's.
    double ratio_at(std::int32_t sphere, double inverse_mass_of_other) const
    {
        return impact_ratio(impacts_[sphere].mass, state_.body(sphere).inverse_mass, inverse_mass_of_other);
    }

    /// As bits.
    unsigned struck_lanes(std::size_t p) const
    {
        const ContactPack& pack = contacts_.pack(p);
        const std::int32_t* const other = with_walls_ ? pack.a : pack.b;
        const BodyImpacts* const impacts = impacts_.data();
        unsigned lanes = 0;
        for (unsigned lane = 0; lane < pack_size; ++lane) { // no branch: which are struck is no pattern
            const double size = impacts[std::max(pack.a[lane], 0)].size + impacts[std::max(other[lane], 0)].size;
            lanes |= static_cast<unsigned>(size > 0.0) << lane;
        }
        return lanes & contacts_.record(p).in_problem;
    }

    /// Returns whether it bears a load, and an impact with it.
    bool settle_one(std::size_t k, double u_n, const LawOfStep& step)
    {
        if (contacts_.kind(k) == ContactKind::impact) return false;
        const Contact own = contacts_.contact(k);
        const BodyImpacts &a = impacts_[contacts_.a(k)], &b = with_walls_ ? a : impacts_[contacts_.b(k)];
        const Bystander at{.gap = own.gap,
            .u_n = u_n,
            .compression = own.compression,
            .impulse = own.normal_impulse(),
            .was_impact = own.touch.last() == TouchRecord::impact,
            .impact = std::max(a.size, b.size),
            .pressed = std::max(a.load, b.load)};
        if (const auto law = beside_impact(at, step)) contacts_.set_law(k, *law);
        return at.is_loaded(step);
    }
};

} // namespace

double stand_beside_impacts(ContactNetwork& network, const State& state, const Model& model, const LawOfStep& step)
{
    StepContacts& contacts = network.contacts;
    const auto tiles = static_cast<std::int64_t>(contacts.spheres.size());
    const auto spheres = [&](std::size_t tile) {
        return Bystanders(contacts.spheres[tile], false, contacts.impacts, state);
    };
    const auto walls = [&](std::size_t tile) {
        return Bystanders(contacts.walls[tile], true, contacts.impacts, state);
    };
    Bystanders pistons(contacts.pistons, true, contacts.impacts, state);
    pistons.find();
    double ratio = pistons.settle(step, [&](std::size_t k) {
        const PistonState& own = state.pistons[static_cast<std::size_t>(model.walls[contacts.pistons.b(k)].piston)];
        return Vec3(own.velocity + own.spin.cross(contacts.piston_arms[k]));
    });
#pragma omp parallel if (tiles > 16)
    {
#pragma omp for schedule(dynamic)
        for (std::int64_t t = 0; t < tiles; ++t) {
            const auto tile = static_cast<std::size_t>(t);
            walls(tile).find();
            spheres(tile).find();
            spheres(tile).note_loads();
        }
#pragma omp for schedule(dynamic) reduction(max : ratio)
        for (std::int64_t t = 0; t < tiles; ++t) {
            const auto tile = static_cast<std::size_t>(t);
            const TileContacts &between = contacts.spheres[tile], &at_walls = contacts.walls[tile];
            const double of_spheres =
                spheres(tile).settle(step, [&](std::size_t k) { return state.body(between.b(k)).velocity; });
            const double of_walls = walls(tile).settle(step, [&](std::size_t k) {
                return at_walls.has_moving_walls()
                           ? Vec3(at_walls.wall(k).velocity - at_walls.wall(k).gain * at_walls.normal(k))
                           : Vec3::Zero().eval();
            });
            ratio = std::max({ratio, of_spheres, of_walls});
        }
    }
    return ratio;
}

} // namespace talus
