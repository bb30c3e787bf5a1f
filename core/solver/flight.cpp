// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/flight.hpp"

#include "core/packs/law.hpp"
#include "core/solver/tile_crew.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace talus
{
namespace
{

/// How many contacts a sphere has that may have an impulse, by sphere; counted for those that have an impact.
class Meetings
{
public:
    Meetings(const ContactNetwork& network, std::size_t spheres) : contacts_(network.contacts), count_(spheres)
    {
        count(contacts_.pistons, true);
        with_tile_crew(network.list.tiles, [&](TileCrew& crew) {
            crew.color_by_color([&](std::size_t tile) {
                count(contacts_.spheres[tile], false);
                count(contacts_.walls[tile], true);
            });
        });
    }

    bool is_alone(std::int32_t sphere) const { return count_[sphere] == 1; }

private:
    const StepContacts& contacts_;
    std::vector<std::int32_t> count_;

    void count(const TileContacts& contacts, bool with_walls)
    {
        for (const std::size_t k : contacts.indices()) {
            if (contacts.kind(k) == ContactKind::deferred) continue;
            add(contacts.a(k));
            if (!with_walls) add(contacts.b(k));
        }
    }

    void add(std::int32_t sphere)
    {
        if (contacts_.impacts[sphere].size > 0.0) ++count_[sphere];
    }
};

/// When two spheres touch, from now on; 0 where they do already.
double meeting_instant(const Motion& a, const Motion& b, const Vec3& apart, double h)
{
    const Vec3 velocity = a.velocity - b.velocity;
    const double radii = a.radius + b.radius;
    const double closes = closing_time<double>(-apart.dot(velocity), velocity.squaredNorm(),
        apart.squaredNorm() - radii * radii, [](double square) { return std::sqrt(square); });
    return std::clamp(closes, 0.0, h);
}

} // namespace

std::vector<Flight> find_flights(const ContactNetwork& network, const State& state, const Model& model, double h)
{
    const Meetings meetings(network, state.count());
    std::vector<Flight> flights;
    for (const TileContacts& contacts : network.contacts.spheres)
        for (const std::size_t k : contacts.indices()) {
            const auto [a, b] = std::pair(contacts.a(k), contacts.b(k));
            if (contacts.kind(k) != ContactKind::impact || !meetings.is_alone(a) || !meetings.is_alone(b)) continue;
            const Vec3 apart = model.periodicity.nearest_image(state.position[a] - state.position[b]);
            const double instant = meeting_instant(state.motion[a], state.motion[b], apart, h);
            if (instant > 0.0)
                for (const std::int32_t sphere : {a, b})
                    flights.push_back(
                        {sphere, instant, instant * (state.motion[sphere].velocity + h * model.gravity)});
        }
    return flights;
}

void move_flights(const std::vector<Flight>& flights, State& state)
{
    for (const Flight& flight : flights)
        state.position[flight.sphere] += flight.way - flight.instant * state.motion[flight.sphere].velocity;
}

} // namespace talus
