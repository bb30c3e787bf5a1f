// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/sweep_cases.hpp"

#include "io/run/run_files.hpp"
#include "io/text/input_error.hpp"
#include "io/text/input_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <iterator>
#include <map>

namespace talus
{
namespace
{

namespace fs = std::filesystem;

constexpr const char* refusal = "refused.txt";

std::string text_of(const fs::path& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// The fields of a line of CSV, some of them in quotes; no field goes over its line.
std::vector<std::string> fields_of(const std::string& line)
{
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (std::size_t k = 0; k < line.size(); ++k) {
        if (line[k] == '"' && quoted && k + 1 < line.size() && line[k + 1] == '"') {
            fields.back() += line[++k];
        } else if (line[k] == '"') {
            quoted = !quoted;
        } else if (line[k] == ',' && !quoted) {
            fields.emplace_back();
        } else if (line[k] != '\r') {
            fields.back() += line[k];
        }
    }
    return fields;
}

/// The settings of a case, key=value. A field without a value leaves what the scene has.
std::vector<std::string> settings_of(const fs::path& cases, int number)
{
    std::ifstream file(cases);
    std::string line;
    std::getline(file, line);
    const std::vector<std::string> keys = fields_of(line);
    if (keys.front() != "case") throw InputError(fmt::format("{}:1: the first column must be 'case'", cases.string()));
    int last = 0;
    for (int at = 2; std::getline(file, line); ++at) {
        if (line.empty()) continue;
        const std::vector<std::string> fields = fields_of(line);
        if (fields.size() != keys.size())
            throw InputError(fmt::format(
                "{}:{}: the line has {} fields and the header {}", cases.string(), at, fields.size(), keys.size()));
        ++last;
        if (fields.front() != std::to_string(number)) continue;
        std::vector<std::string> settings;
        for (std::size_t k = 1; k < keys.size(); ++k)
            if (!fields[k].empty()) settings.push_back(fmt::format("{}={}", keys[k], fields[k]));
        return settings;
    }
    throw InputError(fmt::format("{}: there is no case {} among its {}", cases.string(), number, last));
}

/// @throws InputError where the file is not what it was when the sweep was made
void require_same(const fs::path& file, const std::string& sum)
{
    if (fmt::format("{:08x}", checksum(read_bytes(file, "a file"))) == sum) return;
    throw InputError(
        fmt::format("{}: the file is not what it was when the sweep was made; put it back, or begin the sweep "
                    "anew with 'talus sweep --force'",
            file.string()));
}

} // namespace

SweepCase read_sweep_case(const fs::path& sweep, int number, const std::string& version)
{
    const fs::path mark = sweep / "sweep.json";
    std::error_code error;
    if (!fs::is_regular_file(mark, error))
        throw InputError(fmt::format(
            "{}: the folder holds no sweep, which 'talus sweep' makes; a case is one of its runs", sweep.string()));
    SweepCase one;
    std::string begun_by;
    std::map<std::string, std::string> files;
    try {
        const auto json = nlohmann::json::parse(text_of(mark));
        begun_by = json.at("version").get<std::string>();
        one.scene = sweep / json.at("scene").get<std::string>();
        one.threads = json.at("threads").get<int>();
        one.report = json.at("reports").get<bool>();
        files = json.at("files").get<std::map<std::string, std::string>>();
    } catch (const nlohmann::json::exception& damage) {
        throw InputError(fmt::format("{}: the file is damaged: {}", mark.string(), damage.what()));
    }
    if (begun_by != version)
        throw InputError(fmt::format("{}: the sweep was begun with Talus {}, and this is {}; 'talus sweep --force' "
                                     "begins it anew",
            sweep.string(), begun_by, version));
    if (!fs::is_regular_file(one.scene, error))
        throw InputError(fmt::format("{}: the scene of the sweep is not there", one.scene.string()));
    one.overrides = settings_of(sweep / "cases.csv", number);
    for (const std::string& setting : one.overrides) one.identity += setting + "\n";
    for (const auto& [file, sum] : files) {
        require_same(sweep / "scene" / file, sum);
        one.identity += fmt::format("{} {}\n", file, sum);
    }
    one.folder = sweep / "cases" / fmt::format("{:04}", number);
    return one;
}

std::string status_of_run(const fs::path& folder)
{
    const auto json = nlohmann::json::parse(text_of(folder / "summary.json"), nullptr, false);
    return json.is_object() ? json.value("status", "") : "";
}

void keep_identity(const fs::path& folder, const std::string& identity)
{
    std::error_code error;
    fs::create_directories(folder, error);
    write_atomically(folder / case_file, identity);
}

std::string kept_identity(const fs::path& folder)
{
    return text_of(folder / case_file);
}

void keep_refusal(const fs::path& folder, const std::string& sentence)
{
    std::error_code error;
    fs::create_directories(folder, error);
    write_atomically(folder / refusal, sentence + "\n");
}

std::string kept_refusal(const fs::path& folder)
{
    std::string sentence = text_of(folder / refusal);
    while (sentence.ends_with('\n')) sentence.pop_back();
    return sentence;
}

void forget_refusal(const fs::path& folder)
{
    std::error_code error;
    fs::remove(folder / refusal, error);
    if (error) throw OutputError(fmt::format("{}: {}", (folder / refusal).string(), error.message()));
}

} // namespace talus
