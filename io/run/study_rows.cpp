// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/study_rows.hpp"

#include "io/text/input_error.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <limits>
#include <sstream>

namespace talus
{
namespace
{

using Json = nlohmann::ordered_json; // it writes numbers that are not finite as null

double number(const Json& value)
{
    return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

} // namespace

std::string row_text(const StudyRow& row)
{
    Json json = {{"setting", row.setting}, {"seed", row.seed}, {"status", row.status}, {"cpu_s_per_s", row.cpu},
        {"contact_updates_per_s", row.updates}, {"memory_B", row.memory}};
    Json& findings = json["findings"] = Json::array();
    for (const Measurement& m : row.findings)
        findings.push_back({{"name", m.name}, {"value", m.value}, {"spread", m.spread}, {"unit", m.unit}});
    json["profile"] = row.profile;
    return json.dump();
}

StudyRow read_row(const std::string& line)
{
    try {
        const Json json = Json::parse(line);
        StudyRow row{json.at("setting"), json.at("seed"), json.at("status"), number(json.at("cpu_s_per_s")),
            number(json.at("contact_updates_per_s")), number(json.at("memory_B")), {}, {}};
        for (const Json& m : json.at("findings"))
            row.findings.push_back({m.at("name"), number(m.at("value")), number(m.at("spread")), m.at("unit")});
        for (const Json& force : json.at("profile")) row.profile.push_back(number(force));
        return row;
    } catch (const Json::exception& error) {
        throw InputError(fmt::format("not a row of a study: {}", error.what()));
    }
}

std::vector<StudyRow> read_rows(const std::filesystem::path& path)
{
    std::ifstream file(path, std::ios::binary);
    const std::string text = (std::ostringstream() << file.rdbuf()).str();
    std::vector<StudyRow> rows;
    std::size_t begin = 0, line = 1;
    for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', begin), ++line) {
        try {
            rows.push_back(read_row(text.substr(begin, end - begin)));
        } catch (const InputError& error) {
            throw InputError(fmt::format("{}:{}: {}", path.string(), line, error.what()));
        }
        begin = end + 1;
    }
    return rows;
}

} // namespace talus
