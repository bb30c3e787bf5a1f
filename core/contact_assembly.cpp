// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact_assembly.hpp"

#include "core/candidate_search.hpp"
#include "core/stabilisation.hpp"
#include "core/wall_contacts.hpp"

#include <algorithm>
#include <cmath>

namespace talus
{
namespace
{

/// Numbers that all contacts of a step share.
struct StepConstants {
    double h;
    double reach;           ///< of open contacts [m]
    double threshold_speed; ///< slowest impact [m/s]

    explicit StepConstants(const Model& model)
        : h(model.time_step), reach(open_contact_reach * model.min_diameter),
          threshold_speed(model.solver.restitution_threshold * model.gravity.norm() * model.time_step)
    {
    }
};

/// Geometry and motion of a contact, as detection found them.
struct Touch {
    std::int32_t a, b;
    Vec3 normal;
    double gap;
    double u_n;                 ///< of v⁽⁰⁾ [m/s]
    double u_n_ahead;           ///< of v⁽¹⁾ [m/s]
    double arm_scale;           ///< s
    double inverse_mass_sum;    ///< W
    double rolling_radius;      ///< R*
    double inverse_inertia_sum; ///< 1/I_a + 1/I_b [1/(kg m²)]
    std::uint32_t slot;
    WallRow wall = {}; ///< at walls that move
};

bool within_reach(double gap, double u_n_ahead, const StepConstants& step)
{
    return gap <= step.reach || gap + closing_horizon * step.h * u_n_ahead <= 0.0;
}

double inverse_inertia(const Motion& m)
{
    return inverse_inertia_factor * m.inverse_mass / (m.radius * m.radius);
}

/// The impulse carried into a contact: turned into the new frame and cut back to the cone, nothing for an impact.
Vec3 warm_impulse(const Vec3& carried, const Vec3& normal, double friction)
{
    const double normal_impulse = std::max(0.0, carried.dot(normal));
    Vec3 tangent = carried - carried.dot(normal) * normal;
    const double largest = friction * normal_impulse;
    const double size = tangent.norm();
    if (size > largest) tangent *= largest / size;
    return normal_impulse * normal + tangent;
}

/// Writes contacts of one tile into their arrays.
class TileAssembly
{
public:
    TileAssembly(ContactArrays& arrays, const CarriedImpulses& carried, std::size_t first, const Model& model,
        const StepConstants& step)
        : arrays_(arrays), carried_(carried), first_(first), next_(first), model_(model), step_(step),
          inertia_factor_(model.physics.spin ? inverse_inertia_factor : 0.0)
    {
    }

    void add(const Touch& touch, const ContactLaw& law, double wall_level)
    {
        const bool touched = carried_.touched[touch.slot];
        const auto kind =
            contact_kind(touch.gap, touch.u_n, touch.u_n_ahead, touched, law, step_.h, step_.threshold_speed);
        const Vec3 warm = kind == ContactKind::impact
                              ? Vec3::Zero().eval()
                              : warm_impulse(carried_.impulse[touch.slot], touch.normal, law.friction);
        const double w = touch.inverse_mass_sum;
        const auto normal =
            normal_law({kind, touch.gap, touch.u_n, w, warm.dot(touch.normal)}, law, model_.solver, step_.h);

        arrays_.contact[next_] = {touch.a, touch.b, touch.normal, normal.target, warm};
        arrays_.terms[next_] = {touch.arm_scale, law.friction, normal.compliance, 1.0 / (w + normal.compliance),
            1.0 / (w * (1.0 + inertia_factor_ * touch.arm_scale * touch.arm_scale)), w};
        arrays_.geometry[next_] = {touch.gap, wall_level, touch.slot, kind};
        if (!arrays_.wall.empty()) arrays_.wall[next_] = touch.wall;
        if (!arrays_.rolling.empty()) arrays_.rolling[next_] = rolling_row(touch, law, kind, warm.dot(touch.normal));
        ++next_;
        survey(touch.gap, normal.compliance);
    }

    void finish(std::size_t tile) { arrays_.count[tile] = static_cast<std::uint32_t>(next_ - first_); }
    const ContactSurvey& result() const { return survey_; }

private:
    RollingRow rolling_row(const Touch& touch, const ContactLaw& law, ContactKind kind, double warm_normal) const
    {
        RollingRow row{Vec3::Zero(), law.rolling_friction * touch.rolling_radius, 1.0 / touch.inverse_inertia_sum};
        if (kind == ContactKind::impact) return row;
        const Vec3& carried = carried_.rolling_impulse[touch.slot];
        row.impulse = carried - carried.dot(touch.normal) * touch.normal;
        const double largest = row.reach * warm_normal;
        const double size = row.impulse.norm();
        if (size > largest) row.impulse *= largest / size;
        return row;
    }

