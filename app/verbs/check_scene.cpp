// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/verbs/check_scene.hpp"

#include "app/system/terminal.hpp"
#include "app/verbs/forecast.hpp"
#include "io/run/frames.hpp"
#include "io/text/input_error.hpp"
#include "scenarios/builder/checks.hpp"
#include "scenarios/builder/meshes.hpp"

#include <cmath>

namespace talus
{
namespace
{

// What a dense packing has for each sphere; candidates are the listed pairs, skin included (measured).
constexpr double candidates_per_sphere = 6.0;
constexpr double contacts_per_sphere = 3.0;

constexpr double base_memory = 20e6;          ///< program and libraries [B]
constexpr double passing_memory = 300.0;      ///< for a sphere, while the search or a frame is at work [B]
constexpr double particle_frame_bytes = 50.0; ///< for a sphere, compressed (measured)
constexpr double contact_frame_bytes = 50.0;  ///< for a contact, compressed (measured)
constexpr double metrics_row_bytes = 200.0;
constexpr double checkpoint_bytes = 400.0; ///< for a sphere (measured); two checkpoints are kept

double poured_count(const Simulation& simulation)
{
    double count = 0.0;
    for (const Pour& pour : simulation.pours) count += poured_by(pour, simulation.duration, simulation);
    return count;
}

double mass(const Simulation& simulation)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < simulation.state.count(); ++i) sum += simulation.state.mass(i);
    for (const Pour& pour : simulation.pours)
        sum += poured_by(pour, simulation.duration, simulation) * pour.mixture.mean_mass(simulation.model.materials);
    return sum;
}

std::string by_axis(const Vec3& extent)
{
    return fmt::format("{:.3g} x {:.3g} x {:.3g}", extent.x(), extent.y(), extent.z());
}

/// A line for something that lies in the scene: how large it is, beside a sphere, and where.
void print_content(const std::string& what, const Box& box, double diameter, const std::string& more = "")
{
    const std::string size = box.empty() ? "without end"
                                         : fmt::format("{} m = {} d; x {:.3g} to {:.3g}, y {:.3g} to {:.3g}, z {:.3g} "
                                                       "to {:.3g}",
                                               by_axis(box.extent()), by_axis(box.extent() / diameter), box.min.x(),
                                               box.max.x(), box.min.y(), box.max.y(), box.min.z(), box.max.z());
    say("  {:<24} {}{}\n", what, size, more);
}

std::string about_mesh(const Wall& wall, double diameter)
{
    const auto* mesh = std::get_if<Mesh>(&wall.shape);
    if (!mesh) return "";
    const std::string holes = holes_in_words(*mesh, diameter);
    return fmt::format("; {} triangles, {}", mesh->triangles.size(), holes.empty() ? "closed" : "open: " + holes);
}

void print_contents(const OpenedScene& opened)
{
    const Model& model = opened.simulation.model;
    const scene::Scene& scene = opened.scene;
    const double d = model.mean_diameter;
    for (std::size_t k = 0; k < scene.fill.size(); ++k) {
        const scene::FillTable& fill = scene.fill[k];
        Box box;
        if (fill.arrangement == "single")
            box.extend(fill.position);
        else if (fill.arrangement == "file")
            for (const Vec3& x : fill.spheres.positions) box.extend(x);
        else
            box = require_region(fill.region, d, "").bounds();
        print_content(fmt::format("fill {}", k), box, d);
    }
    for (const Pour& pour : opened.simulation.pours)
        print_content(fmt::format("pour '{}'", pour.name), pour.region.bounds(), d);
    for (std::size_t k = 0; k < model.walls.size(); ++k)
        print_content(fmt::format("{} '{}'", scene.wall[k].shape, model.walls[k].name), bounds(model.walls[k].shape), d,
            about_mesh(model.walls[k], d));
    for (std::size_t k = 0; k < model.outlets.size(); ++k)
        print_content(fmt::format("outlet '{}'", scene.outlet[k].name), model.outlets[k].bounds(), d);
    say("world: {}\n", opened.report.world);
    if (has_64_bit_frames(model))
        say("frames: places have 64 bits, as 32 lose more than 1e-3 d so far from the origin\n");
}

/// "12 s", "3.4 min", "5.6 h".
std::string time_in_words(double seconds)
{
    if (seconds < 100.0) return fmt::format("{:.2g} s", seconds);
    if (seconds < 6000.0) return fmt::format("{:.2g} min", seconds / 60.0);
    return fmt::format("{:.2g} h", seconds / 3600.0);
}

