// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/python/built.hpp"

#include "app/python/arrays.hpp"
#include "io/export/export_folder.hpp"
#include "io/export/stl_text.hpp"
#include "io/run/wall_surface.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>

namespace talus::python
{
namespace
{

namespace fs = std::filesystem;
namespace py = pybind11;
using py::literals::operator""_a;

/// Triples of numbers as rows.
template <class Number, class Triple> py::array_t<Number> rows_of(const std::vector<Triple>& triples)
{
    py::array_t<Number> rows({static_cast<py::ssize_t>(triples.size()), py::ssize_t{3}});
    Number* out = rows.mutable_data();
    for (const Triple& triple : triples) out = std::copy(triple.begin(), triple.end(), out);
    return rows;
}

py::array_t<double> rows_of(const Box& box)
{
    return rows_of<double>(std::vector<Vec3>{box.min, box.max});
}

py::dict built_wall(const Wall& wall, const Box& contents)
{
    const auto* grains = std::get_if<Grains>(&wall.shape);
    const TriangleSoup soup = grains ? TriangleSoup{grains->centers, {}} : wall_surface(wall.shape, contents);
    const Pose pose = pose_at(wall.motion, wall.appear_at);
    const auto& r = pose.rotation;
    return py::dict("corners"_a = rows_of<double>(soup.vertices), "triangles"_a = rows_of<std::int32_t>(soup.triangles),
        "rotation"_a = rows_of<double>(std::vector<Vec3>{r.row(0), r.row(1), r.row(2)}),
        "shift"_a = array_from(pose.shift));
}

py::dict built_species(const Species& species, std::size_t draws)
{
    Random random(1); // the same every time
    std::vector<double> drawn(draws);
    for (double& diameter : drawn) diameter = species.diameter.draw(random);
    std::ranges::sort(drawn);
    return py::dict("number"_a = species.number, "mean_volume"_a = species.diameter.mean_volume(), "drawn"_a = drawn);
}

} // namespace

py::dict built_scene(Session& session, std::size_t draws)
{
    const Simulation& simulation = session.now();
    const Model& model = simulation.model;
    py::list walls, pours;
    for (const Wall& wall : model.walls) walls.append(built_wall(wall, model.contents));
    for (const Pour& pour : simulation.pours) {
        py::list mixture;
        for (const Species& species : pour.mixture.species) mixture.append(built_species(species, draws));
        pours.append(mixture);
    }
    const auto materials = static_cast<py::ssize_t>(model.materials.list.size());
    py::array_t<double> moduli({materials, materials});
    std::ranges::transform(model.materials.laws, moduli.mutable_data(), &ContactLaw::modulus);
    return py::dict("moduli"_a = moduli,
        "diameters"_a = py::make_tuple(model.min_diameter, model.mean_diameter, model.max_diameter),
        "contents"_a = rows_of(model.contents), "world"_a = rows_of(model.world), "walls"_a = walls, "pours"_a = pours);
}

void bind_export(py::module_& module)
{
    py::class_<ExportFolder>(module, "_ExportFolder")
        .def(py::init<fs::path, const std::string&, std::vector<std::string>, bool>())
        .def("write", &ExportFolder::write);
    using Corner = std::array<double, 3>;
    using Triangle = std::array<std::int32_t, 3>;
    module.def("_stl_text", [](const std::vector<Corner>& corners, const std::vector<Triangle>& triangles) {
        TriangleSoup soup{{}, triangles};
        for (const Corner& corner : corners) soup.vertices.emplace_back(corner.data());
        return stl_text(soup);
    });
}

} // namespace talus::python
