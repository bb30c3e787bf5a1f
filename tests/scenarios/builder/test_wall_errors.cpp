// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/scenarios/builder/mistakes.hpp"

using namespace talus;
using namespace talus::test;

namespace
{

scene::WallTable wall(const std::string& shape)
{
    scene::WallTable wall;
    wall.name = "other";
    wall.shape = shape;
    wall.material = "glass";
    return wall;
}

/// Adds wall[1], a shape with nothing set but what `set` sets.
std::function<void(S&)> add_wall(const std::string& shape, std::function<void(scene::WallTable&)> set)
{
    return [=](S& s) { set(s.wall.emplace_back(wall(shape))); };
}

const std::vector<Mistake> of_walls = {
    {[](S& s) { s.wall[0].max.y() = 0.0; }, "wall[0].max",
        "the box is empty: every coordinate of 'min' must be below that of 'max'"},
    {add_wall("plane", [](auto& w) { w.normal.setZero(); }), "wall[1].normal", "a direction must not be zero"},
    {add_wall("disk", [](auto&) {}), "wall[1].radius", "the radius of a disk must be given, and greater than 0"},
    {add_wall("disk", [](auto& w) { w.radius = w.hole_radius = 0.1; }), "wall[1].hole_radius",
        "the hole must be smaller than the disk"},
    {add_wall("mesh", [](auto&) {}), "wall[1].mesh", "a wall of shape \"mesh\" needs an STL file with triangles"},
    {add_wall("cylinder", [](auto& w) { w.radius = 0.1; }), "wall[1].height",
        "the height of a cylinder must be given, and greater than 0"},
    {add_wall("cylinder", [](auto& w) { w.height = 0.1; }), "wall[1].radius",
        "the radius of a cylinder must be given, and greater than 0"},
    {add_wall("cylinder",
         [](auto& w) {
             w.height = 0.1;
             w.axis.setZero();
         }),
        "wall[1].axis", "a direction must not be zero"},
    {add_wall("cone", [](auto& w) { w.top_radius = 0.1; }), "wall[1].height",
        "the height of a cone must be given, and greater than 0"},
    {add_wall("cone", [](auto& w) { w.height = 0.1; }), "wall[1].base_radius",
        "one of the radii of a cone must be given, and greater than 0"},
    {[](S& s) { s.wall.push_back(s.wall[0]); }, "wall[1].name", "two walls are called 'box'"},
};

/// Gives wall[0] a motion of one kind with what `set` sets.
std::function<void(S&)> add_motion(const std::string& kind, std::function<void(scene::MotionTable&)> set)
{
    return [=](S& s) {
        auto& motion = s.wall[0].motion.emplace_back();
        motion.kind = kind;
        set(motion);
    };
}

/// Makes the world of the small scene repeat itself along these axes.
std::function<void(S&)> repeat(
    std::vector<std::string> axes, std::function<void(S&)> set = [](S&) {})
{
    return [=](S& s) {
        s.world.min = Vec3(0, 0, -1);
        s.world.max = Vec3(0.05, 0.05, 1);
        s.world.periodic = axes;
        set(s);
    };
}

/// Gives wall[0] a mass and a guide, then what `set` sets.
std::function<void(S&)> give_mass(std::function<void(scene::WallTable&)> set)
{
    return [=](S& s) {
        s.wall[0].mass = 1.0;
        s.wall[0].guide = Vec3::UnitZ();
        set(s.wall[0]);
    };
}

const std::vector<Mistake> of_masses = {
    {give_mass([](auto& w) { w.guide.setZero(); }), "wall[0].guide",
        "a wall of finite mass needs a 'guide', the axis along which it moves"},
    {give_mass([](auto& w) { w.motion.emplace_back().kind = "translate"; }), "wall[0].mass",
        "a wall moves as prescribed or as forces have it: leave out 'mass' or the motion"},
    {give_mass([](auto& w) { w.remove_at = 1.0; }), "wall[0].mass",
        "a wall of finite mass is there for the whole run: leave out 'appear_at' and 'remove_at'"},
    {give_mass([](auto& w) { w.appear_at = 1.0; }), "wall[0].mass",
        "a wall of finite mass is there for the whole run: leave out 'appear_at' and 'remove_at'"},
    {give_mass([](auto& w) {
         w.load = {{1.0, 2.0}, {1.0, 3.0}};
     }),
        "wall[0].load", "the times of 'load' must rise from row to row"},
    {give_mass([](auto& w) { w.mass = infinity; }), "wall[0].guide", "'guide' goes with a finite 'mass'"},
    {[](S& s) {
         s.wall[0].load = {{0.0, 1.0}};
     },
        "wall[0].load", "'load' goes with a finite 'mass'"},
    {[](S& s) { s.wall[0].released_at = 1.0; }, "wall[0].released_at", "'released_at' goes with a finite 'mass'"},
    {repeat({"x"}, give_mass([](auto& w) { w.guide = Vec3(0.1, 0, 1); })), "wall[0].guide",
        "a guide must not lead along a periodic axis"},
    {[](S& s) {
         s.sensor = {sensor("a", "wall_position")};
         s.sensor[0].wall = "box";
     },
        "sensor[0].wall", "the wall 'box' has no finite mass: it moves as prescribed"},
};

const std::vector<Mistake> of_motions = {
    {add_motion("turn",
         [](auto& m) {
             m.rate = 1.0;
             m.axis.setZero();
         }),
        "wall[0].motion[0].axis", "a direction must not be zero"},
    {add_motion("translate",
         [](auto& m) {
             m.from = 2.0;
             m.to = 1.0;
         }),
        "wall[0].motion[0].to", "'to' must not be before 'from'"},
    {[](S& s) {
         add_motion("translate", [](auto&) {})(s);
         add_motion("table", [](auto&) {})(s);
     },
        "wall[0].motion[1].table", "'table' needs at least one row [time, x, y, z]"},
    {add_motion("table",
         [](auto& m) {
             m.table = {{0.0, Vec3::Zero()}, {0.5, Vec3::UnitX()}, {0.5, Vec3::Zero()}};
         }),
        "wall[0].motion[0].table", "the times of 'table' must rise from row to row"},
    {add_wall("grains",
         [](auto& w) {
             w.diameter = 0.01;
             w.max.x() = -0.1;
         }),
        "wall[1].max", "no coordinate of 'min' may be above that of 'max'"},
    {[](S& s) {
         s.world.rotation = false;
         s.contact[0].rolling_friction = 0.1;
     },
        "world.rotation",
        "spheres that do not turn have no rolling and twisting resistance: leave out 'rolling_friction' and "
        "'twisting_friction', or let them turn"},
    {repeat({"x"}, [](S& s) { s.world.max.x() = infinity; }), "world.periodic",
        "along the periodic axis x 'min' and 'max' must be given"},
    {repeat({"y"}, [](S& s) { s.world.max.y() = 0.0219; }), "world.periodic",
        "along the periodic axis y the world must be at least 2.2 diameters of the largest sphere"},
    {repeat({"x"}, add_wall("plane", [](auto& w) { w.normal = Vec3(0.1, 0, 1); })), "wall[1].normal",
        "a plane across a periodic axis would cut every image; use another shape"},
    {repeat({"x"}, add_wall("plane",
                       [](auto& w) {
                           auto& motion = w.motion.emplace_back();
                           motion.kind = "turn";
                           motion.axis = Vec3::UnitY();
                           motion.rate = 1.0;
                       })),
        "wall[1].motion[0].axis",
        "a plane that turns about this axis would come to cut every image; use another shape"},
    {repeat({"x"},
         [](S& s) {
             s.sensor = {sensor("a", "mass_flow")};
             s.sensor[0].normal = Vec3(1, 0, 1);
         }),
        "sensor[0].normal", "a plane must lie along a periodic axis or straight across it"},
    {[](S& s) {
         s.sensor = {sensor("a", "slope")};
         s.sensor[0].along.setZero();
     },
        "sensor[0].along", "a direction must not be zero"},
};

} // namespace

TEST_CASE("a mistake in walls and how they move is reported, with its key and the reason", "[scenes][errors]")
{
    SECTION("walls")
    {
        check_all(of_walls);
    }
    SECTION("motions, periodic axes, rotation, grains and slopes")
    {
        check_all(of_motions);
    }
    SECTION("walls of finite mass")
    {
        check_all(of_masses);
    }
}

TEST_CASE("of two tables with one name both are reported", "[scenes][errors]")
{
    auto scene = small_scene();
    scene.wall.push_back(wall("plane"));
    scene.wall.push_back(wall("plane"));
    try {
        build_scene(scene);
        FAIL("built");
    } catch (const SceneError& error) {
        CHECK(error.key == "wall[2].name");
        CHECK(error.first_key == "wall[1].name");
    }
}
