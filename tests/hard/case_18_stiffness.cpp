// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"

#include "tests/support/impact.hpp"
#include "tests/support/world.hpp"

#include <algorithm>
#include <cmath>
#include <string>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double d = 2 * standard_radius;
constexpr int height = 5; ///< spheres in the column

/// A column whose lowest contact has no overlap yet.
World column(const ContactLaw& law, Stabilisation stabilisation)
{
    World world = production_world(law, stabilisation);
    world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    for (int k = 0; k < height; ++k) world.add_sphere(Vec3(0, 0, (k + 0.5) * d));
    return world;
}

/// Worst error of the overlap in the column's contacts, the k-th of which bears `height` − k spheres [d].
double overlap_error(const World& world, double of_one)
{
    double worst = 0.0, below = 0.0;
    for (int k = 0; k < height; ++k) {
        const double gap = k == 0 ? world.position(0).z() - standard_radius : world.position(k).z() - below - d;
        worst = std::max(worst, std::abs(-gap - (height - k) * of_one) / d);
        below = world.position(k).z();
    }
    return worst;
}

} // namespace

TEST_CASE("18 very soft and very hard contacts", "[hard]")
{
    // Soft: k such that one sphere lies 10 % d deep in the floor at rest, and a column of five 50 %. The overlap is
    // load/k whatever the step, and nothing is boosted by the push-out. Hard: glass of that size has 1e6 N/m,
    // 1e12 must be as good as rigid. `matched` stops at what two sweeps can carry, so there it is so to the bit;
    // `projected` is rigid by itself and refuses a stiffness: that is the one to compare a rigid result with.
    HardCase hard("18 very soft and very hard contacts");
    World one = sphere_on_plane({.friction = 0.5}, production_settings(Stabilisation::matched), automatic_step());
    const double weight = one.mass() * standard_gravity;
    const double soft = weight / (0.1 * d);
    World column_soft = column({.friction = 0.5, .stiffness = soft}, Stabilisation::matched);
    double fastest = 0.0;
    const int steps = static_cast<int>(70.0 / column_soft.model.time_step);
    for (int k = 0; k < steps; ++k) {
        column_soft.step();
        fastest = std::max(fastest, column_soft.report.bodies.fastest_speed);
    }
    hard.below("soft: overlaps of the column, worst error [d]", overlap_error(column_soft, 0.1 * d), 1e-6);
    hard.below("soft: force on the floor, error",
        std::abs(
            column_soft.report.outcome.from_walls.impulse.z() / column_soft.model.time_step / (height * weight) - 1.0),
        1e-6);
    hard.below("soft: fastest speed [sqrt(2 g 5 d)]", fastest / std::sqrt(2 * standard_gravity * height * d), 1.0);

    World hardest = column({.friction = 0.5, .stiffness = 1e12}, Stabilisation::matched);
    World rigid = column({.friction = 0.5}, Stabilisation::matched);
    hardest.step(4000);
    rigid.step(4000);
    double difference = 0.0;
    for (int k = 0; k < height; ++k)
        difference = std::max(difference, (hardest.position(k) - rigid.position(k)).norm());
    hard.tell("hard, matched: difference from rigid, both as stiff as sweeps can carry [d]", difference / d);
    hard.tell("hard, matched: overlap of one sphere on the floor [d]", (standard_radius - [&] {
        one.step(4000);
        return one.position().z();
    }()) / d);

    World projected = column({.friction = 0.5}, Stabilisation::projected);
    projected.step(4000);
    hard.below("hard, projected: overlaps of the column, worst error [d]", overlap_error(projected, 0.0), 1e-6);
    hard.below("hard, projected: force on the floor, error",
        std::abs(projected.report.outcome.from_walls.impulse.z() / projected.model.time_step / (height * weight) - 1.0),
        1e-6);

    // Oblique impacts, sticking and slipping, against the rigid law in closed form.
    double impact_error = 0.0;
    for (const double tangential : {0.3, 1.0, 3.0})
        for (const double rim : {-1.0, 0.0, 2.0}) {
            SolverSettings solver = production_settings(Stabilisation::projected);
            solver.push_out_speed = automatic_push_out_speed();
            const ImpactVelocity before{1.0, tangential, rim};
            const auto expected = rigid_impact(before, 0.3, 0.5);
            const World after = impact_on_plane(before, 0.3, 0.5, standard_radius, solver);
            impact_error = std::max({impact_error, std::abs(-after.velocity().z() - expected.normal),
                std::abs(after.velocity().x() - expected.tangential),
                std::abs(after.state.body(0).rim_velocity.y() - expected.rim)});
        }
    hard.below("hard, projected: oblique impacts, worst error [m/s]", impact_error, 1e-6);
}
