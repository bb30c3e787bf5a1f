// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/frames.hpp"

#include "core/contacts/loads.hpp"
#include "core/world/placed_wall.hpp"
#include "io/run/poly_data.hpp"
#include "io/run/run_files.hpp"
#include "io/run/wall_surface.hpp"
#include "io/text/input_error.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <numeric>

namespace talus
{

namespace
{

/// A contact as a frame shows it: a line from the first sphere's centre to what it touches.
struct ContactLine {
    Vec3 from, to;
    Vec3 force; ///< on the first sphere [N]
    double normal_force;
    double gap;
    std::int64_t id_a;
    std::int64_t id_b; ///< −1 at a wall
    std::int32_t wall; ///< −1 between spheres
};

bool is_asked_for(const std::vector<std::string>& arrays, const char* name)
{
    return std::ranges::find(arrays, name) != arrays.end();
}

bool shows(const OutputChoice& output, const Vec3& point)
{
    return !output.region || output.region->contains(point);
}

/// The spheres to be shown, in the order of their ids.
std::vector<std::size_t> shown_spheres(const State& state, const OutputChoice& output)
{
    std::vector<std::size_t> shown;
    for (std::size_t i = 0; i < state.count(); ++i)
        if (shows(output, state.position[i])) shown.push_back(i);
    std::ranges::sort(shown, {}, [&](std::size_t i) { return state.id[i]; });
    return shown;
}

std::vector<ContactLine> loaded_contacts(const Simulation& simulation, const OutputChoice& output)
{
    const State& state = simulation.state;
    const double h = simulation.network.carried.impulse_step;
    std::vector<ContactLine> lines;
    const auto add = [&](const Contact& c, double length, std::int64_t id_b, int wall) {
        const Vec3& x = state.position[c.a];
        const Vec3 point = x - state.radius[c.a] * c.normal;
        if (shows(output, point))
            lines.push_back(
                {x, x - length * c.normal, c.impulse / h, c.normal_impulse() / h, c.gap, state.id[c.a], id_b, wall});
    };
    for_each_loaded_sphere_contact(simulation.network,
        [&](const Contact& c) { add(c, state.radius[c.a] + state.radius[c.b] + c.gap, state.id[c.b], -1); });
    for_each_loaded_wall_contact(
        simulation.network, [&](const Contact& c) { add(c, state.radius[c.a] + c.gap, -1, c.b); });
    return lines;
}

/// The name of a frame in the run's folder.
std::string frame_file(const std::string& series, std::size_t index)
{
    return fmt::format("frames/{}_{:06}.vtp", series, index);
}

void drop_weaker_than(double threshold, std::vector<ContactLine>& lines)
{
    const auto add = [](double sum, const ContactLine& line) { return sum + line.force.norm(); };
    const double mean = std::accumulate(lines.begin(), lines.end(), 0.0, add) / static_cast<double>(lines.size());
    std::erase_if(lines, [&](const ContactLine& line) { return line.force.norm() <= threshold * mean; });
}

void add_particle_arrays(vtkPointData& data, const std::vector<std::string>& arrays, const Simulation& simulation,
    const std::vector<std::size_t>& shown)
{
    const State& state = simulation.state;
    const std::size_t count = shown.size();
    const auto asked = [&](const char* name) { return is_asked_for(arrays, name); };
    add_integers(data, "id", count, [&](std::size_t k) { return state.id[shown[k]]; });
    add_floats(data, "radius", count, [&](std::size_t k) { return state.radius[shown[k]]; });
    if (asked("velocity"))
        add_vectors(data, "velocity", count, [&](std::size_t k) { return state.body(shown[k]).velocity; });
    if (asked("angular_velocity"))
        add_vectors(data, "angular_velocity", count, [&](std::size_t k) { return state.angular_velocity(shown[k]); });
    if (asked("material"))
        add_integers(data, "material", count, [&](std::size_t k) { return state.material[shown[k]]; });
    if (!asked("force") && !asked("coordination")) return;
    const auto loads = sphere_loads(simulation.network, state.count());
    const double h = simulation.network.carried.impulse_step;
    if (asked("force")) add_vectors(data, "force", count, [&](std::size_t k) { return loads[shown[k]].impulse / h; });
    if (asked("coordination"))
        add_integers(data, "coordination", count, [&](std::size_t k) { return loads[shown[k]].contacts; });
}

vtkNew<vtkPolyData> particles_of(const Simulation& simulation, const OutputChoice& output)
{
    const State& state = simulation.state;
    const std::vector<std::size_t> shown = shown_spheres(state, output);
    const std::size_t count = shown.size();
    vtkNew<vtkPolyData> geometry;
    set_points(
        *geometry, count, simulation.model.mean_diameter, [&](std::size_t k) { return state.position[shown[k]]; });
    add_point_cell(*geometry, count);
    add_particle_arrays(*geometry->GetPointData(), output.particle_arrays, simulation, shown);
    return geometry;
}

void add_contact_arrays(
    vtkCellData& data, const std::vector<std::string>& arrays, const std::vector<ContactLine>& lines)
{
    const std::size_t count = lines.size();
    const auto asked = [&](const char* name) { return is_asked_for(arrays, name); };
    if (asked("force")) add_vectors(data, "force", count, [&](std::size_t k) { return lines[k].force; });
    if (asked("normal_force"))
        add_floats(data, "normal_force", count, [&](std::size_t k) { return lines[k].normal_force; });
    if (asked("gap")) add_floats(data, "gap", count, [&](std::size_t k) { return lines[k].gap; });
    if (asked("id_a")) add_integers(data, "id_a", count, [&](std::size_t k) { return lines[k].id_a; });
    if (asked("id_b")) add_integers(data, "id_b", count, [&](std::size_t k) { return lines[k].id_b; });
    if (asked("wall")) add_integers(data, "wall", count, [&](std::size_t k) { return lines[k].wall; });
}

vtkNew<vtkPolyData> contacts_of(const Simulation& simulation, const OutputChoice& output)
{
    std::vector<ContactLine> lines = loaded_contacts(simulation, output);
    drop_weaker_than(output.contact_threshold, lines);
    vtkNew<vtkPolyData> geometry;
    set_points(*geometry, 2 * lines.size(), simulation.model.mean_diameter,
        [&](std::size_t p) { return p % 2 == 0 ? lines[p / 2].from : lines[p / 2].to; });
    vtkNew<vtkCellArray> cells;
    for (vtkIdType first = 0; first < static_cast<vtkIdType>(2 * lines.size()); first += 2)
        cells->InsertNextCell({first, first + 1});
    geometry->SetLines(cells);
    add_contact_arrays(*geometry->GetCellData(), output.contact_arrays, lines);
    return geometry;
}

} // namespace

FrameWriter::FrameWriter(std::filesystem::path folder, OutputChoice output)
    : folder_(std::move(folder)), output_(std::move(output))
{
    std::error_code error;
    std::filesystem::create_directories(folder_ / "frames", error);
    if (error) throw OutputError(fmt::format("{}: cannot be made: {}", (folder_ / "frames").string(), error.message()));
}

void FrameWriter::write_particles(const Simulation& simulation)
{
    add_frame(particles_, simulation.state.time, *particles_of(simulation, output_));
}

void write_particles(const Simulation& simulation, const OutputChoice& output, const std::filesystem::path& file)
{
    write_atomically(file, vtp_bytes(*particles_of(simulation, output), simulation.state.time));
}

void FrameWriter::write_contacts(const Simulation& simulation)
{
    add_frame(contacts_, simulation.state.time, *contacts_of(simulation, output_));
}

void FrameWriter::write_walls(const Model& model, const State& state)
{
    add_walls_frame(walls_, model, state, false);
}

void FrameWriter::write_moving_walls(const Model& model, const State& state)
{
    add_walls_frame(moving_walls_, model, state, true);
}

void FrameWriter::add_walls_frame(Series& series, const Model& model, const State& state, bool moving)
{
    const auto placed = place_walls(model, state);
    std::vector<Vec3> vertices;
    std::vector<std::size_t> wall_of_triangle;
    vtkNew<vtkCellArray> cells;
    for (std::size_t wall = 0; wall < model.walls.size(); ++wall) {
        if (!placed[wall].stands() || placed[wall].moves() != moving) continue;
        const TriangleSoup surface = wall_surface(model.walls[wall].shape, model.contents);
        const Pose& pose = placed[wall].pose();
        const auto first = static_cast<vtkIdType>(vertices.size());
        for (const Vec3& vertex : surface.vertices) vertices.push_back(pose(vertex));
        for (const auto& [a, b, c] : surface.triangles) {
            cells->InsertNextCell({first + a, first + b, first + c});
            wall_of_triangle.push_back(wall);
        }
    }
    vtkNew<vtkPolyData> geometry;
    set_points(*geometry, vertices.size(), model.mean_diameter, [&](std::size_t v) { return vertices[v]; });
    geometry->SetPolys(cells);
    add_integers(
        *geometry->GetCellData(), "wall", wall_of_triangle.size(), [&](std::size_t k) { return wall_of_triangle[k]; });
    add_frame(series, state.time, *geometry);
}

void FrameWriter::add_frame(Series& series, double time, vtkPolyData& geometry)
{
    write_atomically(folder_ / frame_file(series.name, series.times.size()), vtp_bytes(geometry, time));
    series.times.push_back(time);
    write_list(series);
}

void FrameWriter::write_list(const Series& series) const
{
    std::vector<ListedFrame> list;
    for (std::size_t k = 0; k < series.times.size(); ++k) list.push_back({series.times[k], frame_file(series.name, k)});
    write_atomically(folder_ / (series.name + ".pvd"), frame_list(list));
}

void FrameWriter::cut_back() const
{
    for (const Series* series : {&particles_, &contacts_, &walls_, &moving_walls_}) cut_back(*series);
}

void FrameWriter::cut_back(const Series& series) const
{
    // the list first: at no time does it name a file that is not there
    std::error_code error;
    if (series.times.empty())
        std::filesystem::remove(folder_ / (series.name + ".pvd"), error);
    else
        write_list(series);
    for (std::size_t k = series.times.size(); std::filesystem::remove(folder_ / frame_file(series.name, k), error);)
        ++k;
    if (error) throw OutputError(fmt::format("{}: cannot be removed: {}", folder_.string(), error.message()));
}

std::vector<std::string> FrameWriter::damaged() const
{
    constexpr std::string_view end = "</VTKFile>";
    std::vector<std::string> names;
    for (const Series* series : {&particles_, &contacts_, &walls_, &moving_walls_})
        for (std::size_t k = 0; k < series->times.size(); ++k) {
            const std::string name = frame_file(series->name, k);
            std::ifstream file(folder_ / name, std::ios::binary);
            std::string last(end.size() + 1, '\0'); // and a line's end
            file.seekg(-static_cast<std::streamoff>(last.size()), std::ios::end);
            file.read(last.data(), static_cast<std::streamsize>(last.size()));
            if (!file || last.find(end) == std::string::npos) names.push_back(name);
        }
    return names;
}

bool has_64_bit_frames(const Model& model)
{
    const Box& box = model.contents;
    return needs_64_bits(std::max(-box.min.minCoeff(), box.max.maxCoeff()), model.mean_diameter);
}

void write_lost(const std::filesystem::path& folder, const std::vector<EscapedSphere>& escaped)
{
    const std::filesystem::path path = folder / "lost.vtp";
    if (escaped.empty()) {
        std::error_code none_there;
        std::filesystem::remove(path, none_there);
        return;
    }
    const std::size_t count = escaped.size();
    vtkNew<vtkPolyData> geometry;
    set_points(*geometry, count, 2.0 * escaped.front().radius, [&](std::size_t k) { return escaped[k].position; });
    add_point_cell(*geometry, count);
    vtkPointData& data = *geometry->GetPointData();
    add_integers(data, "id", count, [&](std::size_t k) { return escaped[k].id; });
    add_floats(data, "time", count, [&](std::size_t k) { return escaped[k].time; });
    add_floats(data, "radius", count, [&](std::size_t k) { return escaped[k].radius; });
    add_vectors(data, "velocity", count, [&](std::size_t k) { return escaped[k].velocity; });
    add_vectors(data, "angular_velocity", count, [&](std::size_t k) { return escaped[k].angular_velocity; });
    add_integers(data, "material", count, [&](std::size_t k) { return escaped[k].material; });
    add_integers(data, "last_wall", count, [&](std::size_t k) { return escaped[k].last_wall; });
    write_atomically(path, vtp_bytes(*geometry, escaped.back().time));
}

} // namespace talus
