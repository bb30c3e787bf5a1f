// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>

namespace talus::test
{

/// The rows of study.csv by setting and column; texts as they are.
using StudyTable = std::map<std::string, std::map<std::string, std::string>>;

/// Reads the text of a study.csv.
StudyTable read_study_csv(const std::string& text);

} // namespace talus::test
