// SPDX-License-Identifier: GPL-3.0-or-later
#include "flat_mesh.hpp"

#include "core/base/region.hpp"
#include "tests/support/mesh_cell.hpp"

#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace talus::test
{
namespace
{

template <class Change> Mesh changed(const Mesh& mesh, Change change)
{
    std::vector<Vec3> vertices;
    for (const Vec3& x : mesh.vertices) vertices.push_back(change(x));
    return make_mesh(vertices, mesh.triangles);
}

} // namespace

Mesh make_flat_mesh(const FlatMesh& strip)
{
    const double c = strip.cell * std::cos(strip.angle), s = strip.cell * std::sin(strip.angle);
    const auto place = [&](double i, double j) { return Vec3(c * i - s * j, s * i + c * j, 0.0); };
    Random random(1);
    std::map<std::pair<int, int>, std::int32_t> index;
    std::vector<Vec3> vertices;
    const auto corner = [&](int i, int j) {
        const auto [known, is_new] = index.try_emplace({i, j}, static_cast<std::int32_t>(vertices.size()));
        if (is_new) {
            const double shift_i = strip.jitter * (2 * uniform(random) - 1);
            vertices.push_back(place(i + shift_i, j + strip.jitter * (2 * uniform(random) - 1)));
        }
        return known->second;
    };
    std::vector<std::array<std::int32_t, 3>> triangles;
    const int reach = static_cast<int>(std::hypot(strip.length, strip.width) / strip.cell) + 2;
    for (int i = -reach; i < reach; ++i)
        for (int j = -reach; j < reach; ++j) {
            const Vec3 middle = place(i + 0.5, j + 0.5);
            if (std::abs(middle.x()) > 0.5 * strip.length || std::abs(middle.y()) > 0.5 * strip.width) continue;
            add_cell(triangles, {corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)},
                strip.diagonals, i, j);
        }
    return make_mesh(vertices, triangles);
}

Mesh turned(const Mesh& mesh, const Eigen::Matrix3d& turn)
{
    return changed(mesh, [&](const Vec3& x) { return Vec3(turn * x); });
}

Mesh as_in_stl(const Mesh& mesh)
{
    return changed(mesh, [](const Vec3& x) { return Vec3(x.cast<float>().cast<double>()); });
}

std::size_t edge_count(const Mesh& mesh)
{
    std::set<std::pair<std::int32_t, std::int32_t>> edges;
    for (const auto& t : mesh.triangles)
        for (int k = 0; k < 3; ++k) edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
    return edges.size();
}

} // namespace talus::test
