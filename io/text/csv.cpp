// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/text/csv.hpp"

#include "io/text/input_error.hpp"
#include "io/text/input_file.hpp"
#include "io/text/sentence.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace talus
{

namespace
{

std::string_view trimmed(std::string_view text)
{
    const std::size_t begin = std::min(text.find_first_not_of(" \t\r"), text.size());
    return text.substr(begin, text.find_last_not_of(" \t\r") + 1 - begin);
}

std::vector<std::string_view> split_at_commas(std::string_view text)
{
    std::vector<std::string_view> values;
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t comma = std::min(text.find(',', from), text.size());
        values.push_back(trimmed(text.substr(from, comma - from)));
        from = comma + 1;
    }
    return values;
}

std::string shown(std::string_view value)
{
    return one_line(value.substr(0, 40));
}

} // namespace

CsvTable::CsvTable(const std::filesystem::path& path, const std::vector<std::string_view>& known) : file_(path.string())
{
    const std::string bytes = read_bytes(path, "a CSV file");
    std::string_view rest = bytes;
    if (rest.starts_with("\xef\xbb\xbf")) rest.remove_prefix(3); // the mark that spreadsheets put before UTF-8
    for (std::size_t line = 1; !rest.empty(); ++line) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        const std::string_view text = trimmed(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
        if (text.empty() || text.front() == '#') continue;
        if (names_.empty())
            read_header(text, line, known);
        else
            read_row(text, line);
    }
    if (names_.empty()) refuse(1, fmt::format("a header with {} is wanted", enumerate_names(known, "or")));
    if (lines_.empty()) refuse(header_line_, "no line of numbers follows the header");
}

int CsvTable::column(std::string_view name) const
{
    const auto found = std::ranges::find(names_, name);
    return found == names_.end() ? -1 : static_cast<int>(found - names_.begin());
}

void CsvTable::refuse_row(std::size_t row, const std::string& sentence) const
{
    refuse(lines_[row], sentence);
}

void CsvTable::refuse_header(const std::string& sentence) const
{
    refuse(header_line_, sentence);
}

void CsvTable::refuse(std::size_t line, const std::string& sentence) const
{
    throw InputError(fmt::format("{}:{}: {}", file_, line, sentence));
}

void CsvTable::read_header(std::string_view text, std::size_t line, const std::vector<std::string_view>& known)
{
    header_line_ = line;
    for (const std::string_view name : split_at_commas(text)) {
        if (std::ranges::find(known, name) == known.end())
            refuse(line,
                fmt::format("unknown column '{}'; the header may name {}", shown(name), enumerate_names(known, "and")));
        if (column(name) >= 0) refuse(line, fmt::format("column '{}' is there twice", name));
        names_.emplace_back(name);
    }
}

void CsvTable::read_row(std::string_view text, std::size_t line)
{
    const auto values = split_at_commas(text);
    if (values.size() != names_.size())
        refuse(line, fmt::format("the header names {} columns, this line has {}", names_.size(), values.size()));
    for (const std::string_view value : values) {
        const auto number = finite_number(value);
        if (!number) refuse(line, fmt::format("'{}' is not a finite number", shown(value)));
        values_.push_back(*number);
    }
    lines_.push_back(line);
}

} // namespace talus
