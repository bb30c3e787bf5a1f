// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string_view>

namespace talus
{

/// The finite number that a whole text is, perhaps with a + before it; nothing where it is none.
std::optional<double> finite_number(std::string_view text);

} // namespace talus
