// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/world/piston.hpp"
#include "core/world/wall_motion.hpp"
#include "scenarios/allowed.hpp"

#include <array>
#include <cstdint>

/// [[wall]], with how it moves.
namespace talus::scene
{

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
            "finite: a piston, which its weight, its load and the spheres move; inf: the wall moves as prescribed, "
            "whatever "
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

} // namespace talus::scene
