// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contacts/flight.hpp"

#include "core/candidates/tile_crew.hpp"
#include "core/law/impact.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace talus
{
namespace
{

/// When spheres so far apart touch that move so against each other, from now on; 0 where they do already.
double meeting_instant(const Vec3& apart, const Vec3& velocity, double radii, double h)
{
    const double closes =
        closing_time<double>(-apart.dot(velocity), velocity.squaredNorm(), apart.squaredNorm() - radii * radii);
    return std::clamp(closes, 0.0, h);
}

/// What a sphere meets in this step.
struct Meetings {
    double instants = 0.0; ///< sum over its impacts with spheres [s]
    int impacts = 0;       ///< with spheres
    bool bound = false;    ///< it has other contacts, or impacts with walls

    bool meets_one() const { return impacts == 1 && !bound; }
    bool in_flight() const { return impacts > 0 && !bound; }
    double instant() const { return instants / impacts; }
};

/// Whether a contact may have an impulse that keeps a sphere from flying: not what is deferred, or parts after an
/// impact.
bool binds(const TileContacts& contacts, std::size_t k)
{
    const ContactKind kind = contacts.kind(k);
    return kind != ContactKind::deferred &&
           !(kind == ContactKind::bearing && contacts.touch(k).last() == TouchRecord::impact);
}

class MeetingSurvey
{
public:
    std::vector<Meetings> of; ///< by sphere, of those that have an impact

    MeetingSurvey(const ContactNetwork& network, const State& state, const Model& model, double h)
        : of(state.count()), contacts_(network.contacts), state_(state), model_(model), h_(h)
    {
        bind(contacts_.pistons);
        with_tile_crew(network.list.tiles, [&](TileCrew& crew) {
            crew.color_by_color([&](std::size_t tile) {
                bind(contacts_.walls[tile]);
                note(contacts_.spheres[tile]);
            });
            // Moved by one instant a pair keeps its potential energy; several that meet each other do not.
            if (!model.gravity.isZero())
                crew.color_by_color([&](std::size_t tile) { keep_pairs(contacts_.spheres[tile]); });
        });
    }

private:
    const StepContacts& contacts_;
    const State& state_;
    const Model& model_;
    const double h_;

    void bind(const TileContacts& walls)
    {
        for (const std::size_t k : walls.struck())
            if (binds(walls, k)) of[walls.a(k)].bound = true;
    }

    void note(const TileContacts& spheres)
    {
        for (const std::size_t k : spheres.struck()) {
            const auto [a, b] = std::pair(spheres.a(k), spheres.b(k));
            if (!binds(spheres, k)) continue;
            if (spheres.kind(k) != ContactKind::impact) {
                of[a].bound = of[b].bound = true;
                continue;
            }
            const Vec3 apart = model_.periodicity.nearest_image(state_.position[a] - state_.position[b]);
            const double instant = meeting_instant(
                apart, state_.body(a).velocity - state_.body(b).velocity, state_.radius[a] + state_.radius[b], h_);
            for (const std::int32_t sphere : {a, b}) {
                ++of[sphere].impacts;
                of[sphere].instants += instant;
            }
        }
    }

    void keep_pairs(const TileContacts& spheres)
    {
        for (const std::size_t k : spheres.struck()) {
            if (spheres.kind(k) != ContactKind::impact) continue;
            Meetings &a = of[spheres.a(k)], &b = of[spheres.b(k)];
            if (!a.meets_one() || !b.meets_one()) a.bound = b.bound = true;
        }
    }
};

} // namespace

std::vector<Flight> find_flights(const ContactNetwork& network, const State& state, const Model& model, double h)
{
    const MeetingSurvey meetings(network, state, model, h);
    std::vector<Flight> flights;
    for (std::size_t i = 0; i < state.count(); ++i)
        if (const Meetings& met = meetings.of[i]; met.in_flight() && met.instants > 0.0)
            flights.push_back({static_cast<std::int32_t>(i), met.instant(),
                met.instant() * (state.body(i).velocity + h * model.gravity)});
    return flights;
}

double move_flights(const std::vector<Flight>& flights, State& state, const Vec3& gravity)
{
    double lifted = 0.0;
    for (const Flight& flight : flights) {
        const Vec3 shift = flight.way - flight.instant * state.body(flight.sphere).velocity;
        state.position[flight.sphere] += shift;
        lifted -= state.mass(flight.sphere) * gravity.dot(shift);
    }
    return lifted;
}

} // namespace talus
