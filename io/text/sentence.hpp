// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

/// What the sentences about bad input are made of.
namespace talus
{

/// The name most like `word` by Levenshtein's distance; empty where more than a third of its letters would change.
std::string_view nearest_name(std::string_view word, const std::vector<std::string_view>& names);

/// The end of a sentence about an unknown word: "; did you mean 'friction'?", or nothing where no name is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& names);

/// "'draft', 'standard' or 'fine'" with the conjunction "or".
std::string enumerate_names(const std::vector<std::string_view>& names, std::string_view conjunction);

/// Whether a text can be printed: it holds no control characters, but perhaps a tab.
bool is_printable(std::string_view text);

/// What a text must be that is printed.
inline constexpr std::string_view printable_text = "text without line breaks and control characters";

/// The text with every line break or other control character as a space, for a sentence on one line.
std::string one_line(std::string_view text);

} // namespace talus
