// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/scene_files.hpp"

#include "io/text/checksum.hpp"
#include "io/text/field_kind.hpp"
#include "io/text/input_file.hpp"

namespace talus
{

namespace
{

using Files = std::vector<std::pair<std::string, std::uint32_t>>;

void add_files(Files&, std::string_view, const auto&) {}

void add_files(Files& files, std::string_view key, const std::string& value)
{
    if ((key == "mesh" || key == "file") && !value.empty())
        files.emplace_back(value, checksum(read_bytes(value, "a file")));
}

template <Table Described> void add_files(Files& files, std::string_view, const Described& table);

template <Table Described> void add_files(Files& files, std::string_view key, const std::vector<Described>& list)
{
    for (const Described& element : list) add_files(files, key, element);
}

template <Table Described> void add_files(Files& files, std::string_view, const Described& table)
{
    for_each_own_key(
        table, [&](std::string_view name, const auto& field, std::string_view) { add_files(files, name, field); });
}

} // namespace

Files input_files(const scene::Scene& scene)
{
    Files files;
    add_files(files, "", scene);
    return files;
}

} // namespace talus
