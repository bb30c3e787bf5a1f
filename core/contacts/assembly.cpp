// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contacts/assembly.hpp"

#include "core/candidates/candidate_search.hpp"
#include "core/contacts/sphere_contacts.hpp"
#include "core/contacts/wall_assembly.hpp"
#include "core/contacts/wall_contacts.hpp"

#include <algorithm>

namespace talus
{
namespace
{

constexpr double touching = 1e-9;   ///< overlap of spheres laid side by side, for rounding [smallest diameters]
constexpr double least_turn = 1e-9; ///< of a wall's normal in a step: less is rounding

StepConstants step_constants(const Model& model, const StepLength& length, double h_before)
{
    const double h = length.h();
    StepConstants step{};
    step.law = {.h = h,
        .h_before = h_before,
        .threshold_speed = model.solver.restitution_threshold * model.gravity.norm() * length.whole,
        .rigid = model.solver.stabilisation == Stabilisation::projected,
        .min_sweeps = static_cast<double>(model.solver.min_sweeps),
        .push_out_speed = model.solver.push_out_speed,
        .parts = static_cast<double>(length.parts),
        .shallow_overlap = length.shallow_overlap};
    step.reach = open_contact_reach * model.min_diameter;
    step.horizon = closing_horizon * h;
    step.touching = touching * model.min_diameter;
    step.inverse_inertia = model.physics.spin ? inverse_inertia_factor : 0.0;
    step.restitution = model.physics.restitution;
    step.jam_steps = TouchRecord::jam_steps;
    for (int d = 0; d < 3; ++d) step.cell_length[d] = model.periodicity.length[d];
    step.is_periodic = model.periodicity.any();
    return step;
}

/// Finds the contacts of wall pairs and hands them to an assembly.
class WallDetection
{
public:
    WallDetection(ContactNetwork& network, const State& state, const Model& model, const std::vector<PlacedWall>& walls,
        const StepConstants& step)
        : network_(network), state_(state), model_(model), walls_(walls), step_(step)
    {
    }

    /// The contacts of one pair. Calls note(point, shift) for each that is added: where the wall is touched, seen from
    /// the image of the sphere that is shifted so.
    template <class Note> void add_contacts(WallPair& pair, WallAssembly& assembly, Note&& note)
    {
        const PlacedWall& wall = walls_[pair.wall];
        // The image of the sphere for which the patches are listed.
        const Vec3& x = state_.position[pair.sphere];
        const Vec3 shift = model_.periodicity.shift_towards(x, network_.list.listed_box[pair.sphere].center());
        find_points(pair, wall, x + shift);
        const bool alone = pair.carried == 1 && points_.size() == 1;
        const Vec3 normal_before = alone ? network_.carried.wall_normal[pair.first] : Vec3(Vec3::Zero());
        match_carried(network_.carried, pair, points_);
        const Vec3 turn = alone ? Vec3(points_[0].normal - normal_before) : Vec3(Vec3::Zero());
        for (std::size_t k = 0; k < points_.size(); ++k) {
            if (add(pair, wall, points_[k], turn, pair.first + static_cast<std::uint32_t>(k), x + shift, assembly))
                note(points_[k], shift);
        }
    }

private:
    ContactNetwork& network_;
    const State& state_;
    const Model& model_;
    const std::vector<PlacedWall>& walls_;
    const StepConstants& step_;
    std::vector<WallPoint> points_;

    /// @param x the sphere's centre
    static WallRow wall_row(const PlacedWall& wall, const WallPoint& at, const Vec3& x, double radius)
    {
        if (!wall.moves()) return {};
        return {wall.velocity(static_cast<std::size_t>(at.patch), x - radius * at.normal), wall.spin()};
    }

    static Vec3 velocity_before(const PlacedWall& wall, const WallPoint& at, const Vec3& x, double radius)
    {
        if (!wall.moves()) return Vec3::Zero();
        return wall.velocity_before(static_cast<std::size_t>(at.patch), x - radius * at.normal);
    }

    void find_points(const WallPair& pair, const PlacedWall& wall, const Vec3& x)
    {
        points_.clear();
        if (!wall.stands()) return;
        const Motion& m = state_.motion[pair.sphere];
        const Vec3 ahead = m.velocity + step_.law.h * model_.gravity;
        const double wall_speed = wall.moves() ? wall.fastest(Box{x, x}.grown(m.radius)) : 0.0;
        const double reach = std::max(step_.reach, step_.horizon * (ahead.norm() + wall_speed));
        find_wall_points(wall, network_.list.patches.data() + pair.first, pair.patches, x, m.radius + reach, points_);
        std::erase_if(points_, [&](const WallPoint& at) {
            const Vec3 wall_ahead = wall_row(wall, at, x, m.radius).velocity + wall.gain();
            const double gap = at.distance - m.radius;
            return gap > step_.reach && gap + step_.horizon * at.normal.dot(ahead - wall_ahead) > 0.0;
        });
    }

