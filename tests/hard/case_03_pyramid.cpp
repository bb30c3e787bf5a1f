// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"

#include "tests/support/pyramid.hpp"

#include <string>

using namespace talus;
using namespace talus::test;

namespace
{

/// How far the top has sunk after three seconds [d].
double sinking(int base_spheres, bool at_floor, double share)
{
    const double above = at_floor ? ample_friction : share * critical_friction_above(base_spheres);
    const double floor = at_floor ? share * critical_friction_at_floor(base_spheres) : ample_friction;
    SolverSettings solver = production_settings(Stabilisation::matched);
    solver.push_out_speed = automatic_push_out_speed();
    World world = pyramid(base_spheres, above, floor, solver);
    const double top = world.position(base_spheres).z();
    world.step(static_cast<int>(3.0 / world.model.time_step));
    return (top - world.position(base_spheres).z()) / (2 * standard_radius);
}

} // namespace

TEST_CASE("3 pyramids of three and four spheres at their critical friction", "[hard][quick]")
{
    // With 1.01 of the friction that statics asks for a pyramid stands, with 0.99 it falls. A sweep that stops early,
    // a friction disk of the old normal impulse or a contact that creeps shift that limit: what takes friction for a
    // box or a convex cone is wrong by far more than one per cent.
    HardCase hard("3 pyramids of three and four spheres at their critical friction");
    for (const int base_spheres : {2, 3})
        for (const bool at_floor : {false, true}) {
            const std::string which =
                std::to_string(base_spheres + 1) + " spheres, at the " + (at_floor ? "floor" : "top");
            hard.below(which + ": sinking at 1.01 mu_c in 3 s [d]", sinking(base_spheres, at_floor, 1.01), 0.001);
            hard.above(which + ": sinking at 0.99 mu_c in 3 s [d]", sinking(base_spheres, at_floor, 0.99), 0.3);
        }
}
