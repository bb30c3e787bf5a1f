// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/app/run_folder.hpp"

#include <nlohmann/json.hpp>

#include <fstream>
#include <iterator>
#include <set>

namespace fs = std::filesystem;

namespace
{

/// At the end of a checkpoint: wall and CPU time of eleven phases.
constexpr std::size_t clock_bytes = 11 * 2 * sizeof(double);

/// At its beginning: magic, format, byte order, version (0.1.0 with its length), size, checksum.
constexpr std::size_t header_bytes = 8 + 4 + 4 + 8 + 5 + 8 + 4;

std::string bytes_of(const fs::path& path)
{
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// The file without what may differ from run to run.
std::string lasting_content(const fs::path& path)
{
    std::string bytes = bytes_of(path);
    if (path.filename() == "checkpoint.latest" && bytes.size() > header_bytes + clock_bytes)
        return bytes.substr(header_bytes, bytes.size() - header_bytes - clock_bytes);
    if (path.filename() != "summary.json") return bytes;
    nlohmann::ordered_json summary = nlohmann::ordered_json::parse(bytes);
    summary.erase("timing");
    summary.erase("threads");
    return summary.dump();
}

std::set<std::string> files_of(const fs::path& folder)
{
    std::set<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file() && entry.path().filename() != "checkpoint.previous")
            files.insert(fs::relative(entry.path(), folder).string());
    return files;
}

} // namespace

std::vector<std::string> differences(const fs::path& one, const fs::path& other)
{
    std::set<std::string> files = files_of(one);
    files.merge(files_of(other));
    std::vector<std::string> different;
    for (const std::string& file : files)
        if (!fs::exists(one / file) || !fs::exists(other / file) ||
            lasting_content(one / file) != lasting_content(other / file))
            different.push_back(file);
    return different;
}