    /// What the turn of the normal since the step before has added to u_n [m/s]: known where the wall stands still and
    /// has borne the sphere at one place. A turn about less than the sphere's radius is that of an edge.
    double turned(const PlacedWall& wall, const Motion& m, const Vec3& turn, std::uint32_t slot) const
    {
        const double angle = turn.norm();
        const bool is_smooth = angle > least_turn && angle * m.radius <= step_.law.h * m.velocity.norm();
        const bool was_borne = !network_.carried.walls.contact[slot].impulse.isZero(0.0);
        return !wall.moves() && is_smooth && was_borne ? turn.dot(m.velocity) : 0.0;
    }

    /// @param turn of the normal since the step before, zero where it is not known
    bool add(const WallPair& pair, const PlacedWall& wall, const WallPoint& at, const Vec3& turn, std::uint32_t slot,
        const Vec3& x, WallAssembly& assembly)
    {
        const Motion& m = state_.motion[pair.sphere];
        const Vec3& n = at.normal;
        const double gap = at.distance - m.radius;
        const WallRow row = wall_row(wall, at, x, m.radius);
        const double u_n = n.dot(m.velocity - row.velocity);
        const double u_n_ahead = u_n + step_.law.h * n.dot(model_.gravity) - n.dot(wall.gain());
        const double wall_inverse_mass = wall.is_piston() ? 1.0 / model_.pistons[wall.wall().piston].mass : 0.0;
        return assembly.add({.sphere = pair.sphere,
                                .wall = pair.wall,
                                .normal = n,
                                .gap = gap,
                                .u_n = u_n,
                                .u_n_ahead = u_n_ahead,
                                .closes = u_n_ahead < 0.0 ? -gap / u_n_ahead : infinity,
                                .u_n_before = n.dot(m.velocity - velocity_before(wall, at, x, m.radius)),
                                .u_n_turned = turned(wall, m, turn, slot),
                                .inverse_mass_sum = m.inverse_mass + wall_inverse_mass,
                                .slot = slot,
                                .wall_level = n.dot(state_.position[pair.sphere]) - gap + way_ahead(wall, n, row),
                                .row = row},
            model_.materials.between(state_.material[pair.sphere], wall.wall().material));
    }

    /// By how much the wall's level rises in the step, where that is known beforehand [m].
    double way_ahead(const PlacedWall& wall, const Vec3& normal, const WallRow& row) const
    {
        return wall.is_piston() ? 0.0 : step_.law.h * normal.dot(row.velocity);
    }
};

ContactSurvey assemble_wall_contacts(ContactNetwork& network, std::size_t tile, const State& state, const Model& model,
    const std::vector<PlacedWall>& walls, const StepConstants& step)
{
    WallAssembly assembly(
        network.contacts.walls[tile], false, network.carried.walls, network.contacts, state, model, step);
    WallDetection detection(network, state, model, walls, step);
    CandidateList& list = network.list;
    for (auto p = list.wall_pairs_of_tile[tile]; p < list.wall_pairs_of_tile[tile + 1]; ++p) {
        auto& pair = list.wall_pairs[p];
        if (!walls[pair.wall].is_piston()) detection.add_contacts(pair, assembly, [](const WallPoint&, const Vec3&) {});
    }
    return assembly.finish();
}

/// The contacts with all pistons, in the order of the wall pairs.
ContactSurvey assemble_piston_contacts(ContactNetwork& network, const State& state, const Model& model,
    const std::vector<PlacedWall>& walls, const StepConstants& step)
{
    WallAssembly assembly(network.contacts.pistons, true, network.carried.walls, network.contacts, state, model, step);
    WallDetection detection(network, state, model, walls, step);
    for (auto& pair : network.list.wall_pairs) {
        const PlacedWall& wall = walls[pair.wall];
        if (!wall.is_piston()) continue;
        const Vec3 center = wall.pose()(model.pistons[wall.wall().piston].center);
        detection.add_contacts(pair, assembly, [&](const WallPoint& at, const Vec3& shift) {
            const Vec3 place = state.position[pair.sphere] + shift - state.radius(pair.sphere) * at.normal;
            network.contacts.piston_arms.push_back(place - wall.image_of(static_cast<std::size_t>(at.patch)) - center);
        });
    }
    return assembly.finish();
}

} // namespace

ContactSurvey& ContactSurvey::operator+=(const ContactSurvey& other)
{
    count += other.count;
    impacts += other.impacts;
    overlapping += other.overlapping;
    worst_overlap = std::max(worst_overlap, other.worst_overlap);
    overlap_sum += other.overlap_sum;
    stored_energy += other.stored_energy;
    return *this;
}

void ContactSurvey::then(const ContactSurvey& next)
{
    const ContactSurvey before = *this;
    *this = next;
    worst_overlap = std::max(worst_overlap, before.worst_overlap);
    stored_energy = before.stored_energy;
}

ContactSurvey assemble_contacts(ContactNetwork& network, const State& state, const Model& model,
    const StepLength& length, const std::vector<PlacedWall>& walls)
{
    const StepConstants step = step_constants(model, length, network.carried.step_before);
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
