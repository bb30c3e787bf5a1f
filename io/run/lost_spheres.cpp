// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/lost_spheres.hpp"

#include "io/run/poly_data.hpp"
#include "io/run/run_files.hpp"

#include <vtkPointData.h>
#include <vtkPolyData.h>

namespace talus
{

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
    set_points(*geometry, count, [&](std::size_t k) { return escaped[k].position; });
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
