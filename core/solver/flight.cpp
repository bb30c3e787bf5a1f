// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/flight.hpp"

#include "core/packs/law.hpp"
#include "core/solver/tile_crew.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace talus
{
namespace
{

/// What a sphere meets in this step.
struct Meetings {
    double instants = 0.0; ///< sum over the impacts with spheres [s]
    int impacts = 0;       ///< with spheres
    bool held = false;     ///< there are other contacts

    bool meets_one() const { return impacts == 1 && !held; }
    bool in_flight() const { return impacts > 0 && !held; }
    double instant() const { return in_flight() ? instants / impacts : 0.0; }
};

/// Finds them for all spheres that are struck, by spheres or walls. Tiles of one colour may be asked at the same time.
class MeetingSurvey
{
public:
    std::vector<Meetings> of;                        ///< by sphere
    std::vector<std::vector<std::uint32_t>> impacts; ///< by tile: its contacts between spheres that are such

    MeetingSurvey(const StepContacts& contacts, const State& state, const Model& model, double h)
        : of(state.count()), impacts(contacts.spheres.size()), struck_(contacts.struck), loaded_(contacts.loaded),
          state_(state), model_(model), h_(h)
    {
    }

    void hold_at_pistons(const TileContacts& pistons)
    {
        for (const std::size_t k : pistons.indices()) of[pistons.a(k)].held = true;
    }

    /// Notes what struck spheres meet, and takes what waits for an impact out of the problem, but in a bed under load.
    void survey_walls(TileContacts& walls)
    {
        for (const std::size_t k : walls.indices()) {
            if (!struck_[walls.a(k)]) continue;
            if (walls.waits(k) && !(is_rigid() && loaded_[walls.a(k)]))
                walls.take_out(k);
            else
                of[walls.a(k)].held = true;
        }
    }

    void survey_spheres(TileContacts& spheres, std::size_t tile)
    {
        for (std::size_t p = 0; p < spheres.packs(); ++p)
            for (unsigned lanes = struck_lanes(spheres, p); lanes != 0; lanes &= lanes - 1)
                survey(spheres, pack_size * p + static_cast<std::size_t>(std::countr_zero(lanes)), tile);
    }

    /// Keeps those that meet one other that meets none but them. Moved by one instant they keep their potential energy,
    /// several that meet each other do not.
    void keep_pairs(const TileContacts& spheres, std::size_t tile)
    {
        for (const std::uint32_t k : impacts[tile]) {
            Meetings &a = of[spheres.a(k)], &b = of[spheres.b(k)];
            if (a.meets_one() && b.meets_one()) continue;
            a.held = b.held = true;
        }
    }

    Vec3 across(std::int32_t a, std::int32_t b) const
    {
        return model_.periodicity.nearest_image(state_.position[a] - state_.position[b]);
    }

private:
    const std::vector<std::uint8_t>&struck_, &loaded_; ///< by sphere
    const State& state_;
    const Model& model_;
    double h_;

    /// The lanes of contacts of which a sphere is struck, as bits.
    unsigned struck_lanes(const TileContacts& spheres, std::size_t p) const
    {
        const ContactPack& pack = spheres.pack(p);
        unsigned lanes = 0;
        for (unsigned lane = 0; lane < pack_size && pack.a[lane] >= 0; ++lane)
            lanes |= static_cast<unsigned>(struck_[pack.a[lane]] | struck_[pack.b[lane]]) << lane;
        return lanes & spheres.record(p).in_problem;
    }

    void survey(TileContacts& spheres, std::size_t k, std::size_t tile)
    {
        const std::int32_t a = spheres.a(k), b = spheres.b(k);
        const bool in_loaded_bed = is_rigid() ? loaded_[a] | loaded_[b] : loaded_[a] & loaded_[b];
        if (spheres.waits(k) && !in_loaded_bed) return spheres.take_out(k);
        note(spheres, k);
        if (spheres.kind(k) == ContactKind::impact) impacts[tile].push_back(static_cast<std::uint32_t>(k));
    }

    bool is_rigid() const { return model_.solver.stabilisation == Stabilisation::projected; }

    void note(const TileContacts& spheres, std::size_t k)
    {
        Meetings &a = of[spheres.a(k)], &b = of[spheres.b(k)];
        if (spheres.kind(k) != ContactKind::impact) {
            a.held = b.held = true;
            return;
        }
        const double instant = instant_of(spheres, k);
        for (Meetings* met : {&a, &b}) {
            ++met->impacts;
            met->instants += instant;
        }
    }

    double instant_of(const TileContacts& spheres, std::size_t k) const
    {
        const Motion &a = state_.motion[spheres.a(k)], &b = state_.motion[spheres.b(k)];
        const Vec3 apart = across(spheres.a(k), spheres.b(k)), velocity = a.velocity - b.velocity;
        const double radii = a.radius + b.radius;
        const double closes = closing_time<double>(-apart.dot(velocity), velocity.squaredNorm(),
            apart.squaredNorm() - radii * radii, [](double square) { return std::sqrt(square); });
        return std::clamp(closes, -h_, h_);
    }
};

/// The impact between spheres, seen from where both are at their instants.
void place(TileContacts& spheres, std::size_t k, const MeetingSurvey& meetings, const State& state, const Model& model)
{
    Contact c = spheres.contact(k);
    ContactTerms terms = spheres.terms(k);
    const Motion &a = state.motion[c.a], &b = state.motion[c.b];
    const Vec3 at_instants =
        meetings.across(c.a, c.b) + meetings.of[c.a].instant() * a.velocity - meetings.of[c.b].instant() * b.velocity;
    const double distance = at_instants.norm();
    if (distance == 0.0) return;
    c.normal = at_instants / distance;
    const auto& law = model.materials.between(state.material[c.a], state.material[c.b]);
    c.target = -law.restitution * std::min(0.0, c.normal.dot(a.velocity - b.velocity));
    terms.arm_scale = distance / (a.radius + b.radius);
    if (model.physics.spin)
        terms.tangent_mass =
            1.0 / (terms.inverse_mass_sum * (1.0 + inverse_inertia_factor * terms.arm_scale * terms.arm_scale));
    spheres.set(k, c, terms);
}

} // namespace

std::vector<Flight> place_impacts(ContactNetwork& network, const State& state, const Model& model, double h)
{
    StepContacts& contacts = network.contacts;
    MeetingSurvey meetings(contacts, state, model, h);
    meetings.hold_at_pistons(contacts.pistons);
    with_tile_crew(network.list.tiles, [&](TileCrew& crew) {
        crew.color_by_color([&](std::size_t tile) {
            meetings.survey_spheres(contacts.spheres[tile], tile);
            meetings.survey_walls(contacts.walls[tile]);
        });
        if (!model.gravity.isZero())
            crew.color_by_color([&](std::size_t tile) { meetings.keep_pairs(contacts.spheres[tile], tile); });
        crew.all_at_once([&](std::size_t tile) {
            for (const std::uint32_t k : meetings.impacts[tile])
                place(contacts.spheres[tile], k, meetings, state, model);
        });
    });

    std::vector<Flight> flights;
    for (std::size_t i = 0; i < state.count(); ++i)
        if (const Meetings& met = meetings.of[i]; met.in_flight())
            flights.push_back({static_cast<std::int32_t>(i), met.instant(),
                met.instant() * (state.motion[i].velocity + h * model.gravity)});
    return flights;
}

void move_flights(const std::vector<Flight>& flights, State& state)
{
    for (const Flight& flight : flights)
        state.position[flight.sphere] += flight.way - flight.instant * state.motion[flight.sphere].velocity;
}

} // namespace talus
