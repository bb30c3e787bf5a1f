// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/text/finite_number.hpp"

#include <charconv>
#include <cmath>

namespace talus
{

std::optional<double> finite_number(std::string_view text)
{
    if (text.starts_with('+')) text.remove_prefix(1); // which from_chars does not take
    const char* const text_end = text.data() + text.size();
    double number = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text_end, number);
    if (error != std::errc() || end != text_end || !std::isfinite(number)) return std::nullopt;
    return number;
}

} // namespace talus
