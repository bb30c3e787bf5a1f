// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/scene_file.hpp"

#include "io/scene/overrides.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/text/toml_value.hpp"

namespace talus
{

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
    std::map<std::string, std::string> places;
    return read_tables(parse_toml(text, ""), places);
}

namespace
{

SceneFile read_root(toml::table root, const std::filesystem::path& path, const std::vector<std::string>& overrides)
{
    for (const std::string& key_and_value : overrides) apply_override(root, key_and_value);
    SceneFile file{{}, path, {}};
    file.scene = read_tables(root, file.places);
    read_named_files(file);
    return file;
}

} // namespace

SceneFile read_scene(const std::filesystem::path& path, const std::vector<std::string>& overrides)
{
    return read_root(parse_toml_file(path, "a scene file"), path, overrides);
}

SceneFile read_scene_text(
    const std::string& text, const std::filesystem::path& path, const std::vector<std::string>& overrides)
{
    return read_root(parse_toml(text, path.string()), path, overrides);
}

} // namespace talus
