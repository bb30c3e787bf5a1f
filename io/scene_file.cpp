// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene_file.hpp"

#include "io/input_error.hpp"
#include "io/scene_reader.hpp"
#include "io/stl.hpp"
#include "io/toml_overrides.hpp"
#include "io/toml_value.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

namespace talus
{

namespace
{

/// Far above any scene, which holds numbers and names; geometry lies in files of its own.
constexpr std::uintmax_t largest_scene_file = 1 << 20;

std::string read_text(const std::filesystem::path& path)
{
    std::error_code error;
    if (!std::filesystem::exists(path, error)) throw InputError(fmt::format("{}: no such file", path.string()));
    if (!std::filesystem::is_regular_file(path, error))
        throw InputError(fmt::format("{}: not a file that holds a scene", path.string()));
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error || size > largest_scene_file)
        throw InputError(
            fmt::format("{}: a scene file has at most {} bytes, this one {}", path.string(), largest_scene_file, size));
    std::ifstream stream(path, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (!stream) throw InputError(fmt::format("{}: the file cannot be read", path.string()));
    return text;
}

toml::table parse_file(const std::filesystem::path& path)
{
    try {
        return toml::parse(read_text(path), path.string());
    } catch (const toml::parse_error& error) {
        throw InputError(fmt::format("{}: {}", place_in(error.source()), describe_error(error)));
    }
}

/// Reads the mesh of a wall, named in relation to the scene's folder, and brings it to metres and into place.
/// From then on the wall names it by its absolute path, so that the resolved scene can be read from any folder.
void read_mesh(const SceneFile& file, const std::string& key, scene::WallTable& wall)
{
    const auto path = std::filesystem::absolute(file.path).parent_path() / wall.mesh;
    wall.mesh = path.lexically_normal().string();
    try {
        TriangleSoup soup = read_stl(wall.mesh);
        for (Vec3& vertex : soup.vertices) vertex = wall.scale * vertex + wall.translate;
        wall.vertices = std::move(soup.vertices);
        wall.triangles = std::move(soup.triangles);
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: wall '{}': {}", file.place_of(key + ".mesh"), wall.name, error.what()));
    }
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
    toml::table root = parse_file(path);
    for (const std::string& key_and_value : overrides) apply_override(root, key_and_value);
    SceneFile file{{}, path, {}};
    file.scene = read_tables(root, file.places);
    for (std::size_t i = 0; i < file.scene.wall.size(); ++i)
        if (file.scene.wall[i].shape == "mesh" && !file.scene.wall[i].mesh.empty())
            read_mesh(file, fmt::format("wall[{}]", i), file.scene.wall[i]);
    return file;
}

} // namespace talus
