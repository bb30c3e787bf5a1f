// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/verbs/check_scene.hpp"

#include "app/system/terminal.hpp"
#include "io/text/input_error.hpp"

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

std::size_t triangle_count(const Model& model)
{
    std::size_t count = 0;
    for (const Wall& wall : model.walls)
        if (const auto* mesh = std::get_if<Mesh>(&wall.shape)) count += mesh->triangles.size();
    return count;
}

double poured_count(const Simulation& simulation)
{
    double count = 0.0;
    for (const Pour& pour : simulation.pours) count += expected_count(pour, simulation.model.materials);
    return count;
}

/// With all spheres there at once [B]: the state of each and its place in the candidate list, its candidates (twice, as
/// the old list lives until the new one has taken over its impulses), and for each candidate room for a contact.
double memory_estimate(const Simulation& simulation, double spheres)
{
    const double state = sizeof(Vec3) + sizeof(Motion) + 2 * sizeof(std::int32_t) + sizeof(std::int64_t) + 1;
    const double listed = sizeof(Box) + 4 * sizeof(std::uint32_t);
    double candidate = sizeof(IndexPair) + sizeof(Vec3) + 1;
    double contact = sizeof(Contact) + sizeof(ContactTerms) + sizeof(ContactGeometry);
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
    say("steps: {:.0f}\n", std::ceil(simulation.duration / simulation.model.time_step));
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
    for (const std::string& choice : {report.accuracy, report.solver})
        if (!choice.empty()) say("{}\n", choice);
    say("{}\n{}\n{}\n", report.step, report.model, report.overlap);
    print_overlaps_at_start(opened.simulation, overlaps);
    for (const std::string& warning : report.warnings) warn("{}\n", warning);
}

void print_scene(const OpenedScene& opened, const OverlapCheck& overlaps)
{
    const Simulation& simulation = opened.simulation;
    say("{}: {}\n", opened.name, opened.scene.title);
    say("spheres: {} at the start, {:.0f} poured in; {:.4g} to {:.4g} m in diameter\n", simulation.state.count(),
        poured_count(simulation), simulation.model.min_diameter, simulation.model.max_diameter);
    say("walls: {} with {} triangles; materials: {}; outlets: {}; sensors: {}\n", simulation.model.walls.size(),
        triangle_count(simulation.model), simulation.model.materials.list.size(), simulation.model.outlets.size(),
        simulation.sensors.size());
    print_explanations(opened, overlaps);
    print_needs(opened);
}

void check_scene(const OpenedScene& opened)
{
    print_scene(opened, check_overlaps(opened.simulation));
    say("\n{}", resolved_scene(opened.scene));
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
