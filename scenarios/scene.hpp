// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/vector.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// What a scene is: plain SI numbers with defaults. Every key of a scene file stands here once, in the `describe` of
/// its table: name, field, allowed values, unit, meaning. The reader, the resolved scene and the checks all walk these.
///
/// `describe(self, key)` calls key(name, field, Allowed, unit, meaning) for each key in order; it serves a const and a
/// mutable self. A field is a bool, std::int64_t, double, std::string, Vec3, NumberOrName, a list of strings, another
/// table with a describe of its own, or a std::vector of such tables.
namespace talus::scene
{

/// What a value may be. Numbers lie in [min, max], where `open` leaves min itself out, and are finite unless
/// `infinite`; a string is one of `names` unless that is empty. A key may belong to some kinds of its table only: those
/// that have one of the names in `of` as the value of the table's deciding key.
struct Allowed {
    double min = -infinity;
    double max = infinity;
    bool open = false;
    bool infinite = false;
    std::vector<std::string_view> names = {};
    bool required = false;
    bool decides = false;
    std::vector<std::string_view> of = {};

    /// Whether a table has the key when its deciding key has this value.
    bool belongs_to(std::string_view kind) const { return of.empty() || std::ranges::find(of, kind) != of.end(); }
};

inline Allowed any()
{
    return {};
}
inline Allowed above(double min)
{
    return {.min = min, .open = true};
}
inline Allowed at_least(double min)
{
    return {.min = min};
}
inline Allowed between(double min, double max)
{
    return {.min = min, .max = max};
}
inline Allowed one_of(std::vector<std::string_view> names)
{
    return {.names = std::move(names)};
}
inline Allowed or_infinite(Allowed allowed)
{
    allowed.infinite = true;
    return allowed;
}
inline Allowed required(Allowed allowed)
{
    allowed.required = true;
    return allowed;
}
inline Allowed deciding(Allowed allowed)
{
    allowed.decides = true;
    return allowed;
}
inline Allowed only_for(std::vector<std::string_view> kinds, Allowed allowed)
{
    allowed.of = std::move(kinds);
    return allowed;
}

/// A number, or one of the names that its key allows ("auto", "standard"). The name is empty where a number was given.
struct NumberOrName {
    double number = 0.0;
    std::string name;
};

struct TimeTable {
    NumberOrName step = {0.0, "auto"};
    double duration = 1.0;
    double frame_interval = 0.02;
    double metrics_interval = 0.005;

    static void describe(auto& self, auto&& key)
    {
        key("step", self.step, Allowed{.min = 0.0, .open = true, .names = {"auto"}}, "s",
            "time step; auto: 0.008 sqrt(smallest diameter / gravity), and no sphere moves over 0.1 d in a step");
        key("duration", self.duration, at_least(0.0), "s", "simulated time");
        key("frame_interval", self.frame_interval, or_infinite(above(0.0)), "s",
            "time between frames for ParaView; inf: first and last only");
        key("metrics_interval", self.metrics_interval, above(0.0), "s",
            "time between samples of the sensors and rows of metrics.csv");
    }
};

struct WorldTable {
    Vec3 gravity = Vec3(0, 0, -9.81);
    Vec3 min = Vec3::Constant(-infinity);
    Vec3 max = Vec3::Constant(infinity);
    std::string on_escape = "stop";

    static void describe(auto& self, auto&& key)
    {
        key("gravity", self.gravity, any(), "m/s2", "acceleration of free fall");
        key("min", self.min, or_infinite(any()), "m",
            "lower corner of the world that no sphere may leave; -inf: from the walls, fills, pours and outlets, grown "
            "by five diameters");
        key("max", self.max, or_infinite(any()), "m", "upper corner; inf: likewise, and open upwards");
        key("on_escape", self.on_escape, one_of({"stop", "remove"}), "",
            "a sphere that leaves the world other than through an outlet stops the run; or it is taken out, counted, "
            "kept in lost.vtp, and the run goes on");
    }
};

struct SolverTable {
    std::string stabilisation = "matched";
    NumberOrName tolerance = {0.0, "standard"};
    std::int64_t min_sweeps = 0;
    std::int64_t max_sweeps = 100;
    double restitution_threshold = 3.0;
    NumberOrName push_out_speed = {0.0, "auto"};