    void survey(double gap, double compliance)
    {
        ++survey_.contacts;
        if (gap >= 0.0) return;
        ++survey_.overlapping;
        survey_.worst_overlap = std::max(survey_.worst_overlap, -gap);
        survey_.overlap_sum -= gap;
        // k = 4 Υ / (Σ_n h²), the stiffness that the compliance stands for.
        if (compliance > 0.0) survey_.contact_energy += 2.0 * upsilon / (compliance * step_.h * step_.h) * gap * gap;
    }

    ContactArrays& arrays_;
    const CarriedImpulses& carried_;
    std::size_t first_, next_;
    const Model& model_;
    const StepConstants& step_;
    double inertia_factor_; ///< 0 where spheres do not turn
    ContactSurvey survey_;
};

/// @param periodic whether there is a border to reach across
template <bool periodic>
ContactSurvey assemble_sphere_contacts(
    ContactNetwork& network, std::size_t tile, const State& state, const Model& model, const StepConstants& step)
{
    TileAssembly assembly(network.sphere_contacts, network.pair_carried, network.pairs_of_tile[tile], model, step);
    for (auto k = network.pairs_of_tile[tile]; k < network.pairs_of_tile[tile + 1]; ++k) {
        const auto [a, b] = network.pairs[k];
        const Motion& ma = state.motion[a];
        const Motion& mb = state.motion[b];
        Vec3 across = state.position[a] - state.position[b];
        if constexpr (periodic) across = model.periodicity.nearest_image(across);
        const double radii = ma.radius + mb.radius;
        const double closing = across.dot(ma.velocity - mb.velocity);
        if (closing >= 0.0 && across.squaredNorm() > (radii + step.reach) * (radii + step.reach)) {
            network.pair_carried.clear(k);
            continue;
        }
        const double distance = across.norm();
        // Spheres with one centre are pushed apart along a fixed direction: any will do, but always the same.
        const Vec3 normal = distance > 0.0 ? Vec3(across / distance) : Vec3::UnitZ();
        const double u_n = normal.dot(ma.velocity - mb.velocity);
        if (!within_reach(distance - radii, u_n, step)) {
            network.pair_carried.clear(k);
            continue;
        }
        assembly.add({.a = a,
                         .b = b,
                         .normal = normal,
                         .gap = distance - radii,
                         .u_n = u_n,
                         .u_n_ahead = u_n, // gravity is the same for both
                         .arm_scale = distance / radii,
                         .inverse_mass_sum = ma.inverse_mass + mb.inverse_mass,
                         .rolling_radius = ma.radius * mb.radius / radii,
                         .inverse_inertia_sum = model.physics.rolling ? inverse_inertia(ma) + inverse_inertia(mb) : 0.0,
                         .slot = k},
            model.materials.between(state.material[a], state.material[b]), 0.0);
    }
    assembly.finish(tile);
    return assembly.result();
}

ContactSurvey assemble_wall_contacts(ContactNetwork& network, std::size_t tile, const State& state, const Model& model,
    const std::vector<PlacedWall>& walls, const StepConstants& step)
{
    TileAssembly assembly(network.wall_contacts, network.wall_carried, network.wall_slots_of_tile[tile], model, step);
    std::vector<WallPoint> points;
    for (auto p = network.wall_pairs_of_tile[tile]; p < network.wall_pairs_of_tile[tile + 1]; ++p) {
        auto& pair = network.wall_pairs[p];
        const PlacedWall& wall = walls[pair.wall];
        const Motion& m = state.motion[pair.sphere];
        const Vec3& x = state.position[pair.sphere];
        // The image of the sphere for which the patches are listed.
        const Vec3 shift = model.periodicity.shift_towards(x, network.listed_box[pair.sphere].center());
        const auto wall_row = [&](const WallPoint& at) -> WallRow {
            if (!wall.moves()) return {};
            return {wall.velocity(static_cast<std::size_t>(at.patch), x + shift - m.radius * at.normal), wall.spin()};
        };
        points.clear();
        if (wall.stands()) {
            const Vec3 ahead = m.velocity + step.h * model.gravity;
            const double wall_speed = wall.moves() ? wall.fastest(Box{x, x}.shifted(shift).grown(m.radius)) : 0.0;
            const double reach = std::max(step.reach, closing_horizon * step.h * (ahead.norm() + wall_speed));
            find_wall_points(
                wall, network.patches.data() + pair.first, pair.patches, x + shift, m.radius + reach, points);
            std::erase_if(points, [&](const WallPoint& at) {
                return !within_reach(at.distance - m.radius, at.normal.dot(ahead - wall_row(at).velocity), step);
            });
        }
        match_carried(network, pair, points);
        for (std::size_t k = 0; k < points.size(); ++k) {
            const Vec3& n = points[k].normal;
            const double gap = points[k].distance - m.radius;
            const WallRow row = wall_row(points[k]);
            const double u_n = n.dot(m.velocity - row.velocity);
            assembly.add({.a = pair.sphere,
                             .b = pair.wall,
                             .normal = n,
                             .gap = gap,
                             .u_n = u_n,
                             .u_n_ahead = u_n + step.h * n.dot(model.gravity),
                             .arm_scale = 1.0,
                             .inverse_mass_sum = m.inverse_mass,
                             .rolling_radius = m.radius,
                             .inverse_inertia_sum = inverse_inertia(m),
                             .slot = pair.first + static_cast<std::uint32_t>(k),
                             .wall = row},
                model.materials.between(state.material[pair.sphere], wall.wall().material),
                n.dot(x) - gap + step.h * n.dot(row.velocity));
        }
    }
    assembly.finish(tile);
    return assembly.result();
}

/// Worst excess of the tangential impulse over the cone; carries the impulses of one tile's contacts of one kind.
double carry(const ContactArrays& arrays, std::size_t first, std::size_t count, CarriedImpulses& carried)
{
    double worst = 0.0;
    for (std::size_t k = first; k < first + count; ++k) {
        const auto& contact = arrays.contact[k];
        const auto& geometry = arrays.geometry[k];
        const bool keeps = geometry.kind != ContactKind::impact;
        const double normal_impulse = contact.impulse.dot(contact.normal);
        const double tangent_impulse = (contact.impulse - normal_impulse * contact.normal).norm();
        worst = std::max(worst, tangent_impulse - arrays.terms[k].friction * normal_impulse);
        carried.touched[geometry.slot] = geometry.gap <= 0.0 || normal_impulse > 0.0;
        carried.impulse[geometry.slot] = keeps ? contact.impulse : Vec3::Zero().eval();
        if (!arrays.rolling.empty())
            carried.rolling_impulse[geometry.slot] = keeps ? arrays.rolling[k].impulse : Vec3::Zero().eval();
    }
    return worst;
}

} // namespace

ContactSurvey& ContactSurvey::operator+=(const ContactSurvey& other)
{
    contacts += other.contacts;
    overlapping += other.overlapping;
    worst_overlap = std::max(worst_overlap, other.worst_overlap);
    overlap_sum += other.overlap_sum;
    contact_energy += other.contact_energy;
    return *this;
}

ContactSurvey assemble_contacts(
    ContactNetwork& network, const State& state, const Model& model, const std::vector<PlacedWall>& walls)
{
    const StepConstants step(model);
    const auto assemble_spheres =
        model.periodicity.any() ? assemble_sphere_contacts<true> : assemble_sphere_contacts<false>;
    const auto tiles = static_cast<std::int64_t>(network.tiles.count());
    std::vector<ContactSurvey> surveys(network.tiles.count());
#pragma omp parallel for schedule(dynamic) if (tiles > 16)
    for (std::int64_t t = 0; t < tiles; ++t) {
        const auto tile = static_cast<std::size_t>(t);
        surveys[tile] = assemble_spheres(network, tile, state, model, step);
        surveys[tile] += assemble_wall_contacts(network, tile, state, model, walls, step);
    }
    ContactSurvey all;
    for (const auto& survey : surveys) all += survey;
    return all;
}

ContactOutcome carry_impulses(ContactNetwork& network, State& state)
{
    const auto tiles = static_cast<std::int64_t>(network.tiles.count());
    std::vector<ContactOutcome> outcomes(network.tiles.count());
#pragma omp parallel for schedule(dynamic) if (tiles > 16)
    for (std::int64_t t = 0; t < tiles; ++t) {
        const auto tile = static_cast<std::size_t>(t);
        auto& outcome = outcomes[tile];
        const auto first = network.wall_slots_of_tile[tile];
        const auto& walls = network.wall_contacts;
        outcome.cone_violation = std::max(carry(network.sphere_contacts, network.pairs_of_tile[tile],
                                              network.sphere_contacts.count[tile], network.pair_carried),
            carry(walls, first, walls.count[tile], network.wall_carried));
        for (std::size_t k = first; k < first + walls.count[tile]; ++k) {
            outcome.wall_impulse += walls.contact[k].impulse;
            if (!walls.wall.empty()) outcome.wall_work += walls.contact[k].impulse.dot(walls.wall[k].velocity);
            if (!walls.wall.empty() && !walls.rolling.empty())
                outcome.wall_work += walls.rolling[k].impulse.dot(walls.wall[k].spin);
            if (!walls.contact[k].impulse.isZero(0.0)) state.last_wall[walls.contact[k].a] = walls.contact[k].b;
        }
    }
    ContactOutcome all;
    for (const auto& outcome : outcomes) {
        all.cone_violation = std::max(all.cone_violation, outcome.cone_violation);
        all.wall_impulse += outcome.wall_impulse;
        all.wall_work += outcome.wall_work;
    }
    return all;
}

} // namespace talus
