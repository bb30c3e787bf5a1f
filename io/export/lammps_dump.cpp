// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/export/lammps_dump.hpp"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <fmt/format.h>

#include <functional>
#include <iterator>

namespace talus
{
namespace
{

using Text = fmt::memory_buffer;

/// One column or some that stand together: their names, and a row of them.
struct DumpColumn {
    std::string names;
    std::function<void(vtkIdType, Text&)> add;
};

/// @param margin by which the frame's points are surrounded [m]
void add_header(Text& text, vtkPolyData& frame, const RecordedRun& run, std::size_t number, double time,
    const char* what, vtkIdType count, double margin)
{
    if (number == 0) text.append(std::string_view("ITEM: UNITS\nsi\n"));
    fmt::format_to(std::back_inserter(text), "ITEM: TIME\n{}\nITEM: TIMESTEP\n{}\nITEM: NUMBER OF {}\n{}\n", time,
        number, what, count);
    std::string kinds, extents;
    for (int d = 0; d < 3; ++d) {
        std::array<double, 6> bounds = {0, 1, 0, 1, 0, 1};
        if (frame.GetNumberOfPoints() > 0) frame.GetPoints()->GetBounds(bounds.data());
        const bool periodic = run.periodic[static_cast<std::size_t>(d)];
        kinds += periodic ? " pp" : " ss";
        extents +=
            fmt::format("{:.9g} {:.9g}\n", periodic ? run.min[d] : bounds[static_cast<std::size_t>(2 * d)] - margin,
                periodic ? run.max[d] : bounds[static_cast<std::size_t>(2 * d + 1)] + margin);
    }
    fmt::format_to(std::back_inserter(text), "ITEM: BOX BOUNDS{}\n{}", kinds, extents);
}

DumpColumn whole_number(vtkDataArray& array, const std::string& name, int added)
{
    return {name, [&array, added](vtkIdType row, Text& text) {
                fmt::format_to(
                    std::back_inserter(text), " {}", static_cast<std::int64_t>(array.GetComponent(row, 0)) + added);
            }};
}

/// All components of an array, for row i those of its tuple i × stride + offset.
DumpColumn numbers(vtkDataArray& array, const std::string& names, vtkIdType stride = 1, vtkIdType offset = 0)
{
    return {names, [&array, stride, offset](vtkIdType row, Text& text) {
                for (int d = 0; d < array.GetNumberOfComponents(); ++d)
                    fmt::format_to(std::back_inserter(text), " {}",
                        static_cast<float>(array.GetComponent(row * stride + offset, d)));
            }};
}

void add_names(Text& text, const char* what, const std::vector<DumpColumn>& columns)
{
    fmt::format_to(std::back_inserter(text), "ITEM: {}", what);
    for (const DumpColumn& column : columns) fmt::format_to(std::back_inserter(text), " {}", column.names);
    text.push_back('\n');
}

void add_row(Text& text, const std::vector<DumpColumn>& columns, vtkIdType row)
{
    Text line;
    for (const DumpColumn& column : columns) column.add(row, line);
    text.append(line.begin() + 1, line.end()); // without the first blank
    text.push_back('\n');
}

/// What LAMMPS calls the arrays of our frames.
DumpColumn particle_column(vtkDataArray& array)
{
    const std::string name = array.GetName();
    if (name == "id") return whole_number(array, "id", 1);
    if (name == "material") return whole_number(array, "type", 1);
    if (name == "velocity") return numbers(array, "vx vy vz");
    if (name == "angular_velocity") return numbers(array, "omegax omegay omegaz");
    if (name == "force") return numbers(array, "fx fy fz");
    return numbers(array, name);
}

} // namespace

std::string dump_particles(vtkPolyData& frame, std::size_t number, double time, const RecordedRun& run)
{
    vtkPointData& data = *frame.GetPointData();
    std::vector<DumpColumn> columns;
    for (int k = 0; k < data.GetNumberOfArrays(); ++k)
        if (vtkDataArray* array = data.GetArray(k)) columns.push_back(particle_column(*array));
    columns.push_back(numbers(*frame.GetPoints()->GetData(), "x y z"));
    vtkDataArray* radius = data.GetArray("radius");
    const double largest = radius && frame.GetNumberOfPoints() > 0 ? radius->GetRange()[1] : 0.0;
    Text text;
    add_header(text, frame, run, number, time, "ATOMS", frame.GetNumberOfPoints(), largest);
    add_names(text, "ATOMS", columns);
    for (vtkIdType row = 0; row < frame.GetNumberOfPoints(); ++row) add_row(text, columns, row);
    return fmt::to_string(text);
}

std::string dump_contacts(vtkPolyData& frame, std::size_t number, double time, const RecordedRun& run, ContactsOf which)
{
    vtkCellData& data = *frame.GetCellData();
    const bool of_walls = which == ContactsOf::walls;
    vtkDataArray* wall = data.GetArray("wall");
    std::vector<DumpColumn> columns;
    if (vtkDataArray* id = data.GetArray("id_a")) columns.push_back(whole_number(*id, of_walls ? "atom" : "batom1", 1));
    if (vtkDataArray* id = data.GetArray("id_b"); id && !of_walls) columns.push_back(whole_number(*id, "batom2", 1));
    if (of_walls && wall) columns.push_back(whole_number(*wall, "wall", 0));
    if (vtkDataArray* force = data.GetArray("force")) columns.push_back(numbers(*force, "fx fy fz"));
    if (vtkDataArray* force = data.GetArray("normal_force")) columns.push_back(numbers(*force, "normal_force"));
    if (vtkDataArray* gap = data.GetArray("gap")) columns.push_back(numbers(*gap, "gap"));
    vtkDataArray& points = *frame.GetPoints()->GetData();
    columns.push_back(numbers(points, "x1 y1 z1", 2, 0));
    columns.push_back(numbers(points, "x2 y2 z2", 2, 1));

    std::vector<vtkIdType> rows;
    for (vtkIdType row = 0; row < frame.GetNumberOfLines(); ++row)
        if ((wall && wall->GetComponent(row, 0) >= 0.0) == of_walls) rows.push_back(row);
    Text text;
    add_header(text, frame, run, number, time, "ENTRIES", static_cast<vtkIdType>(rows.size()), 0.0);
    add_names(text, "ENTRIES", columns);
    for (const vtkIdType row : rows) add_row(text, columns, row);
    return fmt::to_string(text);
}

} // namespace talus
