// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scenarios/allowed.hpp"
#include "scenarios/sphere_tables.hpp"

/// How a run goes and what it writes: the tables [time], [world], [solver], [output] and [checkpoint] of a scene.
namespace talus::scene
{

struct TimeTable {
    NumberOrName step = {0.0, "auto"};
    double duration = 1.0;
    double frame_interval = 0.02;
    double metrics_interval = 0.005;

    static void describe(auto& self, auto&& key)
    {
        key("step", self.step, Allowed{.min = 0.0, .open = true, .names = {"auto"}}, "s",
            "time step; auto: the longest that keeps to [targets]");
        key("duration", self.duration, at_least(0.0), "s", "simulated time");
        key("frame_interval", self.frame_interval, or_infinite(above(0.0)), "s",
            "time between frames for ParaView; inf: first and last only");
        key("metrics_interval", self.metrics_interval, above(0.0), "s",
            "time between samples of the sensors and rows of metrics.csv");
    }
};

/// Of these, `auto` is what accuracy picks, or the default.
struct TargetsTable {
    NumberOrName overlap = {0.0, "auto"};
    NumberOrName creep = {0.0, "auto"};
    NumberOrName approach = {0.0, "auto"};

    static void describe(auto& self, auto&& key)
    {
        const Allowed positive{.min = 0.0, .open = true, .names = {"auto"}};
        key("overlap", self.overlap, positive, "d",
            "mean overlap of loaded contacts at rest, as far as a stiffness that the scene gives does not make it; "
            "auto: "
            "what accuracy picks, else 0.002");
        key("creep", self.creep, positive, "",
            "time step by the least number of sweeps, in sqrt(smallest diameter / gravity); auto: what accuracy picks, "
            "else 0.0036");
        key("approach", self.approach, positive, "d",
            "how far surfaces come nearer to each other in a step, of which one has been thrown back, in smallest "
            "diameters; auto: what accuracy picks, else 0.1");
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
            "by five diameters, and without end to the sides where a plane bears spheres");
        key("max", self.max, or_infinite(any()), "m", "upper corner; inf: from the same, and open upwards");
        key("periodic", self.periodic, one_of({"x", "y", "z"}), "",
            "axes along which the world repeats itself from 'min' to 'max', 2.2 diameters of the largest sphere at "
            "least");
        key("rotation", self.rotation, any(), "",
            "false: spheres do not turn, so that friction acts as between blocks; no rolling resistance then");
        key("on_escape", self.on_escape, one_of({"stop", "remove"}), "",
            "a sphere that leaves the world other than through an outlet stops the run; or it is taken out, counted, "
            "kept in lost.vtp, and the run goes on");
    }
};

struct SolverTable {
    std::string stabilisation = "auto";
    NumberOrName tolerance = {0.0, "auto"};
    std::int64_t min_sweeps = 0;
    std::int64_t max_sweeps = 300;
    double relaxation = 1.3;
    NumberOrName push_out_speed = {0.0, "auto"};
    SwitchOrName pressure_scaling = {false, "auto"};
    std::string on_no_solution = "stop";

    static void describe(auto& self, auto&& key)
    {
        key("stabilisation", self.stabilisation, one_of({"auto", "matched", "projected"}), "",
            "matched: contacts as stiff as the sweeps can carry; projected: rigid contacts, overlap removed by moving "
            "spheres; auto: matched, but where nothing flows projected for columns 150 diameters high and under a "
            "sphere of 50000 times the mass of another");
        key("tolerance", self.tolerance,
            Allowed{.min = 0.0, .max = 1.0, .open = true, .names = {"auto", "draft", "standard", "fine", "reference"}},
            "",
            "relative residual that ends the sweeps: 5e-2, 1e-2, 1e-3, 1e-4, or a number; auto: standard, or what "
            "accuracy picks; down to fine where a sphere has more than 5 times the mass of another, and fine with "
            "restitution without gravity");
        key("min_sweeps", self.min_sweeps, between(0, 10000), "",
            "least number of sweeps in a step; 0: with matched 2 to 4, more in longer steps; 3 with projected, 6 where "
            "pressures are scaled in a bed of a hundred grains or deeper");
        key("max_sweeps", self.max_sweeps, between(1, 1000000), "",
            "sweeps after which a step goes on unconverged, which is counted and reported");
        key("relaxation", self.relaxation, between(0.5, 1.6), "",
            "of the sweeps after the least number, without friction and with matched of all but the last of those too, "
            "but where pressures are scaled; above 1 they go farther than each contact asks for, by which fast flows "
            "converge in fewer sweeps");
        key("push_out_speed", self.push_out_speed, Allowed{.min = 0.0, .names = {"auto"}}, "m/s",
            "speed with which overlap is undone that no load has pressed; auto: 0.1 sqrt(diameter x gravity), without "
            "gravity 0.00072 diameter / step");
        key("pressure_scaling", self.pressure_scaling, one_of({"auto"}), "",
            "carries changes of load through the whole bed at once; only with projected, and not with periodic axes; "
            "auto: with projected, where the bed is forty grains deep or something rests on grains much lighter");
        key("on_no_solution", self.on_no_solution, one_of({"stop", "go_on"}), "",
            "when walls press spheres together so that projected, which is rigid, has no solution; go_on: their "
            "contacts yield, and the run tells of them");
    }
};

/// A region that may be all there is.
struct PartTable : RegionTable {
    PartTable() { shape = "everything"; }

    static void describe(auto& self, auto&& key)
    {
        RegionTable::describe(self, key, {"everything", "box", "cylinder", "cone", "sphere", "mesh"});
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

} // namespace talus::scene
