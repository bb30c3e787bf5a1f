// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/export/csv_frame.hpp"

#include "io/run/run_files.hpp"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <fmt/format.h>

#include <functional>
#include <iterator>
#include <map>

namespace talus
{
namespace
{

/// Of the arrays of the frames (io/README.md); others have none.
const std::map<std::string, std::string> units = {{"radius", "m"}, {"velocity", "m/s"}, {"angular_velocity", "rad/s"},
    {"force", "N"}, {"normal_force", "N"}, {"gap", "m"}};

struct Column {
    std::string name;
    std::function<void(vtkIdType, fmt::memory_buffer&)> add; ///< the value in a row
};

/// A number with as many digits as tell it from its neighbours.
void add_number(fmt::memory_buffer& text, vtkDataArray& array, vtkIdType row, int component)
{
    const double value = array.GetComponent(row, component);
    if (array.GetDataType() == VTK_FLOAT)
        fmt::format_to(std::back_inserter(text), "{}", static_cast<float>(value));
    else
        fmt::format_to(std::back_inserter(text), "{}", value);
}

/// Columns for the components of an array, the vectors' with x, y, z in their names.
void add_columns(std::vector<Column>& columns, vtkDataArray& array, const std::string& name, const std::string& unit)
{
    const int components = array.GetNumberOfComponents();
    for (int d = 0; d < components; ++d) {
        const std::string component = components == 3 ? fmt::format("_{}", "xyz"[d]) : "";
        columns.push_back({column_name(name + component, unit),
            [&array, d](vtkIdType row, fmt::memory_buffer& text) { add_number(text, array, row, d); }});
    }
}

/// A column of names, for an array of their indices; an index without a name is shown as a number.
Column named_column(vtkDataArray& array, const std::string& name, const std::vector<std::string>& names)
{
    return {name, [&array, &names](vtkIdType row, fmt::memory_buffer& text) {
                const auto index = static_cast<std::int64_t>(array.GetComponent(row, 0));
                if (index >= 0 && index < static_cast<std::int64_t>(names.size()))
                    fmt::format_to(std::back_inserter(text), "{}", csv_field(names[static_cast<std::size_t>(index)]));
                else if (index >= 0)
                    fmt::format_to(std::back_inserter(text), "{}", index);
            }};
}

void add_arrays(std::vector<Column>& columns, vtkDataSetAttributes& data, const RecordedRun& run)
{
    for (int k = 0; k < data.GetNumberOfArrays(); ++k) {
        vtkDataArray* array = data.GetArray(k);
        if (!array || !array->GetName()) continue;
        const std::string name = array->GetName();
        const auto unit = units.find(name);
        if (name == "material")
            columns.push_back(named_column(*array, name, run.materials));
        else if (name == "wall")
            columns.push_back(named_column(*array, name, run.walls));
        else
            add_columns(columns, *array, name, unit == units.end() ? "" : unit->second);
    }
}

/// The ends of a contact's line.
void add_ends(std::vector<Column>& columns, vtkPolyData& frame)
{
    for (const int end : {0, 1})
        for (int d = 0; d < 3; ++d)
            columns.push_back({column_name(fmt::format("{}_{}", end == 0 ? "from" : "to", "xyz"[d]), "m"),
                [&frame, end, d](vtkIdType row, fmt::memory_buffer& text) {
                    add_number(text, *frame.GetPoints()->GetData(), 2 * row + end, d);
                }});
}

std::vector<Column> time_column(double time)
{
    return {{column_name("time", "s"),
        [time](vtkIdType, fmt::memory_buffer& text) { fmt::format_to(std::back_inserter(text), "{}", time); }}};
}

std::string table(const std::vector<Column>& columns, vtkIdType rows)
{
    fmt::memory_buffer text;
    const auto add_line = [&](auto&& add) {
        for (std::size_t k = 0; k < columns.size(); ++k) {
            if (k > 0) text.push_back(',');
            add(columns[k]);
        }
        text.push_back('\n');
    };
    add_line([&](const Column& column) { text.append(column.name); });
    for (vtkIdType row = 0; row < rows; ++row) add_line([&](const Column& column) { column.add(row, text); });
    return fmt::to_string(text);
}

} // namespace

std::string csv_spheres(vtkPolyData& frame, double time, const RecordedRun& run)
{
    std::vector<Column> columns = time_column(time);
    add_columns(columns, *frame.GetPoints()->GetData(), "position", "m");
    add_arrays(columns, *frame.GetPointData(), run);
    return table(columns, frame.GetNumberOfPoints());
}

std::string csv_contacts(vtkPolyData& frame, double time, const RecordedRun& run)
{
    std::vector<Column> columns = time_column(time);
    add_ends(columns, frame);
    add_arrays(columns, *frame.GetCellData(), run);
    return table(columns, frame.GetNumberOfLines());
}

} // namespace talus
