// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/frames.hpp"

#include "io/input_error.hpp"
#include "io/poly_data.hpp"
#include "io/run_files.hpp"
#include "io/wall_surface.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <fmt/format.h>

#include <algorithm>
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

std::vector<std::size_t> order_by_id(const State& state)
{
    std::vector<std::size_t> order(state.count());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return state.id[i]; });
    return order;
}

/// Calls use(contact, geometry) for each contact of the step that has an impulse.
/// @param first_of_tile where the contacts of each tile begin
void for_each_loaded(const ContactArrays& contacts, const std::vector<std::uint32_t>& first_of_tile, auto&& use)
{
    for (std::size_t tile = 0; tile < contacts.count.size(); ++tile)
        for (std::size_t k = first_of_tile[tile]; k < first_of_tile[tile] + contacts.count[tile]; ++k)
            if (!contacts.contact[k].impulse.isZero(0.0)) use(contacts.contact[k], contacts.geometry[k]);
}

std::vector<ContactLine> loaded_contacts(const Simulation& simulation)
{
    const State& state = simulation.state;
    const ContactNetwork& network = simulation.contacts;
    const double h = simulation.model.time_step;
    std::vector<ContactLine> lines;
    for_each_loaded(network.sphere_contacts, network.pairs_of_tile, [&](const Contact& c, const ContactGeometry& g) {
        lines.push_back({state.position[c.a], state.position[c.b], c.impulse / h, c.impulse.dot(c.normal) / h, g.gap,
            state.id[c.a], state.id[c.b], -1});
    });
    for_each_loaded(network.wall_contacts, network.wall_slots_of_tile, [&](const Contact& c, const ContactGeometry& g) {
        const Vec3 touching = state.position[c.a] - (state.radius(c.a) + g.gap) * c.normal;
        lines.push_back(
            {state.position[c.a], touching, c.impulse / h, c.impulse.dot(c.normal) / h, g.gap, state.id[c.a], -1, c.b});
    });
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

} // namespace

FrameWriter::FrameWriter(std::filesystem::path folder) : folder_(std::move(folder))
{
    std::error_code error;
    std::filesystem::create_directories(folder_ / "frames", error);
    if (error) throw OutputError(fmt::format("{}: cannot be made: {}", (folder_ / "frames").string(), error.message()));
}

void FrameWriter::write_particles(const State& state)
{
    const std::vector<std::size_t> order = order_by_id(state);
    const std::size_t count = order.size();
    vtkNew<vtkPolyData> geometry;
    set_points(*geometry, count, [&](std::size_t k) { return state.position[order[k]]; });
    add_point_cell(*geometry, count);

    vtkPointData& data = *geometry->GetPointData();
    add_integers(data, "id", count, [&](std::size_t k) { return state.id[order[k]]; });
    add_floats(data, "radius", count, [&](std::size_t k) { return state.radius(order[k]); });
    add_vectors(data, "velocity", count, [&](std::size_t k) { return state.motion[order[k]].velocity; });
    add_vectors(data, "angular_velocity", count, [&](std::size_t k) { return state.angular_velocity(order[k]); });
    add_integers(data, "material", count, [&](std::size_t k) { return state.material[order[k]]; });
    add_frame(particles_, state.time, *geometry);
}

void FrameWriter::write_contacts(const Simulation& simulation, double threshold)
{
    std::vector<ContactLine> lines = loaded_contacts(simulation);
    drop_weaker_than(threshold, lines);
    const std::size_t count = lines.size();
    vtkNew<vtkPolyData> geometry;
    set_points(*geometry, 2 * count, [&](std::size_t p) { return p % 2 == 0 ? lines[p / 2].from : lines[p / 2].to; });
    vtkNew<vtkCellArray> cells;
    for (vtkIdType first = 0; first < static_cast<vtkIdType>(2 * count); first += 2)
        cells->InsertNextCell({first, first + 1});
    geometry->SetLines(cells);

    vtkCellData& data = *geometry->GetCellData();
    add_vectors(data, "force", count, [&](std::size_t k) { return lines[k].force; });
    add_floats(data, "normal_force", count, [&](std::size_t k) { return lines[k].normal_force; });
    add_floats(data, "gap", count, [&](std::size_t k) { return lines[k].gap; });
    add_integers(data, "id_a", count, [&](std::size_t k) { return lines[k].id_a; });
    add_integers(data, "id_b", count, [&](std::size_t k) { return lines[k].id_b; });
    add_integers(data, "wall", count, [&](std::size_t k) { return lines[k].wall; });
    add_frame(contacts_, simulation.state.time, *geometry);
}

void FrameWriter::write_walls(const Model& model, double time)
{
    std::vector<Vec3> vertices;
    std::vector<std::size_t> wall_of_triangle;
    vtkNew<vtkCellArray> cells;
    for (std::size_t wall = 0; wall < model.walls.size(); ++wall) {
        if (!model.walls[wall].stands_at(time)) continue;
        const TriangleSoup surface = wall_surface(model.walls[wall].shape, model.world);
        const auto first = static_cast<vtkIdType>(vertices.size());
        vertices.insert(vertices.end(), surface.vertices.begin(), surface.vertices.end());
        for (const auto& [a, b, c] : surface.triangles) {
            cells->InsertNextCell({first + a, first + b, first + c});
            wall_of_triangle.push_back(wall);
        }
    }
    vtkNew<vtkPolyData> geometry;
    set_points(*geometry, vertices.size(), [&](std::size_t v) { return vertices[v]; });
    geometry->SetPolys(cells);
    add_integers(
        *geometry->GetCellData(), "wall", wall_of_triangle.size(), [&](std::size_t k) { return wall_of_triangle[k]; });
    add_frame(walls_, time, *geometry);
}

void FrameWriter::add_frame(Series& series, double time, vtkPolyData& geometry)
{
    write_atomically(folder_ / frame_file(series.name, series.times.size()), vtp_bytes(geometry, time));
    series.times.push_back(time);
    write_list(series);
}

void FrameWriter::write_list(const Series& series) const
{
    std::string list = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
    for (std::size_t k = 0; k < series.times.size(); ++k)
        list += fmt::format(
            "    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", series.times[k], frame_file(series.name, k));
    list += "  </Collection>\n</VTKFile>\n";
    write_atomically(folder_ / (series.name + ".pvd"), list);
}

void FrameWriter::cut_back() const
{
    for (const Series* series : {&particles_, &contacts_, &walls_}) cut_back(*series);
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

} // namespace talus
