// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/sphere_file.hpp"

#include "io/scene/lammps_file.hpp"
#include "io/scene/sphere_columns.hpp"
#include "io/scene/vtk_file.hpp"
#include "io/text/csv.hpp"
#include "io/text/input_error.hpp"

#include <vtkDataArray.h>
#include <vtkGenericDataObjectReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <fmt/format.h>

#include <cmath>
#include <memory>

namespace talus
{

namespace
{

vtkSmartPointer<vtkPointSet> read_points(const std::filesystem::path& path)
{
    if (path.extension() == ".vtp") return read_vtk_file<vtkXMLPolyDataReader>(path, "a VTK file");
    if (path.extension() == ".vtu") return read_vtk_file<vtkXMLUnstructuredGridReader>(path, "a VTK file");
    const auto data = read_vtk_file<vtkGenericDataObjectReader>(path, "a VTK file");
    vtkSmartPointer<vtkPointSet> points = vtkPointSet::SafeDownCast(data);
    if (!points || !points->GetPoints()) throw InputError(fmt::format("{}: it has no points", path.string()));
    return points;
}

/// The point data of a VTK file, component by component.
class PointColumns
{
public:
    PointColumns(const std::filesystem::path& path, std::vector<std::string>& names)
        : file_(path.string()), points_(read_points(path))
    {
        if (points_->GetNumberOfPoints() == 0) refuse("it has no points");
        add(*points_->GetPoints()->GetData(), "position", {"x", "y", "z"}, names);
        vtkPointData& data = *points_->GetPointData();
        for (int k = 0; k < data.GetNumberOfArrays(); ++k) {
            vtkDataArray* array = data.GetArray(k);
            if (!array || !array->GetName()) continue;
            const std::string name = array->GetName();
            const int components = array->GetNumberOfComponents();
            require(*array, name, is_vector_of_spheres(name) ? 3 : is_number_of_spheres(name) ? 1 : components);
            std::vector<std::string> parts;
            for (int d = 0; d < components; ++d)
                parts.push_back(components == 1   ? name
                                : components == 3 ? fmt::format("{}_{}", name, "xyz"[d])
                                                  : fmt::format("{}_{}", name, d));
            add(*array, name, parts, names);
        }
    }

    std::size_t rows() const { return static_cast<std::size_t>(points_->GetNumberOfPoints()); }

    double number(std::size_t row, std::size_t column) const
    {
        const auto& [array, component, name] = columns_[column];
        const double value = array->GetComponent(static_cast<vtkIdType>(row), component);
        if (!std::isfinite(value)) refuse(fmt::format("the {} of point {} is not a finite number", name, row));
        return value;
    }

    [[noreturn]] void refuse(const std::string& sentence) const
    {
        throw InputError(fmt::format("{}: {}", file_, sentence));
    }

private:
    struct Column {
        vtkDataArray* array;
        int component;
        std::string name; ///< of the array
    };
    std::string file_;
    vtkSmartPointer<vtkPointSet> points_;
    std::vector<Column> columns_;

    void require(vtkDataArray& array, const std::string& name, int components) const
    {
        if (array.GetNumberOfComponents() != components || array.GetNumberOfTuples() != points_->GetNumberOfPoints())
            refuse(fmt::format("array '{}' must have {} numbers for each of the {} points, not {} for {}", name,
                components, points_->GetNumberOfPoints(), array.GetNumberOfComponents(), array.GetNumberOfTuples()));
    }

    void add(vtkDataArray& array, const std::string& name, const std::vector<std::string>& parts,
        std::vector<std::string>& names)
    {
        for (std::size_t d = 0; d < parts.size(); ++d) {
            columns_.push_back({&array, static_cast<int>(d), name});
            names.push_back(parts[d]);
        }
    }
};

SphereColumns read_vtk(const std::filesystem::path& path)
{
    SphereColumns columns;
    const auto points = std::make_shared<const PointColumns>(path, columns.names);
    columns.rows = points->rows();
    columns.number = [points](std::size_t row, std::size_t column) { return points->number(row, column); };
    columns.text = [points](
                       std::size_t row, std::size_t column) { return fmt::format("{}", points->number(row, column)); };
    columns.refuse_row = [points](std::size_t row, const std::string& sentence) {
        points->refuse(fmt::format("point {}: {}", row, sentence));
    };
    columns.refuse = [points](const std::string& sentence) { points->refuse(sentence); };
    return columns;
}

SphereColumns read_csv(const std::filesystem::path& path)
{
    const auto table = std::make_shared<const CsvTable>(path);
    return {.names = table->names(),
        .rows = table->row_count(),
        .number = [table](std::size_t row, std::size_t column) { return table->value(row, static_cast<int>(column)); },
        .text = [table](std::size_t row,
                    std::size_t column) { return std::string(table->text(row, static_cast<int>(column))); },
        .refuse_row = [table](std::size_t row, const std::string& sentence) { table->refuse_row(row, sentence); },
        .refuse = [table](const std::string& sentence) { table->refuse_header(sentence); }};
}

} // namespace

scene::SphereList read_spheres(const std::filesystem::path& path, const std::vector<std::string>& materials)
{
    const auto extension = path.extension();
    if (extension == ".csv" || extension == ".txt") return spheres_of(read_csv(path), materials);
    if (extension == ".vtp" || extension == ".vtu" || extension == ".vtk") return spheres_of(read_vtk(path), materials);
    for (const char* of_lammps : {".dump", ".lammpstrj", ".data", ".lammps"})
        if (extension == of_lammps) return spheres_of(read_lammps(path), materials);
    throw InputError(fmt::format("{}: spheres are read from .csv, .txt, .vtp, .vtu and .vtk files, and from LAMMPS's "
                                 ".dump, .lammpstrj and .data",
        path.string()));
}

} // namespace talus
