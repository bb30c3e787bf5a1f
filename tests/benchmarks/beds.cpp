// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/benchmarks/beds.hpp"
#include "tests/benchmarks/measures.hpp"

#include "io/run/checkpoint.hpp"
#include "io/scene/scene_file.hpp"
#include "io/text/input_error.hpp"
#include "scenarios/builder/build_scene.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <stdexcept>

namespace talus::bench
{
namespace
{

constexpr const char* bed_format = "bed 1"; ///< stands where a checkpoint of a run has the version of Talus
constexpr int steps_to_find_forces = 30;

/// Diameters [m], and the one whose cube is their mean: so many make as much volume.
struct Sizes {
    double min, max, of_mean_volume;
};
constexpr Sizes narrow{0.0095, 0.0105, 0.01};
constexpr Sizes wide{0.006, 0.018, 0.0129};

scene::WallTable wall(const char* name, const char* shape)
{
    scene::WallTable table;
    table.name = name;
    table.shape = shape;
    table.material = "glass";
    return table;
}

scene::FillTable fill(std::int64_t count, const Sizes& sizes)
{
    scene::FillTable table;
    table.material = "glass";
    table.count = count;
    table.diameter.distribution = "uniform";
    table.diameter.min = sizes.min;
    table.diameter.max = sizes.max;
    return table;
}

/// Glass beads; a world that repeats itself along y after this length.
scene::Scene beads(double length)
{
    scene::Scene scene;
    scene.materials = {{"glass", 2500.0}};
    scene.contact = {{.between = {"glass", "glass"}, .friction = 0.5, .restitution = 0.5}};
    if (length == 0.0) return scene;
    scene.world.periodic = {"y"};
    scene.world.min.y() = 0.0;
    scene.world.max.y() = length;
    return scene;
}

/// A trough between two walls, with a slot along its bottom that opens at this time.
/// @param unit [m]: it is `across` units wide and half as long
scene::Scene trough(std::int64_t count, const Sizes& sizes, double across, double opens)
{
    const double unit = sizes.of_mean_volume, width = across * unit, length = 0.5 * width;
    auto scene = beads(length);
    scene.fill = {fill(count, sizes)};
    scene.fill[0].region.min = Vec3(-0.5 * width, 0, 0.001);
    scene.fill[0].region.max = Vec3(0.5 * width, length, 10.0 * across * unit);
    auto left = wall("left", "plane"), right = wall("right", "plane"), bottom = wall("bottom", "mesh"),
         gate = wall("gate", "mesh");
    left.point = Vec3(-0.5 * width, 0, 0);
    left.normal = Vec3::UnitX();
    right.point = Vec3(0.5 * width, 0, 0);
    right.normal = -Vec3::UnitX();
    const auto add_panel = [&](scene::WallTable& table, double from, double to) {
        const auto first = static_cast<std::int32_t>(table.vertices.size());
        for (const double y : {0.0, length})
            for (const double x : {from, to}) table.vertices.emplace_back(x, y, 0.0);
        table.triangles.push_back({first, first + 1, first + 3});
        table.triangles.push_back({first, first + 3, first + 2});
    };
    const double slot = 2.0 * sizes.max; // half of its width
    add_panel(bottom, -0.5 * width, -slot);
    add_panel(bottom, slot, 0.5 * width);
    add_panel(gate, -slot, slot);
    bottom.mesh = gate.mesh = "made here";
    gate.remove_at = opens;
    scene.wall = {left, right, bottom, gate};
    scene.outlet.resize(1);
    scene.outlet[0].region.min = Vec3(-width, 0, -0.4);
    scene.outlet[0].region.max = Vec3(width, length, -0.1);
    return scene;
}

/// A drum, half full, that turns about y from 0.3 s on.
scene::Scene drum(std::int64_t count, double radius)
{
    const double unit = narrow.of_mean_volume, length = 0.3 * radius * unit;
    auto scene = beads(length);
    scene.fill = {fill(count, narrow)};
    scene.fill[0].region.shape = "cylinder";
    scene.fill[0].region.axis = Vec3::UnitY();
    scene.fill[0].region.radius = radius * unit;
    scene.fill[0].region.height = length;
    auto shell = wall("drum", "cylinder");
    shell.axis = Vec3::UnitY();
    shell.radius = radius * unit;
    shell.height = length;
    scene::MotionTable turning;
    turning.kind = "turn";
    turning.axis = Vec3::UnitY();
    turning.rate = 1.0;
    turning.from = 0.3;
    shell.motion = {turning};
    scene.wall = {shell};
    return scene;
}

/// A box with beads of 9.5 to 10.5 mm, open at the top: workload W3 of the peers.
scene::Scene box(std::int64_t count, double width)
{
    auto scene = beads(0.0);
    scene.fill = {fill(count, narrow)};
    scene.fill[0].region.max = Vec3(width, width, 1.0);
    auto walls = wall("box", "box");
    walls.max = Vec3(width, width, 1.1);
    walls.open = {"z+"};
    scene.wall = {walls};
    return scene;
}

/// The length of a scene along y, times the copies that lie side by side there.
void lengthen(scene::Scene& scene, int copies)
{
    scene.world.max.y() *= copies;
    for (scene::WallTable& table : scene.wall) {
        table.height *= table.axis == Vec3::UnitY() ? copies : 1;
        for (Vec3& vertex : table.vertices) vertex.y() *= copies;
    }
    for (scene::OutletTable& outlet : scene.outlet) outlet.region.max.y() *= copies;
}

scene::SphereList repeated(const scene::SphereList& spheres, double length, int copies)
{
    scene::SphereList all;
    for (int k = 0; k < copies; ++k) {
        const Vec3 shift = k == 0 ? Vec3::Zero() : Vec3(k * length * Vec3::UnitY()); // the length may be infinite
        for (const Vec3& x : spheres.positions) all.positions.emplace_back(x + shift);
        std::ranges::copy(spheres.radii, std::back_inserter(all.radii));
        std::ranges::copy(spheres.velocities, std::back_inserter(all.velocities));
        std::ranges::copy(spheres.angular_velocities, std::back_inserter(all.angular_velocities));
    }
    return all;
}

/// What is kept of a bed.
struct Laid {
    scene::SphereList spheres;
    double step = 0.0; ///< of the scene [s]

