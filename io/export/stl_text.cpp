// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/export/stl_text.hpp"

#include "core/world/wall.hpp"

#include <vtkCellArray.h>
#include <vtkPolyData.h>

#include <fmt/format.h>

#include <iterator>

namespace talus
{

std::string stl_text(const TriangleSoup& soup)
{
    fmt::memory_buffer text;
    const auto add = [&](const char* words, const Vec3& v) {
        fmt::format_to(std::back_inserter(text), "{} {:.9g} {:.9g} {:.9g}\n", words, v.x(), v.y(), v.z());
    };
    text.append(std::string_view("solid walls\n"));
    for (const auto& triangle : soup.triangles) {
        if (!has_area(soup.vertices, triangle)) continue;
        std::array<Vec3, 3> corner;
        for (std::size_t k = 0; k < 3; ++k) corner[k] = soup.vertices[static_cast<std::size_t>(triangle[k])];
        add("facet normal", (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized());
        text.append(std::string_view(" outer loop\n"));
        for (const Vec3& vertex : corner) add("  vertex", vertex);
        text.append(std::string_view(" endloop\nendfacet\n"));
    }
    text.append(std::string_view("endsolid walls\n"));
    return fmt::to_string(text);
}

std::string stl_text(vtkPolyData& walls)
{
    TriangleSoup soup;
    for (vtkIdType point = 0; point < walls.GetNumberOfPoints(); ++point) {
        Vec3 vertex;
        walls.GetPoint(point, vertex.data());
        soup.vertices.push_back(vertex);
    }
    vtkIdType count = 0;
    const vtkIdType* points = nullptr;
    vtkCellArray& cells = *walls.GetPolys();
    for (cells.InitTraversal(); cells.GetNextCell(count, points);)
        soup.triangles.push_back({static_cast<std::int32_t>(points[0]), static_cast<std::int32_t>(points[1]),
            static_cast<std::int32_t>(points[2])});
    return stl_text(soup);
}

} // namespace talus
