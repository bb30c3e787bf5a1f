// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/step/time_step.hpp"

#include <catch2/catch.hpp>

#include <limits>

using namespace talus;

namespace
{

/// Three spheres far apart in a world of one metre, without gravity.
struct ThreeSpheres {
    Model model;
    State state;
    ContactNetwork network;

    ThreeSpheres()
    {
        model.gravity.setZero();
        model.time_step = 1e-3;
        model.materials = {{{"grain", 2500.0}}, {ContactLaw{}}};
        model.min_diameter = model.max_diameter = model.mean_diameter = 0.01;
        model.world = Box{Vec3::Constant(-1), Vec3::Constant(1)};
        model.speed_limit = 50.0;
        for (int i = 0; i < 3; ++i) add_sphere(state, Vec3(0.3 * i, 0, 0), 0.005, 2500.0, 0);
    }

    std::vector<Incident> step() { return advance(state, network, model).bodies.incidents; }
};

} // namespace

TEST_CASE("a healthy step has no incident", "[diagnostics]")
{
    CHECK(ThreeSpheres().step().empty());
}

TEST_CASE("a velocity that is not a number is reported in the step in which it shows", "[diagnostics]")
{
    ThreeSpheres s;
    s.step();
    s.state.body(1).rim_velocity.x() = std::numeric_limits<double>::quiet_NaN();
    const auto incidents = s.step();
    REQUIRE(incidents.size() == 1);
    CHECK(incidents[0].kind == Incident::Kind::not_a_number);
    CHECK(incidents[0].id == s.state.id[1]);
}

TEST_CASE("a sphere faster than the scene can make it is a blow-up", "[diagnostics]")
{
    ThreeSpheres s;
    s.step();
    s.state.body(2).velocity.y() = 50.1;
    const auto incidents = s.step();
    REQUIRE(incidents.size() == 1);
    CHECK(incidents[0].kind == Incident::Kind::blow_up);
    CHECK(incidents[0].id == s.state.id[2]);
    CHECK(incidents[0].speed == Approx(50.1));
}

TEST_CASE("a sphere that leaves the world has escaped, unless it went through an outlet", "[diagnostics]")
{
    ThreeSpheres s;
    s.state.body(0).velocity.z() = -20.0;
    const bool with_outlet = GENERATE(false, true);
    if (with_outlet) {
        Region outlet;
        outlet.box = {Vec3(-0.1, -0.1, -0.9), Vec3(0.1, 0.1, -0.8)};
        s.model.outlets.push_back(outlet);
    }
    std::vector<Incident> incidents;
    for (int k = 0; k < 60 && incidents.empty(); ++k) incidents = s.step();
    REQUIRE(incidents.empty() == with_outlet);
    if (with_outlet) return;
    CHECK(incidents[0].kind == Incident::Kind::escaped);
    CHECK(incidents[0].position.z() < -1.0);
    CHECK(incidents[0].position.z() > -1.0 - 20.0 * s.model.time_step * 1.01); // in the very step
    CHECK(incidents[0].last_wall == -1);
}
