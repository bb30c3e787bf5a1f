// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/study_csv.hpp"

#include <vector>

namespace talus::test
{

StudyTable read_study_csv(const std::string& text)
{
    std::vector<std::vector<std::string>> lines;
    bool quoted = false;
    lines.push_back({""});
    for (const char c : text) {
        if (c == '"')
            quoted = !quoted;
        else if (c == ',' && !quoted)
            lines.back().push_back("");
        else if (c == '\n')
            lines.push_back({""});
        else
            lines.back().back() += c;
    }
    StudyTable rows;
    for (std::size_t k = 1; k < lines.size(); ++k)
        for (std::size_t column = 0; column < lines[k].size() && lines[k].size() > 1; ++column)
            rows[lines[k][0]][lines[0][column]] = lines[k][column];
    return rows;
}

} // namespace talus::test
