// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

/// Compares a table with what tests/results/NAME.md has between its marks "NAME begin" and "NAME end"; where the
/// environment has TALUS_UPDATE_TABLES, it is written there instead.
void check_readme_table(const std::string& name, const std::string& table);

/// A text in which what matches the first of each pair is the second, and so are the time and step at which a run ended
/// and the sizes of files: the table shows what does not differ from place to place and from release to release.
std::string as_shown(std::string text, const std::vector<std::pair<std::string, std::string>>& patterns);

/// A text as it may stand in a cell of a table: its first line.
std::string table_cell(const std::string& text);