/// With all spheres there at once [B]: the state of each and its place in the candidate list, its candidates (twice, as
/// the old list lives until the new one has taken over its impulses), and for each candidate room for a contact.
double memory_estimate(const Simulation& simulation, double spheres)
{
    const double state =
        2 * sizeof(Vec3) + sizeof(double) + sizeof(Body) + 2 * sizeof(std::int32_t) + sizeof(std::int64_t) + 1;
    const double listed = sizeof(Box) + 4 * sizeof(std::uint32_t);
    double candidate = sizeof(IndexPair) + sizeof(Vec3) + 1;
    double contact = (sizeof(ContactPack) + sizeof(RecordPack)) / pack_size;
    if (simulation.model.physics.rolling) {
        candidate += sizeof(Vec3);
        contact += sizeof(RollingRow);
    }
    const double for_a_sphere = state + listed + candidates_per_sphere * (2 * candidate + contact) + passing_memory;
    return base_memory + spheres * for_a_sphere;
}

double frame_count(double duration, double interval)
{
    return 2.0 + std::floor(duration / interval);
}

/// Of the whole run with all spheres in every frame [B].
double disk_estimate(const OpenedScene& opened, double spheres)
{
    const scene::TimeTable& time = opened.scene.time;
    const double contacts = contacts_per_sphere * spheres;
    return frame_count(time.duration, time.frame_interval) * spheres * particle_frame_bytes +
           frame_count(time.duration, opened.scene.output.contact_interval) * contacts * contact_frame_bytes +
           time.duration / time.metrics_interval * metrics_row_bytes + 2.0 * spheres * checkpoint_bytes;
}

void print_needs(const OpenedScene& opened)
{
    const Simulation& simulation = opened.simulation;
    const double spheres = static_cast<double>(simulation.state.count()) + poured_count(simulation);
    const double steps = std::ceil(simulation.duration / simulation.model.time_step);
    const double cpu = forecast_cpu(opened);
    say("time: {:.0f} steps; {} on one thread, or half or twice as long\n", steps,
        cpu < 1.0 ? "below 1 s" : "some " + time_in_words(cpu));
    say("memory: about {:.0f} MB\n", 1e-6 * memory_estimate(simulation, spheres));
    say("disk: up to {:.0f} MB\n", std::ceil(1e-6 * disk_estimate(opened, spheres)));
}

void print_overlaps_at_start(const Simulation& simulation, const OverlapCheck& overlaps)
{
    if (overlaps.count == 0) {
        say("overlaps at the start: none\n");
        return;
    }
    const std::string other =
        overlaps.wall < 0
            ? fmt::format("sphere {}", overlaps.id_b)
            : fmt::format("wall '{}'", simulation.model.walls[static_cast<std::size_t>(overlaps.wall)].name);
    say("overlaps at the start: {}, the worst {:.2g} % d of sphere {} with {}\n", overlaps.count,
        100.0 * overlaps.worst / simulation.model.mean_diameter, overlaps.id_a, other);
}

} // namespace

void print_explanations(const OpenedScene& opened, const OverlapCheck& overlaps)
{
    const BuildReport& report = opened.report;
    for (const std::string& choice : {report.files, report.accuracy, report.solver})
        if (!choice.empty()) say("{}\n", choice);
    say("{}\n{}\n{}\n", report.step, report.model, report.overlap);
    print_overlaps_at_start(opened.simulation, overlaps);
    for (const std::string& warning : report.warnings) warn("{}\n", warning);
}

void print_scene(const OpenedScene& opened, const OverlapCheck& overlaps)
{
    const Simulation& simulation = opened.simulation;
    say("{}: {}\n", opened.name, opened.scene.title);
    const Model& model = simulation.model;
    say("spheres: {} at the start, {:.0f} poured in, {:.4g} kg; {:.4g} to {:.4g} m in diameter, d = {:.4g} m on "
        "average\n",
        simulation.state.count(), poured_count(simulation), mass(simulation), model.min_diameter, model.max_diameter,
        model.mean_diameter);
    print_contents(opened);
    print_explanations(opened, overlaps);
    say("Talus does not model shapes other than spheres, elasticity along the surface, breakage, wear, heat and fluids "
        "(but for the force of liquid bridges)\n");
    print_needs(opened);
}

void check_scene(const OpenedScene& opened, bool resolved)
{
    print_scene(opened, check_overlaps(opened.simulation));
    if (resolved) say("\n{}", resolved_scene(opened.scene));
}

void list_scenes()
{
    for (const auto& path : supplied_scenes()) {
        try {
            say("{:<16} {}\n", path.stem().string(), read_scene(path).scene.title);
        } catch (const InputError& error) {
            say("{:<16} cannot be read: {}\n", path.stem().string(), error.what());
        }
    }
}

} // namespace talus
