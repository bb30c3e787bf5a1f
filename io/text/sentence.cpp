// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/text/sentence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace talus
{

namespace
{

std::size_t edit_distance(std::string_view from, std::string_view to)
{
    std::vector<std::size_t> row(to.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < from.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < to.size(); ++j) {
            const std::size_t substituted = diagonal + (from[i] == to[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({substituted, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

} // namespace

std::string_view nearest_name(std::string_view word, const std::vector<std::string_view>& names)
{
    constexpr std::size_t longest_word = 100; // no key is that long, and the distance costs the product of lengths
    if (word.size() > longest_word) return {};
    std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
    std::string_view nearest;
    for (const std::string_view name : names) {
        const std::size_t distance = edit_distance(word, name);
        if (distance < least && distance < name.size()) {
            least = distance;
            nearest = name;
        }
    }
    return nearest;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& names)
{
    const std::string_view name = nearest_name(word, names);
    return name.empty() ? std::string() : fmt::format("; did you mean '{}'?", name);
}

std::string enumerate_names(const std::vector<std::string_view>& names, std::string_view conjunction)
{
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i > 0) text += i + 1 == names.size() ? fmt::format(" {} ", conjunction) : ", ";
        text += fmt::format("'{}'", names[i]);
    }
    return text;
}

bool is_printable(std::string_view text)
{
    for (std::size_t k = 0; k < text.size(); ++k) {
        const auto byte = static_cast<unsigned char>(text[k]);
        const auto next = static_cast<unsigned char>(k + 1 < text.size() ? text[k + 1] : 0xff);
        if ((byte < 0x20 && byte != '\t') || byte == 0x7f || (byte == 0xc2 && next < 0xa0)) return false;
    }
    return true;
}

std::string one_line(std::string_view text)
{
    std::string line(text);
    std::ranges::replace_if(
        line, [](unsigned char c) { return c < ' '; }, ' ');
    return line;
}

} // namespace talus
