// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// In what the output of two runs differs: the names of files that only one has or that are not the same bytes. Times
/// by the clock and the number of threads may differ.
std::vector<std::string> differences(const std::filesystem::path& one, const std::filesystem::path& other);
