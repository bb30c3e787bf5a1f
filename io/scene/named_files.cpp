// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/scene_file.hpp"

#include "io/scene/sieve_file.hpp"
#include "io/scene/sphere_file.hpp"
#include "io/scene/stl.hpp"
#include "io/text/field_kind.hpp"
#include "io/text/input_error.hpp"
#include "io/text/input_file.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace talus
{

namespace
{

/// What `read` makes of the file that a key names. Its path, relative to the scene's folder, becomes absolute, so that
/// the resolved scene can be read from any folder.
/// @param owner in the sentence of an error, which begins with the place of the key: "wall 'gate': "
auto read_named_file(
    const SceneFile& file, const std::string& key, std::string& path, auto&& read, const std::string& owner = "")
{
    path = (std::filesystem::absolute(file.path).parent_path() / path).lexically_normal().string();
    try {
        return read(path);
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}{}", file.place_of(key), owner, error.what()));
    }
}

/// Reads the mesh of a wall or region, and brings it to metres and into place.
void read_mesh(const SceneFile& file, const std::string& key, auto& table, const std::string& owner = "")
{
    if (table.shape != "mesh" || table.mesh.empty()) return;
    TriangleSoup soup = read_named_file(file, key + ".mesh", table.mesh, read_stl, owner);
    for (Vec3& vertex : soup.vertices) vertex = table.scale * vertex + table.translate;
    table.vertices = std::move(soup.vertices);
    table.triangles = std::move(soup.triangles);
}

/// Reads the spheres of a fill, and brings them to metres and into place.
void read_fill(const SceneFile& file, const std::string& key, scene::FillTable& fill)
{
    std::vector<std::string> materials;
    for (const auto& material : file.scene.materials) materials.push_back(material.name);
    fill.spheres = read_named_file(
        file, key + ".file", fill.file, [&](const std::string& path) { return read_spheres(path, materials); });
    for (Vec3& position : fill.spheres.positions) position = fill.scale * position + fill.translate;
    for (double& radius : fill.spheres.radii) radius *= fill.scale;
    for (Vec3& velocity : fill.spheres.velocities) velocity *= fill.scale;
}

/// Reads the sieve analysis of diameters that have one.
void read_analysis(const SceneFile& file, const std::string& key, scene::DiameterTable& diameter)
{
    if (diameter.distribution != "sieve") return;
    SieveAnalysis analysis = read_named_file(file, key + ".file", diameter.file, read_sieves);
    diameter.sieve_sizes = std::move(analysis.sizes);
    diameter.sieve_passing = std::move(analysis.passing);
}

/// The sieve analyses of a fill or a pour.
void read_analyses(const SceneFile& file, const std::string& key, auto& table)
{
    read_analysis(file, key + ".diameter", table.diameter);
    for (std::size_t k = 0; k < table.species.size(); ++k)
        read_analysis(file, fmt::format("{}.species[{}].diameter", key, k), table.species[k].diameter);
}

/// Calls visit(path) for each key of a scene that names a file.
template <class Visit> struct FileKeys {
    Visit visit;

    void walk(std::string_view, auto&) const {}
    void walk(std::string_view key, std::string& value) const
    {
        if ((key == "mesh" || key == "file") && !value.empty()) visit(value);
    }
    template <Table Described> void walk(std::string_view, std::vector<Described>& list) const
    {
        for (Described& element : list) walk("", element);
    }
    template <Table Described> void walk(std::string_view, Described& table) const
    {
        Described::describe(table, [&](std::string_view name, auto& field, auto&&...) { walk(name, field); });
    }
};

template <class Visit> void for_each_file_key(scene::Scene& scene, Visit visit)
{
    FileKeys<Visit>{visit}.walk("", scene);
}

/// "files/cup.stl" for a path that ends so, with a number before the name if that is taken.
std::string name_of_copy(const std::string& path, const std::vector<NamedFile>& taken)
{
    const std::string name = std::filesystem::path(path).filename().string();
    std::string copy = fmt::format("files/{}", name);
    for (int n = 2; std::ranges::find(taken, copy, &NamedFile::copy) != taken.end(); ++n)
        copy = fmt::format("files/{}_{}", n, name);
    return copy;
}

} // namespace

void read_named_files(SceneFile& file)
{
    scene::Scene& scene = file.scene;
    for (std::size_t i = 0; i < scene.wall.size(); ++i)
        read_mesh(file, fmt::format("wall[{}]", i), scene.wall[i], fmt::format("wall '{}': ", scene.wall[i].name));
    for (std::size_t i = 0; i < scene.fill.size(); ++i) {
        const std::string key = fmt::format("fill[{}]", i);
        scene::FillTable& fill = scene.fill[i];
        read_analyses(file, key, fill);
        read_mesh(file, key + ".region", fill.region);
        for (std::size_t k = 0; k < fill.except.size(); ++k)
            read_mesh(file, fmt::format("{}.except[{}]", key, k), fill.except[k]);
        if (fill.arrangement == "file") read_fill(file, key, fill);
    }
    for (std::size_t i = 0; i < scene.pour.size(); ++i) {
        read_analyses(file, fmt::format("pour[{}]", i), scene.pour[i]);
        read_mesh(file, fmt::format("pour[{}].region", i), scene.pour[i].region);
    }
    for (std::size_t i = 0; i < scene.outlet.size(); ++i)
        read_mesh(file, fmt::format("outlet[{}].region", i), scene.outlet[i].region);
    read_mesh(file, "output.region", scene.output.region);
}

std::vector<NamedFile> named_files(scene::Scene scene)
{
    std::vector<NamedFile> files;
    for_each_file_key(scene, [&](const std::string& path) {
        if (std::ranges::find(files, path, &NamedFile::path) == files.end())
            files.push_back({path, name_of_copy(path, files), checksum(read_bytes(path, "a file"))});
    });
    return files;
}

scene::Scene with_copies(scene::Scene scene, const std::vector<NamedFile>& files)
{
    for_each_file_key(scene, [&](std::string& path) { path = std::ranges::find(files, path, &NamedFile::path)->copy; });
    return scene;
}

} // namespace talus
