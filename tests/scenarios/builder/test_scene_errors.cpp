// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/scenarios/builder/mistakes.hpp"

using namespace talus;
using namespace talus::test;

namespace
{

const std::vector<Mistake> of_materials = {
    {[](S& s) { s.fill[0].material = "steel"; }, "fill[0].material", "unknown material 'steel'; the scene has glass"},
    {[](S& s) {
         s.materials.push_back({"steel", 7800.0});
         s.wall[0].material = "stel";
     },
        "wall[0].material", "unknown material 'stel'; the scene has glass, steel"},
    {[](S& s) {
         s.contact.clear();
         s.materials.clear();
     },
        "fill[0].material", "unknown material 'glass'; the scene has none"},
    {[](S& s) { s.contact[0].between = {"glass"}; }, "contact[0].between", "'between' names two materials, here are 1"},
    {[](S& s) { s.contact.push_back(s.contact[0]); }, "contact[1].between",
        "the contact of glass and glass is given twice"},
    {[](S& s) {
         s.solver.stabilisation = "projected";
         s.contact[0].stiffness = 1e6;
     },
        "contact[0].stiffness",
        "a stiffness goes with stabilisation \"matched\" only; with \"projected\" contacts are rigid"},
    {[](S& s) {
         s.solver.stabilisation = "projected";
         s.materials[0].young_modulus = 1e7;
     },
        "materials.glass.young_modulus",
        "a modulus goes with stabilisation \"matched\" only; with \"projected\" contacts are rigid"},
    {[](S& s) {
         s.materials.push_back({"steel", 7800.0});
         s.wall[0].material = "steel";
     },
        "contact", "no [[contact]] between glass and steel, which can touch"},
    {[](S& s) {
         s.contact[0].cohesion = {.law = "bond_number", .bond_number = 2.0};
         s.world.gravity = Vec3::Zero();
         s.time.step = {1e-4, ""};
     },
        "contact[0].cohesion.bond_number", "a Bond number is a multiple of a weight, and there is no gravity"},
    {[](S& s) { s.contact[0].cohesion = {.law = "constant", .force = 1.0, .range = 0.1}; }, "contact[0].cohesion.range",
        "two would attract each other over a gap of more than half the smallest diameter, which is the most"},
    {[](S& s) { s.contact[0].cohesion = {.law = "liquid", .surface_tension = 0.07, .volume = 1e-3}; },
        "contact[0].cohesion.volume",
        "two would attract each other over a gap of more than half the smallest diameter, which is the most"},
};

const std::string too_far = "it reaches more than 1e9 diameters from the origin, where numbers are too coarse for "
                            "contacts; bring the scene nearer";
const scene::RegionTable far_away = box_region(Vec3(0, 0, -2e7), Vec3(1, 1, 1));

const std::vector<Mistake> of_distances = {
    {[](S& s) { s.wall[0].max.x() = 2e7; }, "wall[0].name", too_far},
    {[](S& s) { s.fill[0].region = far_away; }, "fill[0].region", too_far},
    {[](S& s) {
         s.pour.push_back(small_pour());
         s.pour[0].region = far_away;
     },
        "pour[0].region", too_far},
    {[](S& s) {
         s.outlet = {{"below", far_away}};
     },
        "outlet[0].region", too_far},
};

/// Adds sensor[0] of a kind with the fill's region, with what `set` sets.
std::function<void(S&)> add_sensor(const std::string& kind, std::function<void(scene::SensorTable&)> set)
{
    return [=](S& s) {
        auto& table = s.sensor.emplace_back(sensor("a", kind));
        static_cast<scene::RegionTable&>(table.region) = s.fill[0].region;
        table.direction = "z";
        set(table);
    };
}

const std::vector<Mistake> of_sensors = {
    {add_sensor("region", [](auto& t) { t.region = {}; }), "sensor[0].region.max",
        "the box is empty: every coordinate of 'min' must be below that of 'max'"},
    {add_sensor("region", [](auto& t) { t.from = t.to = 1.0; }), "sensor[0].to", "'to' must be later than 'from'"},
    {add_sensor("profile", [](auto& t) { t.from = t.to = 1.0; }), "sensor[0].to", "'to' must be later than 'from'"},
    {add_sensor("profile", [](auto& t) { t.direction = "radial"; }), "sensor[0].direction",
        "a box is cut along 'x', 'y' or 'z', a cylinder 'axial' or 'radial'"},
    {add_sensor("profile",
         [](auto& t) {
             t.region.shape = "cylinder";
             t.region.radius = t.region.height = 0.1;
         }),
        "sensor[0].direction", "a box is cut along 'x', 'y' or 'z', a cylinder 'axial' or 'radial'"},
    {add_sensor("profile", [](auto& t) { t.name = "a/b"; }), "sensor[0].name",
        "the name of a profile is part of a file's name: use letters, digits, '_' and '-' only, one at least"},
    {add_sensor("profile", [](auto& t) { t.name = ""; }), "sensor[0].name",
        "the name of a profile is part of a file's name: use letters, digits, '_' and '-' only, one at least"},
    {add_sensor("region", [](auto& t) { t.name = "a.b"; }), "sensor[0].name",
        "the name 'a.b' has a '.', with which --set could not name it"},
    {add_sensor("profile", [](auto& t) { t.name = std::string(201, 'a'); }), "sensor[0].name",
        "the name of a profile is part of a file's name: at most 200 characters"},
    {add_sensor("wall_force", [](auto& t) { t.wall = "flor"; }), "sensor[0].wall",
        "unknown wall 'flor'; the scene has box"},
    {[](S& s) {
         add_sensor("wall_force", [](auto&) {})(s);
         s.wall.clear();
     },
        "sensor[0].wall", "unknown wall ''; the scene has none"},
    {add_sensor("wall_force",
         [](auto& t) {
             t.wall = "box";
             t.from = t.to = 1.0;
         }),
        "sensor[0].to", "'to' must be later than 'from'"},
    {[](S& s) { s.output.region.shape = "box"; }, "output.region.max",
        "the box is empty: every coordinate of 'min' must be below that of 'max'"},
};

const std::vector<Mistake> of_the_rest = {
    {[](S& s) {
         s.world.periodic = {"x", "x"};
     },
        "world.periodic", "the axis x is there twice"},
    {[](S& s) { s.wall[0].name = "a.b"; }, "wall[0].name",
        "the name 'a.b' has a '.', with which --set could not name it"},
    {[](S& s) { s.materials[0].name = "b.c"; }, "materials.b.c",
        "the name 'b.c' has a '.', with which --set could not name it"},
    {[](S& s) { s.world.max = s.world.min = Vec3::Zero(); }, "world.max",
        "the world is empty: every coordinate of 'min' must be below that of 'max'"},
    {[](S& s) { s.solver.max_sweeps = 1; }, "solver.max_sweeps", "'max_sweeps' must be at least the 2 of 'min_sweeps'"},
    {[](S& s) {
         s.solver.pressure_scaling = {true, ""};
     },
        "solver.pressure_scaling",
        "pressure scaling goes with stabilisation \"projected\" only; with \"matched\" contacts are too soft for it to "
        "matter"},
    {[](S& s) {
         s.solver.stabilisation = "projected";
         s.solver.pressure_scaling = {true, ""};
         s.world.periodic = {"x"};
         s.world.min = Vec3::Zero();
         s.world.max = Vec3::Ones();
     },
        "solver.pressure_scaling",
        "pressure scaling is not for periodic axes, where beads may be shot out of a bed by the pressure on its own "
        "images; leave it out, or write false"},
    {[](S& s) { s.world.gravity.setZero(); }, "time.step",
        "without gravity and speeds there is no automatic step: give one in seconds"},
    {[](S& s) {
         s.outlet = {{"out", {}}};
     },
        "outlet[0].region.max", "the box is empty: every coordinate of 'min' must be below that of 'max'"},
    {[](S& s) {
         s.outlet = {{"out", s.fill[0].region}, {"out", s.fill[0].region}};
     },
        "outlet[1].name", "two outlets are called 'out'"},
    {[](S& s) {
         s.sensor = {sensor("a", "mass_flow"), sensor("a", "repose")};
     },
        "sensor[1].name", "two sensors are called 'a'"},
    {[](S& s) {
         s.sensor = {sensor("a", "mass_flow")};
         s.sensor[0].from = s.sensor[0].to = 1.0;
     },
        "sensor[0].to", "'to' must be later than 'from'"},
    {[](S& s) {
         s.sensor = {sensor("a", "mass_flow")};
         s.sensor[0].normal.setZero();
     },
        "sensor[0].normal", "a direction must not be zero"},
    {[](S& s) {
         s.sensor = {sensor("a", "repose")};
         s.sensor[0].inner_radius = s.sensor[0].outer_radius = 0.1;
     },
        "sensor[0].outer_radius", "'outer_radius' must be above 'inner_radius'"},
    {[](S& s) {
         s.sensor = {sensor("a", "repose")};
         s.world.gravity.setZero();
         s.time.step = {1e-4, ""};
     },
        "sensor[0].kind", "an angle of repose needs gravity"},
};

} // namespace

