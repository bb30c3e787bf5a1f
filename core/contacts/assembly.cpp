// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contacts/assembly.hpp"

#include "core/candidates/candidate_search.hpp"
#include "core/contacts/sphere_contacts.hpp"
#include "core/contacts/wall_assembly.hpp"
#include "core/contacts/wall_detection.hpp"

#include <algorithm>
#include <span>

namespace talus
{
namespace
{

StepConstants step_constants(const Model& model, const StepLength& length)
{
    StepConstants step{};
    step.law = law_of_step(model, length);
    step.reach = contact_reach(model) * model.min_diameter;
    step.horizon = closing_horizon * step.law.h;
    step.inverse_inertia_factor = model.physics.spin ? inverse_inertia_factor : 0.0;
    for (int d = 0; d < 3; ++d) step.cell_length[d] = model.periodicity.length[d];
    step.is_periodic = model.periodicity.any();
    return step;
}

/// Calls use(meetings) for each pair of a run of wall pairs that its sphere meets.
template <class Use> void for_each_meeting_pair(std::span<WallPair> pairs, WallDetection& detection, Use&& use)
{
    for (auto first = pairs.begin(); first != pairs.end();) {
        const auto last =
            std::find_if(first, pairs.end(), [&](const WallPair& pair) { return pair.sphere != first->sphere; });
        const std::span<const WallMeeting> meetings = detection.find({first, last});
        for (auto from = meetings.begin(); from != meetings.end();) {
            const auto to =
                std::find_if(from, meetings.end(), [&](const WallMeeting& other) { return other.pair != from->pair; });
            use(std::span<const WallMeeting>{from, to});
            from = to;
        }
        for (auto& pair : std::span<WallPair>{first, last})
            if (pair.carried > 0 &&
                std::ranges::none_of(meetings, [&](const WallMeeting& meeting) { return meeting.pair == &pair; }))
                detection.forget(pair);
        first = last;
    }
}

ContactSurvey assemble_wall_contacts(ContactNetwork& network, std::size_t tile, const State& state, const Model& model,
    const std::vector<PlacedWall>& walls, const StepConstants& step)
{
    WallAssembly assembly(
        network.contacts.walls[tile], false, network.carried.walls, network.contacts, state, model, step);
    WallDetection detection(network, state, model, walls, step);
    CandidateList& list = network.list;
    const std::span<WallPair> pairs{list.wall_pairs.begin() + list.wall_pairs_of_tile[tile],
        list.wall_pairs.begin() + list.wall_pairs_of_tile[tile + 1]};
    for_each_meeting_pair(pairs, detection, [&](std::span<const WallMeeting> meetings) {
        if (walls[meetings.front().pair->wall].is_piston()) return;
        detection.lay(meetings, [&](const WallTouch& touch, const WallMeeting&) { assembly.add(touch); });
    });
    return assembly.make();
}

/// The contacts with all pistons, in the order of the wall pairs.
ContactSurvey assemble_piston_contacts(ContactNetwork& network, const State& state, const Model& model,
    const std::vector<PlacedWall>& walls, const StepConstants& step)
{
    WallAssembly assembly(network.contacts.pistons, true, network.carried.walls, network.contacts, state, model, step);
    WallDetection detection(network, state, model, walls, step);
    for_each_meeting_pair(network.list.wall_pairs, detection, [&](std::span<const WallMeeting> meetings) {
        const PlacedWall& wall = walls[meetings.front().pair->wall];
        if (!wall.is_piston()) return;
        const Vec3 center = wall.pose()(model.pistons[wall.wall().piston].center);
        detection.lay(meetings, [&](const WallTouch& touch, const WallMeeting& meeting) {
            const Vec3 place = detection.place(touch.sphere) - state.radius[touch.sphere] * touch.normal;
            network.contacts.piston_arms.push_back(
                place - wall.image_of(static_cast<std::size_t>(meeting.at.patch)) - center);
            assembly.add(touch);
        });
    });
    return assembly.make();
}

} // namespace

ContactSurvey assemble_contacts(ContactNetwork& network, const State& state, const Model& model,
    const StepLength& length, const std::vector<PlacedWall>& walls)
{
    const StepConstants step = step_constants(model, length);
    network.contacts.resize(network.list, model.physics, state.count());
    SphereAssembly spheres(network, state, model, step);
    const auto tiles = static_cast<std::int64_t>(network.list.tiles.count());
    std::vector<ContactSurvey> surveys(network.list.tiles.count());
#pragma omp parallel for schedule(dynamic) if (tiles > 16)
    for (std::int64_t t = 0; t < tiles; ++t) {
        const auto tile = static_cast<std::size_t>(t);
        surveys[tile] = spheres.assemble(tile);
        surveys[tile] += assemble_wall_contacts(network, tile, state, model, walls, step);
    }
    ContactSurvey all;
    for (const auto& survey : surveys) all += survey;
    if (model.physics.pistons) all += assemble_piston_contacts(network, state, model, walls, step);
    return all;
}

} // namespace talus
