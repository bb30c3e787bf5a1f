// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/flight.hpp"

#include "core/contacts/law.hpp"
#include "core/solver/tile_crew.hpp"

#include <algorithm>

namespace talus
{
namespace
{

/// What a sphere meets in this step.
struct Meetings {
    double instants = 0.0; ///< sum over the impacts [s]
    int impacts = 0;
    bool struck = false; ///< there is one, be it at a wall
    bool held = false;   ///< there are other contacts than impacts with spheres

    bool meets_one() const { return impacts == 1 && !held; }
    bool in_flight() const { return impacts > 0 && !held; }
    double instant() const { return in_flight() ? instants / impacts : 0.0; }
    void add(const ContactGeometry& geometry, double instant)
    {
        if (geometry.kind != ContactKind::impact)
            held = true;
        else {
            ++impacts;
            instants += instant;
        }
    }
};

/// Finds them for all spheres.
class MeetingSurvey
{
public:
    MeetingSurvey(const ContactNetwork& network, const State& state, const Model& model, double h)
        : of(state.count()), network_(network), state_(state), model_(model), h_(h)
    {
    }

    /// Tiles of one colour may be surveyed at the same time.
    void survey_impacts(std::size_t tile)
    {
        const TileContacts &spheres = network_.contacts.spheres[tile], &walls = network_.contacts.walls[tile];
        for (const std::size_t k : spheres.indices())
            if (spheres.geometry[k].kind == ContactKind::impact)
                of[spheres.a(k)].struck = of[spheres.b(k)].struck = true;
        for (const std::size_t k : walls.indices())
            if (walls.geometry[k].kind == ContactKind::impact) of[walls.a(k)].struck = true;
    }

    /// Takes what waits for an impact out of the problem.
    void leave_out(TileContacts& contacts, bool with_walls) const
    {
        for (std::size_t k = pack_size * contacts.packs(); k-- > 0;) {
            if (contacts.a(k) < 0 || !contacts.geometry[k].waits) continue;
            if (of[contacts.a(k)].struck || (!with_walls && of[contacts.b(k)].struck)) contacts.remove(k);
        }
    }

    void survey(std::size_t tile)
    {
        const TileContacts &spheres = network_.contacts.spheres[tile], &walls = network_.contacts.walls[tile];
        for (const std::size_t k : spheres.indices()) {
            const double instant = instant_of(spheres, k);
            of[spheres.a(k)].add(spheres.geometry[k], instant);
            of[spheres.b(k)].add(spheres.geometry[k], instant);
        }
        for (const std::size_t k : walls.indices()) of[walls.a(k)].held = true;
    }

    /// Keeps those that meet one other that meets none but them. Moved by one instant they keep their potential energy,
    /// several that meet each other do not.
    void keep_pairs(std::size_t tile)
    {
        const TileContacts& spheres = network_.contacts.spheres[tile];
        for (const std::size_t k : spheres.indices()) {
            Meetings &a = of[spheres.a(k)], &b = of[spheres.b(k)];
            if (a.meets_one() && b.meets_one()) continue;
            a.held = b.held = true;
        }
    }

    void survey_pistons()
    {
        const TileContacts& pistons = network_.contacts.pistons;
        for (const std::size_t k : pistons.indices()) of[pistons.a(k)].held = true;
    }

    Vec3 across(std::int32_t a, std::int32_t b) const
    {
        return model_.periodicity.nearest_image(state_.position[a] - state_.position[b]);
    }

    std::vector<Meetings> of; ///< by sphere

private:
    const ContactNetwork& network_;
    const State& state_;
    const Model& model_;
    double h_;

    double instant_of(const TileContacts& spheres, std::size_t k) const
    {
        if (spheres.geometry[k].kind != ContactKind::impact) return 0.0;
        const Motion &a = state_.motion[spheres.a(k)], &b = state_.motion[spheres.b(k)];
        const double closes =
            closing_time(across(spheres.a(k), spheres.b(k)), a.velocity - b.velocity, a.radius + b.radius);
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
    spheres.set(k, c, terms, spheres.geometry[k]);
}

} // namespace

std::vector<Flight> place_impacts(ContactNetwork& network, const State& state, const Model& model, double h)
{
    MeetingSurvey meetings(network, state, model, h);
    if (model.physics.pistons) meetings.survey_pistons();
    with_tile_crew(network.list.tiles, [&](TileCrew& crew) {
        crew.color_by_color([&](std::size_t tile) { meetings.survey_impacts(tile); });
        crew.all_at_once([&](std::size_t tile) {
            meetings.leave_out(network.contacts.spheres[tile], false);
            meetings.leave_out(network.contacts.walls[tile], true);
        });
        crew.color_by_color([&](std::size_t tile) { meetings.survey(tile); });
        if (!model.gravity.isZero()) crew.color_by_color([&](std::size_t tile) { meetings.keep_pairs(tile); });
        crew.all_at_once([&](std::size_t tile) {
            TileContacts& spheres = network.contacts.spheres[tile];
            for (const std::size_t k : spheres.indices())
                if (spheres.geometry[k].kind == ContactKind::impact) place(spheres, k, meetings, state, model);
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
