// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

/// Compares a table with what tests/README.md has between its marks "NAME begin" and "NAME end"; where the environment
/// has TALUS_UPDATE_TABLES, it is written there instead.
void check_readme_table(const std::string& name, const std::string& table);

/// A text as it may stand in a cell of a table: its first line.
std::string table_cell(const std::string& text);