    static void describe(auto& self, auto&& key)
    {
        key("stabilisation", self.stabilisation, one_of({"matched", "projected"}), "",
            "matched: contacts as stiff as the sweeps can carry; projected: rigid contacts, overlap removed by moving "
            "spheres");
        key("tolerance", self.tolerance,
            Allowed{.min = 0.0, .max = 1.0, .open = true, .names = {"draft", "standard", "fine", "reference"}}, "",
            "relative residual that ends the sweeps: 5e-2, 1e-2, 1e-3, 1e-4, or a number");
        key("min_sweeps", self.min_sweeps, between(0, 10000), "",
            "least number of sweeps in a step; 0: 2 with matched, 3 with projected");
        key("max_sweeps", self.max_sweeps, between(1, 1000000), "",
            "sweeps after which a step goes on unconverged, which is counted and told");
        key("restitution_threshold", self.restitution_threshold, at_least(0.0), "gravity x step",
            "slower impacts do not rebound");
        key("push_out_speed", self.push_out_speed, Allowed{.min = 0.0, .names = {"auto"}}, "m/s",
            "largest speed with which overlap is undone; auto: 0.1 sqrt(diameter x gravity), without gravity 0.0008 "
            "diameter / step");
    }
};

struct MaterialTable {
    std::string name; ///< the table's own name: [materials.NAME]
    double density = 2500.0;

    static void describe(auto& self, auto&& key) { key("density", self.density, above(0.0), "kg/m3", "of the solid"); }
};

struct ContactTable {
    std::vector<std::string> between; ///< two materials
    double friction = 0.5;
    double restitution = 0.0;
    double rolling_friction = 0.0;
    double stiffness = infinity;

    static void describe(auto& self, auto&& key)
    {
        key("between", self.between, required(any()), "", "the two materials");
        key("friction", self.friction, at_least(0.0), "", "Coulomb's coefficient");
        key("restitution", self.restitution, talus::scene::between(0.0, 1.0), "",
            "Newton's coefficient: rebound speed / impact speed");
        key("rolling_friction", self.rolling_friction, at_least(0.0), "",
            "largest rolling torque / (normal force x R*), R* = r1 r2 / (r1 + r2), at a wall the radius");
        key("stiffness", self.stiffness, or_infinite(above(0.0)), "N/m",
            "of the normal contact; inf: rigid; only with matched");
    }
};

struct RegionTable {
    std::string shape = "box";
    Vec3 min = Vec3::Zero();
    Vec3 max = Vec3::Zero();
    Vec3 base = Vec3::Zero();
    Vec3 axis = Vec3::UnitZ();
    double radius = 0.0;
    double height = 0.0;

    static void describe(auto& self, auto&& key)
    {
        key("shape", self.shape, deciding(one_of({"box", "cylinder"})), "", "");
        key("min", self.min, only_for({"box"}, any()), "m", "lower corner");
        key("max", self.max, required(only_for({"box"}, any())), "m", "upper corner");
        key("base", self.base, only_for({"cylinder"}, any()), "m", "centre of the first end");
        key("axis", self.axis, only_for({"cylinder"}, any()), "", "direction from the first end to the second");
        key("radius", self.radius, required(only_for({"cylinder"}, at_least(0.0))), "m", "of the cylinder");
        key("height", self.height, required(only_for({"cylinder"}, at_least(0.0))), "m", "distance of the ends");
    }
};

struct DiameterTable {
    std::string distribution = "constant";
    double value = 0.0;
    double min = 0.0;
    double max = 0.0;

    static void describe(auto& self, auto&& key)
    {
        key("distribution", self.distribution, deciding(one_of({"constant", "uniform"})), "", "of diameters by number");
        key("value", self.value, required(only_for({"constant"}, at_least(0.0))), "m", "the diameter");
        key("min", self.min, required(only_for({"uniform"}, at_least(0.0))), "m", "the smallest");
        key("max", self.max, required(only_for({"uniform"}, at_least(0.0))), "m", "the largest");
    }
};

struct FillTable {
    std::string material;
    std::int64_t count = 0;
    DiameterTable diameter;
    RegionTable region;
    std::string arrangement = "lattice";
    double spacing = 1.1;
    Vec3 velocity = Vec3::Zero();
    Vec3 angular_velocity = Vec3::Zero();

