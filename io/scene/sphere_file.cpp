// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/sphere_file.hpp"

#include "io/scene/vtk_file.hpp"
#include "io/text/csv.hpp"
#include "io/text/input_error.hpp"

#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>

namespace talus
{

namespace
{

/// What a file lists, with the ids by which it is to be ordered, if it has any.
struct ListedSpheres {
    scene::SphereList spheres;
    std::vector<double> ids;
};

template <class Element> void reorder(std::vector<Element>& list, const std::vector<std::size_t>& order)
{
    if (list.empty()) return;
    std::vector<Element> ordered;
    for (const std::size_t i : order) ordered.push_back(list[i]);
    list = std::move(ordered);
}

scene::SphereList in_order_of_ids(ListedSpheres listed)
{
    if (listed.ids.empty()) return std::move(listed.spheres);
    std::vector<std::size_t> order(listed.ids.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return listed.ids[i]; });
    reorder(listed.spheres.positions, order);
    reorder(listed.spheres.radii, order);
    reorder(listed.spheres.velocities, order);
    reorder(listed.spheres.angular_velocities, order);
    return std::move(listed.spheres);
}

/// The arrays of a VTK file, by name.
class PointArrays
{
public:
    PointArrays(std::string file, vtkPointSet& points) : file_(std::move(file)), points_(points) {}

    std::vector<double> numbers(const char* name) const
    {
        std::vector<double> list;
        vtkDataArray* array = find(name, 1);
        for (vtkIdType i = 0; array && i < count(); ++i) list.push_back(finite(array->GetComponent(i, 0), name, i));
        return list;
    }

    std::vector<Vec3> vectors(const char* name) const
    {
        vtkDataArray* array = find(name, 3);
        return array ? vectors_of(*array, name) : std::vector<Vec3>();
    }

    std::vector<Vec3> positions() const { return vectors_of(*points_.GetPoints()->GetData(), "position"); }

    [[noreturn]] void refuse(const std::string& sentence) const
    {
        throw InputError(fmt::format("{}: {}", file_, sentence));
    }

private:
    std::string file_;
    vtkPointSet& points_;

    vtkIdType count() const { return points_.GetNumberOfPoints(); }

    /// The array of this name, whatever its capitals; null where there is none.
    vtkDataArray* find(std::string_view name, int components) const
    {
        const auto lower = [](unsigned char c) { return std::tolower(c); };
        vtkPointData& data = *points_.GetPointData();
        for (int k = 0; k < data.GetNumberOfArrays(); ++k) {
            vtkDataArray* array = data.GetArray(k);
            if (!array || !array->GetName() || !std::ranges::equal(std::string_view(array->GetName()), name, {}, lower))
                continue;
            if (array->GetNumberOfComponents() != components || array->GetNumberOfTuples() != count())
                refuse(fmt::format("array '{}' must have {} numbers for each of the {} points, not {} for {}", name,
                    components, count(), array->GetNumberOfComponents(), array->GetNumberOfTuples()));
            return array;
        }
        return nullptr;
    }

    std::vector<Vec3> vectors_of(vtkDataArray& array, const char* name) const
    {
        std::vector<Vec3> list;
        for (vtkIdType i = 0; i < count(); ++i) {
            Vec3 vector;
            for (int d = 0; d < 3; ++d) vector[d] = finite(array.GetComponent(i, d), name, i);
            list.push_back(vector);
        }
        return list;
    }

    double finite(double number, const char* name, vtkIdType point) const
    {
        if (!std::isfinite(number)) refuse(fmt::format("the {} of point {} is not a finite number", name, point));
        return number;
    }
};

ListedSpheres read_vtk(const std::filesystem::path& path)
{
    vtkSmartPointer<vtkPointSet> points;
    if (path.extension() == ".vtp")
        points = read_vtk_file<vtkXMLPolyDataReader>(path, "a VTK file");
    else
        points = read_vtk_file<vtkXMLUnstructuredGridReader>(path, "a VTK file");
    const PointArrays arrays(path.string(), *points);
    if (points->GetNumberOfPoints() == 0) arrays.refuse("it has no points");
    ListedSpheres listed;
    listed.spheres.positions = arrays.positions();
    listed.spheres.radii = arrays.numbers("radius");
    const auto diameters = arrays.numbers("diameter");
    if (listed.spheres.radii.empty())
        for (const double diameter : diameters) listed.spheres.radii.push_back(0.5 * diameter);
    for (std::size_t i = 0; i < listed.spheres.radii.size(); ++i)
        if (!(listed.spheres.radii[i] > 0.0)) arrays.refuse(fmt::format("the radius of point {} must be above 0", i));
    listed.spheres.velocities = arrays.vectors("velocity");
    listed.spheres.angular_velocities = arrays.vectors("angular_velocity");
    listed.ids = arrays.numbers("id");
    return listed;
}

/// The vectors of three columns; none where the first of them is missing.
std::vector<Vec3> vectors_of(const CsvTable& table, const std::array<const char*, 3>& names)
{
    std::array<int, 3> columns{};
    for (std::size_t d = 0; d < 3; ++d) columns[d] = table.column(names[d]);
    const auto missing = std::ranges::count(columns, -1);
    if (missing == 3) return {};
    if (missing > 0)
        table.refuse_header(fmt::format("of '{}', '{}' and '{}' all must be there", names[0], names[1], names[2]));
    std::vector<Vec3> list;
    for (std::size_t i = 0; i < table.row_count(); ++i)
        list.emplace_back(table.value(i, columns[0]), table.value(i, columns[1]), table.value(i, columns[2]));
    return list;
}

std::vector<double> radii_of(const CsvTable& table)
{
    const int radius = table.column("radius"), diameter = table.column("diameter");
    if (radius >= 0 && diameter >= 0) table.refuse_header("'radius' or 'diameter', not both");
    std::vector<double> radii;
    for (std::size_t i = 0; std::max(radius, diameter) >= 0 && i < table.row_count(); ++i) {
        radii.push_back(radius >= 0 ? table.value(i, radius) : 0.5 * table.value(i, diameter));
        if (!(radii.back() > 0.0))
            table.refuse_row(i, fmt::format("the {} must be above 0", radius >= 0 ? "radius" : "diameter"));
    }
    return radii;
}

ListedSpheres read_csv(const std::filesystem::path& path)
{
    const CsvTable table(path, {"id", "x", "y", "z", "radius", "diameter", "vx", "vy", "vz", "wx", "wy", "wz"});
    ListedSpheres listed;
    listed.spheres.positions = vectors_of(table, {"x", "y", "z"});
    if (listed.spheres.positions.empty()) table.refuse_header("the columns 'x', 'y' and 'z' are wanted");
    listed.spheres.radii = radii_of(table);
    listed.spheres.velocities = vectors_of(table, {"vx", "vy", "vz"});
    listed.spheres.angular_velocities = vectors_of(table, {"wx", "wy", "wz"});
    const int id = table.column("id");
    for (std::size_t i = 0; id >= 0 && i < table.row_count(); ++i) listed.ids.push_back(table.value(i, id));
    return listed;
}

} // namespace

scene::SphereList read_spheres(const std::filesystem::path& path)
{
    const auto extension = path.extension();
    if (extension == ".csv") return in_order_of_ids(read_csv(path));
    if (extension == ".vtp" || extension == ".vtu") return in_order_of_ids(read_vtk(path));
    throw InputError(fmt::format("{}: spheres are read from .vtp, .vtu and .csv files", path.string()));
}

} // namespace talus
