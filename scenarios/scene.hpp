// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/vector.hpp"
#include "core/world/piston.hpp"
#include "core/world/wall_motion.hpp"

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
/// mutable self. A field is a bool, std::int64_t, double, std::string, Vec3, NumberOrName, SwitchOrName, a list of
/// strings, another table with a describe of its own, or a std::vector of such tables.
namespace talus::scene
{

/// What a value may be. Numbers lie in [min, max], where `open` leaves min itself out, and are finite unless
/// `infinite`; a string is one of `names` unless that is empty. A key may belong to some kinds of its table only: those
/// that have one of the names in `of` as the value of the table's deciding key. A required key may be left out by the
/// kinds in `optional_for`.
struct Allowed {
    double min = -infinity;
    double max = infinity;
    bool open = false;
    bool infinite = false;
    std::vector<std::string_view> names = {};
    bool required = false;
    bool decides = false;
    std::vector<std::string_view> of = {};
    std::vector<std::string_view> optional_for = {};

    /// Whether a table has the key when its deciding key has this value.
    bool belongs_to(std::string_view kind) const { return of.empty() || std::ranges::find(of, kind) != of.end(); }

    /// Whether a table must give the key when its deciding key has this value.
    bool required_by(std::string_view kind) const
    {
        return required && std::ranges::find(optional_for, kind) == optional_for.end();
    }
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
inline Allowed required_but_for(std::vector<std::string_view> kinds, Allowed allowed)
{
    allowed.required = true;
    allowed.optional_for = std::move(kinds);
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

/// true, false, or one of the names that its key allows. The name is empty where true or false was given.
struct SwitchOrName {
    bool on = false;
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
    std::vector<std::string> periodic;
    bool rotation = true;
    std::string on_escape = "stop";

    static void describe(auto& self, auto&& key)
    {
        key("gravity", self.gravity, any(), "m/s2", "acceleration of free fall");
        key("min", self.min, or_infinite(any()), "m",
            "lower corner of the world that no sphere may leave; -inf: from the walls, fills, pours and outlets, grown "
            "by five diameters");
        key("max", self.max, or_infinite(any()), "m", "upper corner; inf: likewise, and open upwards");
        key("periodic", self.periodic, one_of({"x", "y", "z"}), "",
            "axes along which the world repeats itself from 'min' to 'max'; two at most");
        key("rotation", self.rotation, any(), "",
            "false: spheres do not turn, so that friction acts as between blocks; no rolling resistance then");
        key("on_escape", self.on_escape, one_of({"stop", "remove"}), "",
            "a sphere that leaves the world other than through an outlet stops the run; or it is taken out, counted, "
            "kept in lost.vtp, and the run goes on");
    }
};

struct SolverTable {
    std::string stabilisation = "matched";
    NumberOrName tolerance = {0.0, "auto"};
    std::int64_t min_sweeps = 0;
    std::int64_t max_sweeps = 100;
    double relaxation = 1.3;
    NumberOrName push_out_speed = {0.0, "auto"};
    SwitchOrName pressure_scaling = {false, "auto"};
    std::string on_no_solution = "stop";

    static void describe(auto& self, auto&& key)
    {
        key("stabilisation", self.stabilisation, one_of({"matched", "projected"}), "",
            "matched: contacts as stiff as the sweeps can carry; projected: rigid contacts, overlap removed by moving "
            "spheres");
        key("tolerance", self.tolerance,
            Allowed{.min = 0.0, .max = 1.0, .open = true, .names = {"auto", "draft", "standard", "fine", "reference"}},
            "",
            "relative residual that ends the sweeps: 5e-2, 1e-2, 1e-3, 1e-4, or a number; auto: standard, or what "
            "accuracy picks");
        key("min_sweeps", self.min_sweeps, between(0, 10000), "",
            "least number of sweeps in a step; 0: what accuracy picks, else 2 with matched, 3 with projected, 6 where "
            "pressures are scaled in a bed of a hundred grains or deeper");
        key("max_sweeps", self.max_sweeps, between(1, 1000000), "",
            "sweeps after which a step goes on unconverged, which is counted and told");
        key("relaxation", self.relaxation, between(0.5, 1.6), "",
            "of the sweeps after the least number, but where pressures are scaled; above 1 they go farther than each "
            "contact asks for, by which fast flows converge in fewer sweeps");
        key("push_out_speed", self.push_out_speed, Allowed{.min = 0.0, .names = {"auto"}}, "m/s",
            "largest speed with which overlap is undone; auto: 0.1 sqrt(diameter x gravity), without gravity 0.0008 "
            "diameter / step");
        key("pressure_scaling", self.pressure_scaling, one_of({"auto"}), "",
            "carries changes of load through the whole bed at once; only with projected; auto: with projected, where "
            "the bed is forty grains deep or something rests on grains much lighter, but not along periodic axes");
        key("on_no_solution", self.on_no_solution, one_of({"stop", "go_on"}), "",
            "when walls press spheres together so that projected, which is rigid, has no solution; go_on: their "
            "contacts yield, and the run tells of them");
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

    static void describe(auto& self, auto&& key) { describe(self, key, {"box", "cylinder"}); }

    static void describe(auto& self, auto&& key, std::vector<std::string_view> shapes)
    {
        key("shape", self.shape, deciding(one_of(std::move(shapes))), "", "");
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
    double mean = 0.0;
    double median = 0.0;
    double deviation = 0.0;
    double min = 0.0;
    double max = 0.0;
    std::string file = {};

    std::vector<double> sieve_sizes = {};   ///< [m], of the file, filled in by io, rising
    std::vector<double> sieve_passing = {}; ///< share of the mass that passes each, from 0 to 1

    static void describe(auto& self, auto&& key)
    {
        key("distribution", self.distribution,
            deciding(one_of({"constant", "uniform", "normal", "lognormal", "sieve"})), "",
            "of diameters: by number, but for a sieve analysis, which is by mass");
        key("value", self.value, required(only_for({"constant"}, at_least(0.0))), "m", "the diameter");
        key("mean", self.mean, required(only_for({"normal"}, above(0.0))), "m", "before min and max cut it");
        key("median", self.median, required(only_for({"lognormal"}, above(0.0))), "m", "before min and max cut it");
        key("deviation", self.deviation, required(only_for({"normal", "lognormal"}, above(0.0))), "",
            "standard deviation; normal: of the diameter [m], lognormal: of its natural logarithm");
        key("min", self.min, required(only_for({"uniform", "normal", "lognormal"}, at_least(0.0))), "m",
            "the smallest");
        key("max", self.max, required(only_for({"uniform", "normal", "lognormal"}, at_least(0.0))), "m", "the largest");
        key("file", self.file, required(only_for({"sieve"}, any())), "",
            "a CSV file, beside the scene file: size_mm or size_m, and passing_percent of the mass");
    }

    /// Whether the scene gives a diameter here, where it may be left out.
    bool given() const { return distribution != "constant" || value != 0.0; }
};

/// One kind of sphere among several in a fill or a pour.
struct SpeciesTable {
    std::string material;
    DiameterTable diameter;
    double share = 1.0;

    static void describe(auto& self, auto&& key)
    {
        key("material", self.material, required(any()), "", "of the spheres");
        key("diameter", self.diameter, required(any()), "m", "a number, or a table with a distribution");
        key("share", self.share, required(above(0.0)), "",
            "of the mass, in proportion to the sum of the shares of all species");
    }
};

/// Spheres as a file lists them [m, m/s, rad/s]. A list other than that of positions is empty where the file has none.
struct SphereList {
    std::vector<Vec3> positions;
    std::vector<double> radii;
    std::vector<Vec3> velocities;
    std::vector<Vec3> angular_velocities;
};

struct FillTable {
    std::string arrangement = "lattice";
    std::string material;
    DiameterTable diameter;
    std::vector<SpeciesTable> species;
    std::int64_t count = 0;
    RegionTable region;
    double spacing = 1.1;
    std::string file;
    double scale = 1.0;
    Vec3 translate = Vec3::Zero();
    Vec3 velocity = Vec3::Zero();
    Vec3 angular_velocity = Vec3::Zero();

    SphereList spheres; ///< of the file, filled in by io, scaled and translated

    static void describe(auto& self, auto&& key)
    {
        key("arrangement", self.arrangement, deciding(one_of({"lattice", "random", "file"})), "",
            "lattice: a jittered lattice, filled from below; random: anywhere without overlap (loose fills only); "
            "file: as a file lists them");
        key("material", self.material, any(), "", "of the spheres; left out where there are species");
        key("diameter", self.diameter, any(), "m",
            "a number, or a table with a distribution; left out where there are species, or where the file has radii");
        key("species", self.species, only_for({"lattice", "random"}, any()), "",
            "several kinds of spheres, mixed at random");
        key("count", self.count, required_but_for({"file"}, between(0, 100000000)), "",
            "how many spheres are there at the start; file: 0, or as many as it has");
        key("region", self.region, required(only_for({"lattice", "random"}, any())), "",
            "where; spheres lie wholly inside");
        key("spacing", self.spacing, only_for({"lattice"}, between(1.0, 100.0)), "",
            "distance of the lattice's points / largest diameter");
        key("file", self.file, required(only_for({"file"}, any())), "",
            "a .vtp, .vtu or .csv file of spheres, beside the scene file");
        key("scale", self.scale, only_for({"file"}, above(0.0)), "",
            "the file's positions, radii and velocities times this are in m and m/s");
        key("translate", self.translate, only_for({"file"}, any()), "m", "moved by this after scaling");
        key("velocity", self.velocity, any(), "m/s", "of the spheres at the start, added to that of a file");
        key("angular_velocity", self.angular_velocity, any(), "rad/s",
            "of the spheres at the start, added to that of a file");
    }
};

struct PourTable {
    std::string name;
    std::string material;
    DiameterTable diameter;
    std::vector<SpeciesTable> species;
    std::int64_t count = 0;
    double mass = 0.0;
    double rate = 0.0;
    double mass_rate = 0.0;
    RegionTable region;
    Vec3 velocity = Vec3::Zero();
    double start = 0.0;

    static void describe(auto& self, auto&& key)
    {
        key("name", self.name, any(), "", "for --set and the report");
        key("material", self.material, any(), "", "of the spheres; left out where there are species");
        key("diameter", self.diameter, any(), "m",
            "a number, or a table with a distribution; left out where there are species");
        key("species", self.species, any(), "", "several kinds of spheres, mixed at random");
        key("count", self.count, between(0, 100000000), "", "how many spheres in all; 0: by 'mass'");
        key("mass", self.mass, at_least(0.0), "kg", "of all spheres, reached by the last of them; 0: by 'count'");
        key("rate", self.rate, at_least(0.0), "1/s", "spheres per second; 0: by 'mass_rate'");
        key("mass_rate", self.mass_rate, at_least(0.0), "kg/s", "mass per second; 0: by 'rate'");
        key("region", self.region, required(any()), "", "where they appear; never overlapping anything");
        key("velocity", self.velocity, any(), "m/s", "with which they appear");
        key("start", self.start, at_least(0.0), "s", "when the pour begins");
    }
};

/// The names of all materials in a fill or a pour.
std::vector<std::string> materials_in(const auto& table)
{
    if (table.species.empty()) return {table.material};
    std::vector<std::string> names;
    for (const SpeciesTable& species : table.species) names.push_back(species.material);
    return names;
}

using Waypoint = Course::Waypoint;
using LoadRow = LoadPoint;

struct MotionTable {
    std::string kind;
    double from = 0.0;
    double to = infinity;
    Vec3 velocity = Vec3::Zero();
    Vec3 point = Vec3::Zero();
    Vec3 axis = Vec3::UnitZ();
    double rate = 0.0;
    Vec3 amplitude = Vec3::Zero();
    double frequency = 0.0;
    std::vector<Waypoint> table;

    static void describe(auto& self, auto&& key)
    {
        key("kind", self.kind, required(deciding(one_of({"translate", "turn", "shake", "table"}))), "", "");
        key("from", self.from, only_for({"translate", "turn", "shake"}, at_least(0.0)), "s", "when it begins");
        key("to", self.to, only_for({"translate", "turn", "shake"}, or_infinite(at_least(0.0))), "s",
            "when it ends; the wall stays where it has come to");
        key("velocity", self.velocity, required(only_for({"translate"}, any())), "m/s", "");
        key("point", self.point, only_for({"turn"}, any()), "m", "on the axis");
        key("axis", self.axis, required(only_for({"turn"}, any())), "", "direction of the axis");
        key("rate", self.rate, required(only_for({"turn"}, any())), "rad/s", "right-handed about the axis");
        key("amplitude", self.amplitude, required(only_for({"shake"}, any())), "m",
            "the wall is amplitude sin(2 pi frequency (t - from)) away from its place");
        key("frequency", self.frequency, required(only_for({"shake"}, above(0.0))), "Hz", "");
        key("table", self.table, required(only_for({"table"}, any())), "s, m",
            "rows [time, x, y, z]: how far from its place the wall is then; straight lines in between, held at the "
            "ends");
    }
};

struct WallTable {
    std::string name;
    std::string shape = "mesh";
    std::string material;
    double appear_at = 0.0;
    double remove_at = infinity;
    std::vector<MotionTable> motion;
    // of finite mass
    double mass = infinity;
    Vec3 guide = Vec3::Zero();
    std::vector<LoadRow> load;
    double released_at = 0.0;
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
    // grains
    double diameter = 0.0;
    double spacing = 1.0;
    // mesh
    std::string mesh;
    double scale = 1.0;
    Vec3 translate = Vec3::Zero();

    std::vector<Vec3> vertices;                         ///< of the mesh, filled in by io, scaled and translated
    std::vector<std::array<std::int32_t, 3>> triangles; ///< of three vertices

    static void describe(auto& self, auto&& key)
    {
        const std::vector<std::string_view> bounded = {"box", "cylinder", "cone", "disk", "grains", "mesh"};
        key("name", self.name, required(any()), "", "for --set, reports and the wall frames");
        key("shape", self.shape, deciding(one_of({"plane", "box", "cylinder", "cone", "disk", "grains", "mesh"})), "",
            "plane: a half-space; grains: spheres fixed to each other, a rough bed; the others are thin, with two "
            "sides");
        key("material", self.material, required(any()), "", "");
        key("appear_at", self.appear_at, at_least(0.0), "s", "when the wall is put there");
        key("remove_at", self.remove_at, or_infinite(at_least(0.0)), "s", "when the wall is taken away; inf: never");
        key("motion", self.motion, any(), "",
            "how the wall moves: one or more parts [[wall.motion]], each of which moves what comes of those before it");
        key("mass", self.mass, only_for(bounded, or_infinite(above(0.0))), "kg",
            "finite: a piston, which its weight, its load and the spheres move; inf: the wall moves as told, whatever "
            "pushes");
        key("guide", self.guide, only_for(bounded, any()), "",
            "needed with a finite mass: the axis along which alone it moves, without turning");
        key("load", self.load, only_for(bounded, any()), "N",
            "force on a finite mass besides its weight, along the guide; of rows [time, force]: straight lines in "
            "between, held at the ends");
        key("released_at", self.released_at, only_for(bounded, at_least(0.0)), "s",
            "until then a finite mass is held where it is");
        key("point", self.point, only_for({"plane"}, any()), "m", "a point on it");
        key("normal", self.normal, only_for({"plane", "disk"}, any()), "",
            "of a plane: into the free side; of a disk: at right angles to the plate");
        key("min", self.min, only_for({"box", "grains"}, any()), "m", "lower corner");
        key("max", self.max, required(only_for({"box", "grains"}, any())), "m",
            "upper corner; of the centres of grains");
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
        key("diameter", self.diameter, required(only_for({"grains"}, above(0.0))), "m", "of the grains");
        key("spacing", self.spacing, only_for({"grains"}, between(0.2, 10.0)), "",
            "of the jittered lattice on which they lie / their diameter");
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

/// Kinds: mass_flow through a plane; repose, the angle of a heap; slope, that of a free surface; region: packing
/// fraction, coordination, velocity, granular temperature and stress in it; profile: packing and flow in the bins of a
/// region; wall_force: force and torque on a wall; wall_position: travel, speed and load of a wall of finite mass.
struct SensorTable {
    std::string name;
    std::string kind;
    // the steady part of the run, for all but repose
    double from = 0.0;
    double to = infinity;
    // mass_flow, slope and wall_force
    Vec3 point = Vec3::Zero();
    // mass_flow
    Vec3 normal = -Vec3::UnitZ();
    // wall_force and wall_position
    std::string wall;
    // slope
    Vec3 along = Vec3::UnitX();
    double length = 0.0;
    // repose
    Vec3 base = Vec3::Zero();
    double inner_radius = 0.0;
    double outer_radius = 0.0;
    // region and profile
    RegionTable region;
    std::string direction;
    std::int64_t bins = 20;

    static void describe(auto& self, auto&& key)
    {
        const std::vector<std::string_view> averaging = {
            "mass_flow", "slope", "region", "profile", "wall_force", "wall_position"};
        key("name", self.name, required(any()), "", "for reports");
        key("kind", self.kind,
            required(
                deciding(one_of({"mass_flow", "repose", "slope", "region", "profile", "wall_force", "wall_position"}))),
            "", "");
        key("point", self.point, only_for({"mass_flow", "slope", "wall_force"}, any()), "m",
            "mass_flow: a point on the plane; slope: the middle of the surface; wall_force: what torques are about");
        key("normal", self.normal, only_for({"mass_flow"}, any()), "", "direction of the flow");
        key("along", self.along, required(only_for({"slope"}, any())), "",
            "direction along which the surface falls, at right angles to gravity");
        key("length", self.length, required(only_for({"slope"}, above(0.0))), "m", "of the measured part");
        key("wall", self.wall, required(only_for({"wall_force", "wall_position"}, any())), "",
            "name of the wall; for wall_position, one of finite mass");
        key("region", self.region, required(only_for({"region", "profile"}, any())), "", "where");
        key("direction", self.direction, required(only_for({"profile"}, one_of({"x", "y", "z", "axial", "radial"}))),
            "", "in which bin follows bin: x, y or z in a box; axial or radial in a cylinder");
        key("bins", self.bins, only_for({"profile"}, between(1, 10000)), "", "how many, equally wide");
        key("from", self.from, only_for(averaging, at_least(0.0)), "s", "start of the steady part");
        key("to", self.to, only_for(averaging, or_infinite(at_least(0.0))), "s", "end of the steady part");
        key("base", self.base, only_for({"repose"}, any()), "m", "centre of the heap's floor");
        key("inner_radius", self.inner_radius, only_for({"repose"}, at_least(0.0)), "m",
            "where the fitted line begins");
        key("outer_radius", self.outer_radius, only_for({"repose"}, at_least(0.0)), "m",
            "where it ends; 0: fit between 20 and 80 % of the height");
    }
};

/// A region that may be all there is.
struct PartTable : RegionTable {
    PartTable() { shape = "everything"; }

    static void describe(auto& self, auto&& key)
    {
        RegionTable::describe(self, key, {"everything", "box", "cylinder"});
    }
};

struct OutputTable {
    std::vector<std::string> particle_arrays = {"velocity", "angular_velocity", "material"};
    std::vector<std::string> contact_arrays = {"force", "normal_force", "gap", "id_a", "id_b", "wall"};
    double contact_interval = infinity;
    double contact_threshold = 0.0;
    PartTable region;

    static void describe(auto& self, auto&& key)
    {
        key("particle_arrays", self.particle_arrays,
            one_of({"velocity", "angular_velocity", "material", "force", "coordination"}), "",
            "what particle frames hold besides id and radius; force: sum of the contact forces; coordination: contacts "
            "with an impulse");
        key("contact_arrays", self.contact_arrays, one_of({"force", "normal_force", "gap", "id_a", "id_b", "wall"}), "",
            "what contact frames hold");
        key("contact_interval", self.contact_interval, or_infinite(above(0.0)), "s",
            "time between contact frames; inf: first and last only");
        key("contact_threshold", self.contact_threshold, at_least(0.0), "mean force",
            "contacts with less force are left out of the frames");
        key("region", self.region, any(), "",
            "frames hold the spheres with their centres and the contacts with their points in it");
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
    std::string accuracy;
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
        key("accuracy", self.accuracy, any(), "",
            "\"1%\": takes the time step, the least number of sweeps and the tolerance from the cheapest setting that "
            "was no more wrong in any of the studies of tests/studies; empty: the usual setting");
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
