// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/measured_setting.hpp"
#include "scenarios/run_tables.hpp"
#include "scenarios/sensor_table.hpp"
#include "scenarios/sphere_tables.hpp"
#include "scenarios/wall_tables.hpp"

/// What a scene is: plain SI numbers with defaults. Every key of a scene file stands once, in the `describe` of its
/// table: name, field, allowed values, unit, meaning. The reader, the resolved scene and the checks all walk these.
namespace talus::scene
{

struct Scene {
    std::string title;
    std::int64_t seed = 1;
    std::string accuracy;
    TimeTable time;
    TargetsTable targets;
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
    std::vector<MeasuredSetting> measured = {}; ///< no key: what accuracy chooses from, where the scene asks for one

    static void describe(auto& self, auto&& key)
    {
        key("title", self.title, any(), "", "one line on what the scene shows");
        key("seed", self.seed, at_least(0), "", "of all random numbers");
        key("accuracy", self.accuracy, any(), "",
            "\"1%\": takes the targets of the automatic step and the tolerance from the coarsest setting that keeps "
            "results to that; empty: the usual setting, 3%");
        key("time", self.time, any(), "", "");
        key("targets", self.targets, any(), "", "what the automatic step keeps to");
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
