// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/study_file.hpp"

#include "io/scene/scene_reader.hpp"
#include "io/text/toml_text.hpp"
#include "io/text/toml_value.hpp"

namespace talus
{

scene::Study read_study(const std::filesystem::path& path)
{
    Places places;
    return read_study_tables(parse_toml_file(path, "a study file"), places);
}

std::string resolved_study(const scene::Study& study)
{
    std::string text;
    for_each_own_key(study, [&](std::string_view name, const auto& field, std::string_view) {
        text += fmt::format("{} = {}\n", name, toml_text(field));
    });
    return text;
}

} // namespace talus