    void persist(Archive& archive)
    {
        archive(spheres.positions, spheres.radii, spheres.velocities, spheres.angular_velocities, step);
    }
};

Laid simulate(const Bed& bed)
{
    std::fprintf(stderr, "making the bed %s\n", bed.name.c_str());
    omp_set_num_threads(two_are_free() ? 2 : 1);
    auto simulation = build_scene(bed.beginning).simulation;
    while (!has_reached(simulation, bed.until)) advance(simulation);
    Laid laid;
    laid.step = simulation.model.time_step;
    // Not the one that a fall from the height of the lattice asks for.
    if (!bed.of_scene) laid.step = 0.0072 * std::sqrt(simulation.model.min_diameter / 9.81);
    const State& state = simulation.state;
    for (std::size_t i = 0; i < state.count(); ++i) {
        laid.spheres.positions.push_back(state.position[i]);
        laid.spheres.radii.push_back(state.radius[i]);
        laid.spheres.velocities.push_back(state.body(i).velocity);
        laid.spheres.angular_velocities.push_back(state.angular_velocity(i));
    }
    return laid;
}

/// Made once, and kept in a folder of its own.
Laid lay(const Bed& bed)
{
    const auto folder = std::filesystem::path(TALUS_BEDS_FOLDER) / bed.name;
    Laid laid;
    if (std::filesystem::exists(folder)) {
        Archive archive(read_checkpoint(folder, bed_format).state);
        archive(laid);
        return laid;
    }
    laid = simulate(bed);
    Archive archive;
    archive(laid);
    std::filesystem::create_directories(folder);
    write_checkpoint(folder, bed_format, archive.bytes());
    return laid;
}

/// The step with which it goes on: one in which spheres are put into the order of a curve, so that copies are, too.
std::int64_t first_step(const Bed& bed, double step)
{
    constexpr double renumbering_interval = 1000.0;
    return std::llround(renumbering_interval * std::ceil(bed.until / step / renumbering_interval));
}

/// The scene as it goes on from the bed.
scene::Scene going_on(const Bed& bed, const Laid& laid)
{
    auto scene = bed.beginning;
    const double length = scene.world.max.y();
    lengthen(scene, bed.copies);
    scene.time.step = {laid.step, ""};
    scene.fill.resize(1);
    scene.fill[0] = {};
    scene.fill[0].arrangement = "file";
    scene.fill[0].material = scene.materials[0].name;
    scene.fill[0].spheres = repeated(laid.spheres, length, bed.copies);
    // What has been poured is there; the rest follows from now on.
    for (scene::PourTable& pour : scene.pour) {
        pour.start = static_cast<double>(first_step(bed, laid.step)) * laid.step;
        pour.count = std::max<std::int64_t>(1, pour.count - static_cast<std::int64_t>(laid.spheres.positions.size()));
    }
    return scene;
}

} // namespace

Bed find_bed(const std::string& name)
{
    // Copies of 4000 or 32 000; a trough is as deep as that is.
    const auto copies_of = [&](Bed bed, int copies) {
        bed.copies = copies;
        return bed;
    };
    const auto rest = [](const char* own, std::int64_t count, const Sizes& sizes, double across) {
        return Bed{own, trough(count, sizes, across, infinity), sizes.max > narrow.max ? 1.3 : 0.7};
    };
    const auto smooth = [&] {
        Bed bed = rest("smooth_4k", 4000, narrow, 20);
        bed.beginning.contact[0].friction = 0.0;
        return bed;
    };
    const auto flow = [](const char* own, std::int64_t count, double across) {
        return Bed{own, trough(count, narrow, across, 0.5), 0.7};
    };
    const auto scene = [](const std::string& own, double until) {
        const auto path = std::filesystem::path(TALUS_SOURCE_DIR) / "scenarios" / (own + ".toml");
        return Bed{"scene_" + own, read_scene(path).scene, until, 1, true};
    };
    const std::map<std::string, std::function<Bed()>> beds = {
        {"rest_4k", [&] { return rest("rest_4k", 4000, narrow, 20); }},
        {"rest_32k", [&] { return rest("rest_32k", 32000, narrow, 40); }},
        {"rest_250k", [&] { return copies_of(rest("rest_32k", 32000, narrow, 40), 8); }},
        {"rest_1M", [&] { return copies_of(rest("rest_32k", 32000, narrow, 40), 32); }},
        {"wide_4k", [&] { return rest("wide_4k", 4000, wide, 20); }},
        {"wide_32k", [&] { return copies_of(rest("wide_4k", 4000, wide, 20), 8); }},
        {"wide_250k", [&] { return copies_of(rest("wide_4k", 4000, wide, 20), 64); }},
        {"wide_1M", [&] { return copies_of(rest("wide_4k", 4000, wide, 20), 256); }},
        {"smooth_4k", smooth},
        {"smooth_32k", [&] { return copies_of(smooth(), 8); }},
        {"flow_4k", [&] { return flow("flow_4k", 4000, 20); }},
        {"flow_32k", [&] { return flow("flow_32k", 32000, 40); }},
        {"flow_250k", [&] { return copies_of(flow("flow_32k", 32000, 40), 8); }},
        {"flow_1M", [&] { return copies_of(flow("flow_32k", 32000, 40), 32); }},
        {"drum_4k",
            [&] {
                return Bed{"drum_4k", drum(4000, 20), 1.1};
            }},
        {"drum_32k",
            [&] {
                return Bed{"drum_32k", drum(32000, 40), 1.1};
            }},
        {"drum_250k",
            [&] {
                return copies_of({"drum_32k", drum(32000, 40), 1.1}, 8);
            }},
        {"drum_1M",
            [&] {
                return copies_of({"drum_32k", drum(32000, 40), 1.1}, 32);
            }},
        {"w3_5000",
            [&] {
                return Bed{"w3_5000", box(5000, 0.17), 1.0};
            }},
        {"w3_20000",
            [&] {
                return Bed{"w3_20000", box(20000, 0.27), 1.0};
            }},
        {"hopper", [&] { return scene("hopper", 1.6); }},
        {"silo", [&] { return scene("silo", 2.0); }},
        {"pile", [&] { return scene("pile", 3.0); }},
        {"drum", [&] { return scene("drum", 2.5); }},
        {"packing", [&] { return scene("packing", 1.0); }},
    };
    const auto found = beds.find(name);
    if (found == beds.end()) throw std::invalid_argument("there is no bed " + name);
    return found->second();
}

Simulation open_bed(const std::string& name, const Change& change)
{
    const Bed bed = find_bed(name);
    auto scene = going_on(bed, lay(bed));
    omp_set_num_threads(1);
    if (change) change(scene);
    auto simulation = build_scene(scene).simulation;
    const double h = simulation.model.time_step;
    simulation.state.steps = first_step(bed, h);
    simulation.state.time = static_cast<double>(simulation.state.steps) * h;
    for (int k = 0; k < steps_to_find_forces; ++k) advance(simulation);
    return simulation;
}

} // namespace talus::bench