    static void describe(auto& self, auto&& key)
    {
        key("material", self.material, required(any()), "", "of the spheres");
        key("count", self.count, required(between(0, 100000000)), "", "how many spheres are there at the start");
        key("diameter", self.diameter, required(any()), "m", "a number, or a table with a distribution");
        key("region", self.region, required(any()), "", "where; spheres lie wholly inside");
        key("arrangement", self.arrangement, deciding(one_of({"lattice", "random"})), "",
            "lattice: a jittered lattice, filled from below; random: anywhere without overlap (loose fills only)");
        key("spacing", self.spacing, only_for({"lattice"}, between(1.0, 100.0)), "",
            "distance of the lattice's points / largest diameter");
        key("velocity", self.velocity, any(), "m/s", "of the spheres at the start");
        key("angular_velocity", self.angular_velocity, any(), "rad/s", "of the spheres at the start");
    }
};

struct PourTable {
    std::string name;
    std::string material;
    std::int64_t count = 0;
    double rate = 0.0;
    DiameterTable diameter;
    RegionTable region;
    Vec3 velocity = Vec3::Zero();
    double start = 0.0;

    static void describe(auto& self, auto&& key)
    {
        key("name", self.name, any(), "", "for --set and the report");
        key("material", self.material, required(any()), "", "of the spheres");
        key("count", self.count, required(between(0, 100000000)), "", "how many spheres in all");
        key("rate", self.rate, required(above(0.0)), "1/s", "spheres per second");
        key("diameter", self.diameter, required(any()), "m", "a number, or a table with a distribution");
        key("region", self.region, required(any()), "", "where they appear; never overlapping anything");
        key("velocity", self.velocity, any(), "m/s", "with which they appear");
        key("start", self.start, at_least(0.0), "s", "when the pour begins");
    }
};

struct WallTable {
    std::string name;
    std::string shape = "mesh";
    std::string material;
    double appear_at = 0.0;
    double remove_at = infinity;
    // plane
    Vec3 point = Vec3::Zero();
    Vec3 normal = Vec3::UnitZ();
    // box
    Vec3 min = Vec3::Zero();
    Vec3 max = Vec3::Zero();
    std::vector<std::string> open;
    // cylinder and cone
    Vec3 base = Vec3::Zero();
    Vec3 axis = Vec3::UnitZ();
    double height = 0.0;
    double radius = 0.0; ///< of a cylinder or disk
    double base_radius = 0.0;
    double top_radius = 0.0;
    // disk
    Vec3 center = Vec3::Zero();
    double hole_radius = 0.0;
    // mesh
    std::string mesh;
    double scale = 1.0;
    Vec3 translate = Vec3::Zero();

    std::vector<Vec3> vertices;                         ///< of the mesh, filled in by io, scaled and translated
    std::vector<std::array<std::int32_t, 3>> triangles; ///< likewise

    static void describe(auto& self, auto&& key)
    {
        key("name", self.name, required(any()), "", "for --set, reports and the wall frames");
        key("shape", self.shape, deciding(one_of({"plane", "box", "cylinder", "cone", "disk", "mesh"})), "",
            "plane: a half-space; the others are thin, with two sides");
        key("material", self.material, required(any()), "", "");
        key("appear_at", self.appear_at, at_least(0.0), "s", "when the wall is put there");
        key("remove_at", self.remove_at, or_infinite(at_least(0.0)), "s", "when the wall is taken away; inf: never");
        key("point", self.point, only_for({"plane"}, any()), "m", "a point on it");
        key("normal", self.normal, only_for({"plane", "disk"}, any()), "",
            "of a plane: into the free side; of a disk: at right angles to the plate");
        key("min", self.min, only_for({"box"}, any()), "m", "lower corner");
        key("max", self.max, required(only_for({"box"}, any())), "m", "upper corner");
        key("open", self.open, only_for({"box"}, one_of({"x-", "x+", "y-", "y+", "z-", "z+"})), "",
            "the faces left out");
        key("base", self.base, only_for({"cylinder", "cone"}, any()), "m", "centre of the first end");
        key("axis", self.axis, only_for({"cylinder", "cone"}, any()), "", "direction from the first end to the second");
        key("height", self.height, required(only_for({"cylinder", "cone"}, at_least(0.0))), "m",
            "distance of the ends");
        key("radius", self.radius, required(only_for({"cylinder", "disk"}, at_least(0.0))), "m",
            "of the tube or plate");
        key("base_radius", self.base_radius, only_for({"cone"}, at_least(0.0)), "m", "at the first end");
        key("top_radius", self.top_radius, only_for({"cone"}, at_least(0.0)), "m", "at the second end");
        key("center", self.center, only_for({"disk"}, any()), "m", "of the plate");
        key("hole_radius", self.hole_radius, only_for({"disk"}, at_least(0.0)), "m",
            "of the round hole in the middle; 0: none");
        key("mesh", self.mesh, required(only_for({"mesh"}, any())), "", "an STL file, beside the scene file");
        key("scale", self.scale, only_for({"mesh"}, above(0.0)), "", "the file's numbers times this are metres");
        key("translate", self.translate, only_for({"mesh"}, any()), "m", "moved by this after scaling");
    }
};

struct OutletTable {
    std::string name;
    RegionTable region;

