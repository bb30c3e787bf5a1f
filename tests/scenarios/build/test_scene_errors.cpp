// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/build/build_scene.hpp"
#include "tests/scenarios/small_scene.hpp"

#include <catch2/catch.hpp>

#include <functional>

using namespace talus;
using namespace talus::test;

namespace
{

/// A way to spoil the small scene, and what is said of it.
struct Mistake {
    std::function<void(scene::Scene&)> make;
    std::string key, sentence;
};

using S = scene::Scene;

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
         s.materials.push_back({"steel", 7800.0});
         s.wall[0].material = "steel";
     },
        "contact", "no [[contact]] between glass and steel, which can touch"},
};

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
        "a wall moves as told or as forces have it: leave out 'mass' or the motion"},
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
        "sensor[0].wall", "the wall 'box' has no finite mass: it is where it is told"},
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
        "spheres that do not turn have no rolling resistance: leave out 'rolling_friction', or let them turn"},
    {repeat({"x"}, [](S& s) { s.world.max.x() = infinity; }), "world.periodic",
        "along the periodic axis x 'min' and 'max' must be given"},
    {repeat({"y"}, [](S& s) { s.world.max.y() = 0.0399; }), "world.periodic",
        "along the periodic axis y the world must be at least four diameters of the largest sphere"},
    {repeat({"x", "y", "z"}), "world.periodic", "two axes may be periodic, not all three"},
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

const std::vector<Mistake> of_spheres = {
    {[](S& s) { s.fill[0].count = 0; }, "fill",
        "the scene has no spheres: give a [[fill]] or a [[pour]] with a count above 0"},
    {[](S& s) { s.fill[0].diameter.value = 0.0; }, "fill[0].diameter.value",
        "the diameter must be given, and greater than 0"},
    {[](S& s) { s.fill[0].diameter.distribution = "uniform"; }, "fill[0].diameter.min",
        "the smallest diameter must be given, and greater than 0"},
    {[](S& s) { s.fill[0].diameter = {.distribution = "uniform", .min = 0.02, .max = 0.01}; }, "fill[0].diameter.max",
        "the largest diameter must not be below the smallest"},
    {[](S& s) { s.fill[0].region.max.x() = 0.0; }, "fill[0].region.max",
        "the box is empty: every coordinate of 'min' must be below that of 'max'"},
    {[](S& s) { s.fill[0].region.shape = "cylinder"; }, "fill[0].region.radius",
        "the radius of a cylinder must be given, and greater than 0"},
    {[](S& s) { s.fill[0].region.max.x() = 0.009; }, "fill[0].region", "the region is smaller than one sphere"},
    {[](S& s) {
         // Lattice points 20 mm apart: one layer of two by two between the walls, at most five of them high.
         s.fill[0].spacing = 2.0;
         s.fill[0].region.max = Vec3(0.019, 0.019, 0.019);
     },
        "fill[0].region",
        "the region holds 1 spheres of this size clear of walls and earlier fills, not 20; make it larger, or lower "
        "'count' or "
        "'spacing'"},
    {[](S& s) {
         s.fill[0].arrangement = "random";
         s.fill[0].region.max = Vec3(0.0101, 0.0101, 0.0101);
     },
        "fill[0].region",
        "the region holds 1 spheres of this size clear of walls and earlier fills, not 20; make it larger, lower "
        "'count', or use "
        "arrangement \"lattice\""},
    {[](S& s) {
         s.fill[0].count = 1;
         s.fill[0].spacing = 1.0;
         s.fill[0].region.max = Vec3(0.0101, 0.0101, 0.0101);
         s.fill.push_back(s.fill[0]);
     },
        "fill[1].region",
        "the region holds 0 spheres of this size clear of walls and earlier fills, not 1; make it larger, or lower "
        "'count' or 'spacing'"},
    {[](S& s) { s.fill[0].region.max.x() = 1100.0; }, "fill[0].region",
        "the region is more than 100 000 spheres across"},
    {[](S& s) { s.world.max.x() = 0.04; }, "fill[0].region",
        "the region reaches out of the world; see [world] min and max"},
    {[](S& s) {
         s.pour.push_back(small_pour());
         s.world.min.z() = -0.1;
         s.world.max.z() = 0.17;
     },
        "pour[0].region", "the region reaches out of the world; see [world] min and max"},
    {[](S& s) {
         s.pour.push_back(small_pour());
         s.pour[0].region.max.z() = 0.155;
     },
        "pour[0].region", "the region is smaller than one sphere"},
    {[](S& s) {
         s.pour = {small_pour(), small_pour()};
         s.pour[0].name = s.pour[1].name = "rain";
     },
        "pour[1].name", "two pours are called 'rain'"},
};

