// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/app/readme_table.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <regex>

void check_readme_table(const std::string& name, const std::string& table)
{
    const std::string path = TALUS_SOURCE_DIR "/tests/results/" + name + ".md";
    const std::string begin = "<!-- " + name + " begin -->\n", end = "<!-- " + name + " end -->\n";
    std::ifstream file(path);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const std::size_t from = text.find(begin), to = text.find(end);
    REQUIRE(from != std::string::npos);
    REQUIRE(to != std::string::npos);
    const std::string now = text.substr(0, from + begin.size()) + table + text.substr(to);
    const bool update = std::getenv("TALUS_UPDATE_TABLES") != nullptr;
    if (update) std::ofstream(path) << now;
    const auto [seen, written] = std::mismatch(now.begin(), now.end(), text.begin(), text.end());
    INFO("the table differs from " << std::string(seen, now.end()).substr(0, 300) << "\nwhere the file has "
                                   << std::string(written, text.end()).substr(0, 300));
    CHECK((update || now == text)); // else: TALUS_UPDATE_TABLES=1 build/test_app "[NAME]"
}

std::string as_shown(std::string text, const std::vector<std::pair<std::string, std::string>>& patterns)
{
    std::vector<std::pair<std::string, std::string>> all = {
        {"t = [^ ,;]* s", "t = … s"}, {"hold [0-9]* bytes and holds [0-9]*", "hold … bytes and holds …"}};
    all.insert(all.end(), patterns.begin(), patterns.end());
    for (const auto& [pattern, shown] : all) text = std::regex_replace(text, std::regex(pattern), shown);
    return text;
}

std::string table_cell(const std::string& text)
{
    return std::regex_replace(text.substr(0, text.find('\n')), std::regex("\\|"), "\\|");
}