TEST_CASE("a mistake in the rest of a scene is reported, with its key and the reason", "[scenes][errors]")
{
    SECTION("materials and their contacts")
    {
        check_all(of_materials);
    }
    SECTION("distances")
    {
        check_all(of_distances);
    }
    SECTION("sensors and output")
    {
        check_all(of_sensors);
    }
    SECTION("world, solver, outlets and sensors")
    {
        check_all(of_the_rest);
    }
}

TEST_CASE("of several mistakes the first in the order of the scene is reported", "[scenes][errors]")
{
    const std::vector<std::pair<std::string, std::function<void(S&)>>> mistakes = {
        {"solver.max_sweeps", [](S& s) { s.solver.max_sweeps = 1; }},
        {"output.region.max", [](S& s) { s.output.region.shape = "box"; }},
        {"contact[0].between", [](S& s) { s.contact[0].between = {"glass"}; }},
        {"fill[0].diameter.value", [](S& s) { s.fill[0].diameter.value = 0.0; }},
        {"pour[0].count", [](S& s) { s.pour.emplace_back(small_pour()).count = 0; }},
        {"wall[0].max", [](S& s) { s.wall[0].max.y() = 0.0; }},
        {"outlet[0].region.max", [](S& s) { s.outlet.emplace_back(); }},
        {"sensor[0].wall", [](S& s) { s.sensor = {sensor("a", "wall_force")}; }},
    };
    for (std::size_t first = 0; first < mistakes.size(); ++first) {
        auto scene = small_scene();
        for (std::size_t k = first; k < mistakes.size(); ++k) mistakes[k].second(scene);
        CHECK(refusal_of(scene).first == mistakes[first].first);
    }
}

TEST_CASE("tables whose name is left out do not collide", "[scenes]")
{
    auto scene = small_scene();
    scene.pour = {small_pour(), small_pour()};
    scene.outlet = {{"", scene.fill[0].region}, {"", scene.fill[0].region}};
    const auto simulation = build_scene(scene).simulation;
    CHECK(simulation.pours.size() == 2);
    CHECK(simulation.pours[0].name != simulation.pours[1].name);
    CHECK(simulation.model.outlets.size() == 2);
}
