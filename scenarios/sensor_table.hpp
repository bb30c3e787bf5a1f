// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/sphere_tables.hpp"

namespace talus::scene
{

/// A region over which is averaged: of these shapes the parts of spheres and of contacts inside are known.
struct AveragingTable : RegionTable {
    static void describe(auto& self, auto&& key) { RegionTable::describe(self, key, {"box", "cylinder"}); }
};

/// Kinds: mass_flow through a plane; repose, the angle of a heap; slope, that of a free surface; region: packing
/// fraction, coordination, velocity, granular temperature and stress in it; profile: packing and flow in the bins of a
/// region; wall_force: force and torque on a wall; wall_position: travel, speed and load of a wall of finite mass;
/// sphere: where one sphere is, how fast and with which spin.
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
    AveragingTable region;
    std::string direction;
    std::int64_t bins = 20;
    // sphere
    std::int64_t id = 0;

    static void describe(auto& self, auto&& key)
    {
        const std::vector<std::string_view> averaging = {
            "mass_flow", "slope", "region", "profile", "wall_force", "wall_position"};
        key("name", self.name, required(any()), "", "for reports");
        key("kind", self.kind,
            required(deciding(one_of(
                {"mass_flow", "repose", "slope", "region", "profile", "wall_force", "wall_position", "sphere"}))),
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
        key("id", self.id, required(only_for({"sphere"}, at_least(0.0))), "",
            "of the sphere: fills give ids from 0 on, in the order of the scene, then pours as spheres come in");
        key("from", self.from, only_for(averaging, at_least(0.0)), "s", "start of the steady part");
        key("to", self.to, only_for(averaging, or_infinite(at_least(0.0))), "s", "end of the steady part");
        key("base", self.base, only_for({"repose"}, any()), "m", "centre of the heap's floor");
        key("inner_radius", self.inner_radius, only_for({"repose"}, at_least(0.0)), "m",
            "where the fitted line begins");
        key("outer_radius", self.outer_radius, only_for({"repose"}, at_least(0.0)), "m",
            "where it ends; 0: fit between 20 and 80 % of the height");
    }
};

} // namespace talus::scene
