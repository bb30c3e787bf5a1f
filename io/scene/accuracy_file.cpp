// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/accuracy_file.hpp"

#include "io/scene/scene_reader.hpp"
#include "io/text/toml_value.hpp"

namespace talus
{

std::vector<scene::MeasuredSetting> read_measured_settings(const std::filesystem::path& path)
{
    Places places;
    return read_measured_tables(parse_toml_file(path, "a file of measured settings"), places).setting;
}

} // namespace talus
