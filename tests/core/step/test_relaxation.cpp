// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/region.hpp"
#include "core/step/relaxation.hpp"
#include "tests/support/world.hpp"

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double d = 2 * standard_radius, edge = 5 * d;

/// Spheres thrown about in a box, through each other and through its walls.
World thrown_about()
{
    World world = production_world();
    world.add_wall(box_panels({Vec3::Zero(), Vec3::Constant(edge)}, {}));
    Random random(3);
    for (int i = 0; i < 30; ++i)
        world.add_sphere(
            Vec3::Constant(0.3 * d) + (edge - 0.6 * d) * Vec3(uniform(random), uniform(random), uniform(random)));
    return world;
}

/// Of spheres with each other, and with the box [m].
double worst_overlap(const World& world)
{
    const auto& x = world.state.position;
    double worst = 0.0;
    for (std::size_t a = 0; a < x.size(); ++a) {
        worst = std::max({worst, standard_radius - x[a].minCoeff(), x[a].maxCoeff() - (edge - standard_radius)});
        for (std::size_t b = 0; b < a; ++b) worst = std::max(worst, d - (x[a] - x[b]).norm());
    }
    return worst;
}

} // namespace

TEST_CASE("overlap at the start is undone, and only positions change", "[relaxation]")
{
    World world = thrown_about();
    world.state.body(3).velocity = Vec3(1, 2, 3);
    const double before = worst_overlap(world);
    REQUIRE(before > 0.3 * d);
    CHECK(relax_overlaps(world.state, world.model, before) > 10);
    CHECK(worst_overlap(world) < 2e-6 * d);
    CHECK(world.state.body(3).velocity == Vec3(1, 2, 3));
    CHECK(world.state.steps == 0);
    CHECK(world.state.time == 0.0);
}

TEST_CASE("where there is no overlap nothing is moved", "[relaxation]")
{
    World world = production_world();
    world.add_sphere(Vec3(0, 0, d));
    CHECK(relax_overlaps(world.state, world.model, 0.0) == 0);
    CHECK(world.position() == Vec3(0, 0, d));
}
