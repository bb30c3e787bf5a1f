// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace talus
{

/// Every key of a scene file with what is allowed, default, unit and meaning, table by table.
/// @param table only this one with the tables in it ("wall", "materials", "fill"); empty: all
/// @throws InputError where there is no such table
std::string key_table(const std::string& table);

} // namespace talus