    static void describe(auto& self, auto&& key)
    {
        key("name", self.name, any(), "", "for --set and the report");
        key("region", self.region, required(any()), "", "a sphere whose centre enters it leaves the world");
    }
};

struct SensorTable {
    std::string name;
    std::string kind;
    // mass_flow
    Vec3 point = Vec3::Zero();
    Vec3 normal = -Vec3::UnitZ();
    double from = 0.0;
    double to = infinity;
    // repose
    Vec3 base = Vec3::Zero();
    double inner_radius = 0.0;
    double outer_radius = 0.0;

    static void describe(auto& self, auto&& key)
    {
        key("name", self.name, required(any()), "", "for reports");
        key("kind", self.kind, required(deciding(one_of({"mass_flow", "repose"}))), "", "");
        key("point", self.point, only_for({"mass_flow"}, any()), "m", "a point on the plane");
        key("normal", self.normal, only_for({"mass_flow"}, any()), "", "direction of the flow");
        key("from", self.from, only_for({"mass_flow"}, at_least(0.0)), "s", "start of the steady part");
        key("to", self.to, only_for({"mass_flow"}, or_infinite(at_least(0.0))), "s", "end of the steady part");
        key("base", self.base, only_for({"repose"}, any()), "m", "centre of the heap's floor");
        key("inner_radius", self.inner_radius, only_for({"repose"}, at_least(0.0)), "m",
            "where the fitted line begins");
        key("outer_radius", self.outer_radius, only_for({"repose"}, at_least(0.0)), "m",
            "where it ends; 0: fit between 20 and 80 % of the height");
    }
};

struct OutputTable {
    double contact_interval = infinity;
    double contact_threshold = 0.0;

    static void describe(auto& self, auto&& key)
    {
        key("contact_interval", self.contact_interval, or_infinite(above(0.0)), "s",
            "time between contact frames; inf: first and last only");
        key("contact_threshold", self.contact_threshold, at_least(0.0), "mean force",
            "contacts with less force are left out of the frames");
    }
};

struct CheckpointTable {
    double interval = infinity;
    double wall_interval = 600.0;

    static void describe(auto& self, auto&& key)
    {
        key("interval", self.interval, or_infinite(above(0.0)), "s",
            "simulated time between checkpoints; inf: none for its sake");
        key("wall_interval", self.wall_interval, or_infinite(above(0.0)), "s",
            "time by the clock between checkpoints; inf: none for its sake");
    }
};

struct Scene {
    std::string title;
    std::int64_t seed = 1;
    TimeTable time;
    WorldTable world;
    SolverTable solver;
    OutputTable output;
    CheckpointTable checkpoint;
    std::vector<MaterialTable> materials; ///< in the file a table of tables: [materials.NAME]
    std::vector<ContactTable> contact;
    std::vector<FillTable> fill;
    std::vector<PourTable> pour;
    std::vector<WallTable> wall;
    std::vector<OutletTable> outlet;
    std::vector<SensorTable> sensor;

    static void describe(auto& self, auto&& key)
    {
        key("title", self.title, any(), "", "one line on what the scene shows");
        key("seed", self.seed, at_least(0), "", "of all random numbers");
        key("time", self.time, any(), "", "");
        key("world", self.world, any(), "", "");
        key("solver", self.solver, any(), "", "");
        key("output", self.output, any(), "", "");
        key("checkpoint", self.checkpoint, any(), "", "");
        key("materials", self.materials, any(), "", "one table for each material");
        key("contact", self.contact, any(), "", "one table for each pair of materials that may touch");
        key("fill", self.fill, any(), "", "spheres there at the start");
        key("pour", self.pour, any(), "", "spheres that enter over time");
        key("wall", self.wall, any(), "", "");
        key("outlet", self.outlet, any(), "", "");
        key("sensor", self.sensor, any(), "", "");
    }
};

} // namespace talus::scene