/// Adds sensor[0] of a kind with the fill's region, with what `set` sets.
std::function<void(S&)> add_sensor(const std::string& kind, std::function<void(scene::SensorTable&)> set)
{
    return [=](S& s) {
        auto& table = s.sensor.emplace_back(sensor("a", kind));
        table.region = s.fill[0].region;
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
    {add_sensor("profile", [](auto& t) { t.name = "../a"; }), "sensor[0].name",
        "the name of a profile is part of a file's name: use letters, digits, '.', '_' and '-' only"},
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
    {[](S& s) { s.world.max = s.world.min = Vec3::Zero(); }, "world.max",
        "the world is empty: every coordinate of 'min' must be below that of 'max'"},
    {[](S& s) { s.solver.max_sweeps = 1; }, "solver.max_sweeps", "'max_sweeps' must be at least the 2 of 'min_sweeps'"},
    {[](S& s) {
         s.solver.pressure_scaling = {true, ""};
     },
        "solver.pressure_scaling",
        "pressure scaling goes with stabilisation \"projected\" only; with \"matched\" contacts are too soft for it to "
        "matter"},
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

/// A species of 10 mm beads.
scene::SpeciesTable species(const std::string& material, double share)
{
    scene::SpeciesTable table;
    table.material = material;
    table.diameter.value = 0.01;
    table.share = share;
    return table;
}

/// Makes fill[0] that of a file with two spheres clear of all.
void list_spheres(S& s)
{
    s.fill[0].arrangement = "file";
    s.fill[0].count = 0;
    s.fill[0].diameter = {};
    s.fill[0].spheres.positions = {Vec3(0.01, 0.01, 0.01), Vec3(0.03, 0.01, 0.01)};
    s.fill[0].spheres.radii = {0.005, 0.005};
}

scene::DiameterTable cut(const std::string& distribution, double middle, double deviation, double min, double max)
{
    scene::DiameterTable table;
    table.distribution = distribution;
    table.mean = table.median = middle;
    table.deviation = deviation;
    table.min = min;
    table.max = max;
    return table;
}

const std::vector<Mistake> of_insertion = {
    {[](S& s) { s.fill[0].diameter = cut("normal", 0.01, 0.001, 0.0, 0.02); }, "fill[0].diameter.min",
        "the smallest diameter must be given, and greater than 0"},
    {[](S& s) { s.fill[0].diameter = cut("normal", 0.01, 0.001, 0.02, 0.01); }, "fill[0].diameter.max",
        "the largest diameter must not be below the smallest"},
    {[](S& s) { s.fill[0].diameter = cut("lognormal", 0.01, 0.1, 0.01, 0.01); }, "fill[0].diameter.max",
        "'max' must be above 'min'; for one size use distribution \"constant\""},
    {[](S& s) { s.fill[0].diameter = cut("normal", 0.01, 0.0, 0.005, 0.02); }, "fill[0].diameter.deviation",
        "the standard deviation must be given, and greater than 0"},
    {[](S& s) { s.fill[0].diameter = cut("normal", 0.0, 0.001, 0.005, 0.02); }, "fill[0].diameter.mean",
        "the mean diameter must be given, and greater than 0"},
    {[](S& s) { s.fill[0].diameter = cut("lognormal", 0.0, 0.1, 0.005, 0.02); }, "fill[0].diameter.median",
        "the median diameter must be given, and greater than 0"},
    {[](S& s) { s.fill[0].diameter = cut("normal", 0.01, 0.001, 0.013, 0.02); }, "fill[0].diameter.min",
        "less than 1 % of the normal distribution lies between 'min' and 'max'; widen them"},
    {[](S& s) { s.fill[0].diameter = cut("lognormal", 0.01, 0.1, 0.002, 0.005); }, "fill[0].diameter.min",
        "less than 1 % of the lognormal distribution lies between 'min' and 'max'; widen them"},
    {[](S& s) { s.fill[0].diameter.distribution = "sieve"; }, "fill[0].diameter.file",
        "a distribution \"sieve\" needs a file with two sieves at least"},
    {[](S& s) { s.fill[0].material.clear(); }, "fill[0].material",
        "give a 'material' and a 'diameter', or a list of 'species'"},
    {[](S& s) { s.fill[0].species = {species("glass", 1.0)}; }, "fill[0].species",
        "where there are 'species', each has its own 'material' and 'diameter': leave out the others"},
    {[](S& s) {
         s.pour.push_back(small_pour());
         s.pour[0].material.clear();
         s.pour[0].species = {species("glass", 1.0)};
     },
        "pour[0].species",
        "where there are 'species', each has its own 'material' and 'diameter': leave out the others"},
    {[](S& s) {
         s.fill[0].material.clear();
         s.fill[0].diameter = {};
         s.fill[0].species = {species("glass", 1.0), species("wood", 1.0)};
     },
        "fill[0].species[1].material", "unknown material 'wood'; the scene has glass"},
    {[](S& s) {
         s.fill[0].material.clear();
         s.fill[0].diameter = {};
         s.fill[0].species = {species("glass", 1.0), species("glass", 1.0)};
         s.fill[0].species[1].diameter.value = 0.0;
     },
        "fill[0].species[1].diameter.value", "the diameter must be given, and greater than 0"},
    {[](S& s) {
         s.fill[0].material.clear();
         s.fill[0].diameter = {};
         s.fill[0].species = {species("glass", 0.0)};
     },
        "fill[0].species[0].share", "the share must be given, and greater than 0"},
    {[](S& s) {
         s.materials.push_back({"steel", 7800.0});
         s.fill[0].material.clear();
         s.fill[0].diameter = {};
         s.fill[0].species = {species("glass", 1.0), species("steel", 1.0)};
     },
        "contact", "no [[contact]] between glass and steel, which can touch"},
    {[](S& s) {
         list_spheres(s);
         s.fill[0].spheres = {};
     },
        "fill[0].file", "the fill needs a file with spheres"},
    {[](S& s) {
         list_spheres(s);
         s.fill[0].count = 3;
     },
        "fill[0].count", "the file has 2 spheres, not 3; leave 'count' out to take them all"},
    {[](S& s) {
         list_spheres(s);
         s.fill[0].diameter.value = 0.01;
     },
        "fill[0].diameter", "the file has the radii of its spheres: leave 'diameter' out"},
    {[](S& s) {
         list_spheres(s);
         s.fill[0].spheres.radii.clear();
     },
        "fill[0].diameter", "the file has no radius or diameter: give 'diameter' as a number"},
    {[](S& s) {
         list_spheres(s);
         s.fill[0].material = "wood";
     },
        "fill[0].material", "unknown material 'wood'; the scene has glass"},
    {[](S& s) {
         list_spheres(s);
         s.fill[0].material.clear();
     },
        "fill[0].material", "give the 'material' of the file's spheres"},
    {[](S& s) {
         list_spheres(s);
         s.world.max.x() = 0.02;
     },
        "fill[0].file", "sphere 1 of the file lies outside of the world; see [world] min and max"},
    {[](S& s) {
         s.pour.push_back(small_pour());
         s.pour[0].count = 0;
     },
        "pour[0].count", "a pour needs 'count' or 'mass', greater than 0"},
    {[](S& s) {
         s.pour.push_back(small_pour());
         s.pour[0].mass = 1.0;
     },
        "pour[0].count", "give 'count' or 'mass', not both of them"},
    {[](S& s) {
         s.pour.push_back(small_pour());
         s.pour[0].rate = 0.0;
     },
        "pour[0].rate", "a pour needs 'rate' or 'mass_rate', greater than 0"},
    {[](S& s) {
         s.pour.push_back(small_pour());
         s.pour[0].mass_rate = 1.0;
     },
        "pour[0].rate", "give 'rate' or 'mass_rate', not both of them"},
    {[](S& s) {
         s.pour.push_back(small_pour());
         s.pour[0].count = 0;
         s.pour[0].mass = 1e6;
     },
        "pour[0].mass", "this mass is that of more than 100 million spheres"},
};

/// The key and the sentence of the error that the scene makes.
std::pair<std::string, std::string> refusal_of(const S& scene)
{
    try {
        build_scene(scene);
    } catch (const SceneError& error) {
        return {error.key, error.what()};
    }
    return {"none", "no error"};
}

void check_all(const std::vector<Mistake>& mistakes)
{
    for (const Mistake& mistake : mistakes) {
        auto scene = small_scene();
        mistake.make(scene);
        INFO(mistake.key << ": " << mistake.sentence);
        const auto [key, sentence] = refusal_of(scene);
        CHECK(key == mistake.key);
        CHECK(sentence == mistake.sentence);
    }
}

} // namespace

TEST_CASE("a scene with a mistake is not built, and the key and the reason are told", "[scenes][errors]")
{
    SECTION("materials and their contacts")
    {
        check_all(of_materials);
    }
    SECTION("walls")
    {
        check_all(of_walls);
    }
    SECTION("motions, periodic axes, rotation, grains and slopes")
    {
        check_all(of_motions);
    }
    SECTION("distances")
    {
        check_all(of_distances);
    }
    SECTION("walls of finite mass")
    {
        check_all(of_masses);
    }
    SECTION("spheres")
    {
        check_all(of_spheres);
    }
    SECTION("sensors and output")
    {
        check_all(of_sensors);
    }
    SECTION("sizes, species, files and pours")
    {
        check_all(of_insertion);
    }
    SECTION("world, solver, outlets and sensors")
    {
        check_all(of_the_rest);
    }
}

TEST_CASE("of several mistakes the first in the order of the scene is told", "[scenes][errors]")
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

TEST_CASE("of two tables with one name both are told", "[scenes][errors]")
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
