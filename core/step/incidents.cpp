// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/step/incidents.hpp"

#include "core/base/disjoint_sets.hpp"
#include "core/contacts/loads.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

namespace talus
{
namespace
{

/// Contacts of this overlap join bodies to a group, in smallest diameters: far more than they have at rest.
constexpr double joining_overlap = 1e-3;

/// An overlap with a wall that has just appeared which shows that it stands inside a sphere, in smallest diameters.
constexpr double inside = 0.05;

template <class Use> void for_each_sphere_contact(const ContactNetwork& network, Use&& use)
{
    for (const TileContacts& contacts : network.contacts.spheres)
        for (const std::size_t k : contacts.indices()) use(contacts.contact(k));
}

template <class Use> void for_each_wall_contact(const ContactNetwork& network, Use&& use)
{
    const auto use_all = [&](const TileContacts& contacts) {
        for (const std::size_t k : contacts.indices()) use(contacts.contact(k));
    };
    for (const TileContacts& contacts : network.contacts.walls) use_all(contacts);
    use_all(network.contacts.pistons);
}

/// Changes what is known of contacts: change(contact, touch).
template <class Change> void change_records(ContactNetwork& network, Change&& change)
{
    const auto change_all = [&](TileContacts& contacts, CarriedImpulses& carried) {
        for (const std::size_t k : contacts.indices()) {
            TouchRecord touch = contacts.touch(k);
            change(contacts.contact(k), touch);
            contacts.set_touch(k, touch);
            carried.contact[contacts.slot(k)].touch = touch;
        }
    };
    for (std::size_t t = 0; t < network.contacts.spheres.size(); ++t) {
        change_all(network.contacts.spheres[t], network.list.tiles.tiles[t].carried);
        change_all(network.contacts.walls[t], network.carried.walls);
    }
    change_all(network.contacts.pistons, network.carried.walls);
}

/// What is known of a group.
struct Press {
    std::set<std::int64_t> spheres; ///< ids
    std::set<std::int32_t> walls;
    bool is_new = false, is_known = false;
    double overlap = 0.0;    ///< of the deepest jammed contact
    std::int32_t sphere = 0; ///< one that it presses, by storage index

    void add(const Contact& c, const State& state)
    {
        spheres.insert(state.id[c.a]);
        is_known = is_known || (c.touch.is_jammed() && !c.touch.is_newly_jammed());
        is_new = is_new || c.touch.is_newly_jammed();
        if (!c.touch.is_jammed() || -c.gap <= overlap) return;
        overlap = -c.gap;
        sphere = c.a;
    }

    Incident incident(const State& state) const
    {
        return {.kind = Incident::Kind::pressed,
            .id = state.id[sphere],
            .position = state.position[sphere],
            .speed = state.body(sphere).velocity.norm(),
            .last_wall = state.last_wall[sphere],
            .spheres = {spheres.begin(), spheres.end()},
            .walls = {walls.begin(), walls.end()},
            .overlap = overlap};
    }
};

} // namespace

std::vector<Incident> find_presses(ContactNetwork& network, const State& state, const Model& model)
{
    const auto is_deep = [&](const Contact& c) { return -c.gap > joining_overlap * model.min_diameter; };
    DisjointSets groups(state.count());
    for_each_sphere_contact(network, [&](const Contact& c) {
        if (is_deep(c)) groups.join(static_cast<std::size_t>(c.a), static_cast<std::size_t>(c.b));
    });

    std::map<std::size_t, Press> presses; // by the first sphere of a group
    const auto add = [&](const Contact& c) -> Press& {
        Press& press = presses[groups.first_of_set(static_cast<std::size_t>(c.a))];
        press.add(c, state);
        return press;
    };
    for_each_sphere_contact(network, [&](const Contact& c) {
        if (is_deep(c)) add(c).spheres.insert(state.id[c.b]);
    });
    for_each_wall_contact(network, [&](const Contact& c) {
        if (is_deep(c)) add(c).walls.insert(c.b);
    });
    // A wall that is driven and presses on a group is part of it, even if it only touches.
    const auto is_driven_wall = [&](std::int32_t wall) { return !model.walls[wall].motion.empty(); };
    for_each_wall_contact(network, [&](const Contact& c) {
        const auto group = presses.find(groups.first_of_set(static_cast<std::size_t>(c.a)));
        if (group != presses.end() && is_driven_wall(c.b) && !c.impulse.isZero(0.0)) group->second.walls.insert(c.b);
    });

    const auto is_driven = [&](const Press& press) { return std::ranges::any_of(press.walls, is_driven_wall); };
    // A press is reported once; what no wall drives yet is looked at again.
    change_records(network, [&](const Contact& c, TouchRecord& touch) {
        if (!is_deep(c)) return;
        const Press& press = presses.at(groups.first_of_set(static_cast<std::size_t>(c.a)));
        if (!press.is_new) return;
        if (!is_driven(press))
            touch.note_hold();
        else if (!touch.is_newly_jammed())
            touch.note_known();
    });

    std::vector<Incident> incidents;
    for (const auto& [group, press] : presses)
        if (press.is_new && !press.is_known && is_driven(press)) incidents.push_back(press.incident(state));
    return incidents;
}

std::vector<Incident> find_walls_inside(const ContactNetwork& network, const State& state, const Model& model)
{
    std::map<std::int32_t, Incident> found; // by wall
    if (std::ranges::none_of(model.walls, [](const Wall& wall) { return wall.appear_at > 0.0; })) return {};
    for (const TileContacts& contacts : network.contacts.walls)
        for (const std::size_t k : contacts.indices()) {
            const auto [sphere, wall] = std::pair(contacts.a(k), contacts.b(k));
            const double gap = contacts.gap(k);
            const double age = state.time - model.walls[wall].appear_at;
            const bool is_new =
                model.walls[wall].appear_at > 0.0 && age < 2.0 * model.time_step && !contacts.touch(k).is_loaded();
            if (!is_new || -gap < inside * model.min_diameter) continue;
            Incident& incident = found[wall];
            incident.kind = Incident::Kind::appeared_inside;
            incident.spheres.push_back(state.id[sphere]);
            incident.walls = {wall};
            if (-gap <= incident.overlap) continue;
            incident.overlap = -gap;
            incident.id = state.id[sphere];
            incident.position = state.position[sphere];
            incident.speed = state.body(sphere).velocity.norm();
            incident.last_wall = wall;
        }
    std::vector<Incident> incidents;
    for (auto& [wall, incident] : found) incidents.push_back(std::move(incident));
    return incidents;
}

void add_incidents(std::vector<Incident>& all, std::vector<Incident> next)
{
    for (const Incident& earlier : all)
        std::erase_if(next, [&](const Incident& incident) {
            return incident.kind == earlier.kind && incident.id == earlier.id &&
                   (!incident.of_piston() || incident.last_wall == earlier.last_wall);
        });
    next.insert(next.end(), std::make_move_iterator(all.begin()), std::make_move_iterator(all.end()));
    all = std::move(next);
}

} // namespace talus
