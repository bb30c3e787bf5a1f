// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/step/time_step.hpp"

#include <catch2/catch.hpp>

using namespace talus;

namespace
{

/// A sphere of 10 mm above a plane, with this gap and speed downwards.
struct FallingSphere {
    Model model;
    State state;
    ContactNetwork network;

    FallingSphere(double restitution, double gap, double speed)
    {
        model.time_step = 1e-4;
        model.materials = {{{"grain", 2500.0}}, {{0.5, restitution, 0.0, infinity}}};
        model.physics = {.friction = true, .restitution = restitution > 0.0};
        model.min_diameter = model.max_diameter = model.mean_diameter = 0.01;
        model.world = Box{Vec3::Constant(-1), Vec3::Constant(1)};
        model.walls.push_back({"floor", Plane{}, 0});
        add_sphere(state, Vec3(0, 0, 0.005 + gap), 0.005, 2500.0, 0, Vec3(0, 0, -speed));
    }
};

} // namespace

TEST_CASE("an impact carries no impulse into the next step, and is no load", "[assembly]")
{
    FallingSphere s(0.5, 1e-5, 1.0);
    advance(s.state, s.network, s.model);
    REQUIRE(s.network.contacts.walls[0].kind(0) == ContactKind::impact);
    REQUIRE(s.network.contacts.walls[0].impulse(0).norm() > 0.0);
    CHECK(s.network.carried.walls.contact[0].impulse.norm() == 0.0);
    CHECK_FALSE(s.network.carried.walls.contact[0].touch.is_loaded());
}

TEST_CASE("a resting contact carries its whole impulse", "[assembly]")
{
    FallingSphere s(0.0, 0.0, 0.0);
    for (int k = 0; k < 200; ++k) advance(s.state, s.network, s.model);
    const double weight = s.state.mass(0) * 9.81 * s.model.time_step;
    CHECK(s.network.carried.walls.contact[0].impulse.z() == Approx(weight).epsilon(1e-3));
    CHECK(s.network.contacts.walls[0].impulse(0) == s.network.carried.walls.contact[0].impulse);
    CHECK(s.state.last_wall[0] == 0);
}

TEST_CASE("a wall is a contact only while it stands", "[assembly]")
{
    FallingSphere s(0.0, 0.0, 0.0);
    s.model.walls[0].remove_at = 0.01;
    while (s.state.time < 0.0095) CHECK(advance(s.state, s.network, s.model).contacts.count == 1);
    for (int k = 0; k < 10; ++k) advance(s.state, s.network, s.model);
    CHECK(advance(s.state, s.network, s.model).contacts.count == 0);
    CHECK(s.state.body(0).velocity.z() < 0.0);
}
