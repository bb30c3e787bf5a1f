// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/scene_file.hpp"

#include "io/scene/overrides.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/scene/sieve_file.hpp"
#include "io/scene/sphere_file.hpp"
#include "io/scene/stl.hpp"
#include "io/text/input_error.hpp"
#include "io/text/toml_file.hpp"
#include "io/text/toml_value.hpp"

#include <fmt/format.h>

namespace talus
{

namespace
{

/// Makes the path of a file, named in relation to the scene's folder, absolute, so that the resolved scene can be read
/// from any folder.
void make_absolute(const SceneFile& file, std::string& name)
{
    name = (std::filesystem::absolute(file.path).parent_path() / name).lexically_normal().string();
}

/// Reads the mesh of a wall, and brings it to metres and into place.
void read_mesh(const SceneFile& file, const std::string& key, scene::WallTable& wall)
{
    make_absolute(file, wall.mesh);
    try {
        TriangleSoup soup = read_stl(wall.mesh);
        for (Vec3& vertex : soup.vertices) vertex = wall.scale * vertex + wall.translate;
        wall.vertices = std::move(soup.vertices);
        wall.triangles = std::move(soup.triangles);
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: wall '{}': {}", file.place_of(key + ".mesh"), wall.name, error.what()));
    }
}

/// Reads the spheres of a fill, and brings them to metres and into place.
void read_fill(const SceneFile& file, const std::string& key, scene::FillTable& fill)
{
    make_absolute(file, fill.file);
    try {
        fill.spheres = read_spheres(fill.file);
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", file.place_of(key + ".file"), error.what()));
    }
    for (Vec3& position : fill.spheres.positions) position = fill.scale * position + fill.translate;
    for (double& radius : fill.spheres.radii) radius *= fill.scale;
    for (Vec3& velocity : fill.spheres.velocities) velocity *= fill.scale;
}

/// Reads the sieve analysis of diameters that have one.
void read_analysis(const SceneFile& file, const std::string& key, scene::DiameterTable& diameter)
{
    if (diameter.distribution != "sieve") return;
    make_absolute(file, diameter.file);
    try {
        const SieveAnalysis analysis = read_sieves(diameter.file);
        diameter.sieve_sizes = analysis.sizes;
        diameter.sieve_passing = analysis.passing;
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", file.place_of(key + ".file"), error.what()));
    }
}

/// The sieve analyses of a fill or a pour.
void read_analyses(const SceneFile& file, const std::string& key, auto& table)
{
    read_analysis(file, key + ".diameter", table.diameter);
    for (std::size_t k = 0; k < table.species.size(); ++k)
        read_analysis(file, fmt::format("{}.species[{}].diameter", key, k), table.species[k].diameter);
}

/// Reads every file that the scene names into it.
void read_named_files(SceneFile& file)
{
    scene::Scene& scene = file.scene;
    for (std::size_t i = 0; i < scene.wall.size(); ++i)
        if (scene.wall[i].shape == "mesh" && !scene.wall[i].mesh.empty())
            read_mesh(file, fmt::format("wall[{}]", i), scene.wall[i]);
    for (std::size_t i = 0; i < scene.fill.size(); ++i) {
        const std::string key = fmt::format("fill[{}]", i);
        read_analyses(file, key, scene.fill[i]);
        if (scene.fill[i].arrangement == "file") read_fill(file, key, scene.fill[i]);
    }
    for (std::size_t i = 0; i < scene.pour.size(); ++i) read_analyses(file, fmt::format("pour[{}]", i), scene.pour[i]);
}

} // namespace

std::string SceneFile::place_of(const std::string& key) const
{
    for (std::string table = key; !table.empty();) {
        if (const auto found = places.find(table); found != places.end()) return found->second;
        const std::size_t end = table.find_last_of(".[");
        table.resize(end == std::string::npos ? 0 : end);
    }
    return path.string();
}

scene::Scene parse_scene(const std::string& text)
{
    try {
        std::map<std::string, std::string> places;
        return read_tables(toml::parse(text), places);
    } catch (const toml::parse_error& error) {
        throw InputError(fmt::format("{}: {}", place_in(error.source()), describe_error(error)));
    }
}

SceneFile read_scene(const std::filesystem::path& path, const std::vector<std::string>& overrides)
{
    toml::table root = parse_toml_file(path, "a scene");
    for (const std::string& key_and_value : overrides) apply_override(root, key_and_value);
    SceneFile file{{}, path, {}};
    file.scene = read_tables(root, file.places);
    read_named_files(file);
    return file;
}

} // namespace talus
