// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/text/csv.hpp"

#include "io/text/input_error.hpp"
#include "io/text/input_file.hpp"
#include "io/text/sentence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace talus
{

namespace
{

constexpr std::string_view blanks = " \t\r";

std::string_view trimmed(std::string_view text)
{
    const std::size_t begin = std::min(text.find_first_not_of(blanks), text.size());
    return text.substr(begin, text.find_last_not_of(blanks) + 1 - begin);
}

std::string shown(std::string_view value)
{
    return one_line(value.substr(0, 40));
}

} // namespace

CsvTable::CsvTable(const std::filesystem::path& path, const std::vector<std::string_view>& known)
    : file_(path.string()), bytes_(read_bytes(path, "a CSV file"))
{
    std::string_view rest = bytes_;
    if (rest.starts_with("\xef\xbb\xbf")) rest.remove_prefix(3); // the mark that spreadsheets put before UTF-8
    for (std::size_t line = 1; !rest.empty(); ++line) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        const std::string_view text = trimmed(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
        if (text.empty() || text.front() == '#') continue;
        if (names_.empty())
            read_header(text, line, known);
        else
            read_row(text, line, !known.empty());
    }
    if (names_.empty())
        refuse(1, known.empty() ? "a header that names columns is wanted"
                                : fmt::format("a header with {} is wanted", enumerate_names(known, "or")));
    if (lines_.empty()) refuse(header_line_, "no line of numbers follows the header");
}

int CsvTable::column(std::string_view name) const
{
    const auto found = std::ranges::find(names_, name);
    return found == names_.end() ? -1 : static_cast<int>(found - names_.begin());
}

double CsvTable::value(std::size_t row, int column) const
{
    const auto number = finite_number(text(row, column));
    if (!number) refuse_row(row, fmt::format("'{}' is not a finite number", shown(text(row, column))));
    return *number;
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

/// The values of a line. Any number of blanks separates where these do.
std::vector<std::string_view> CsvTable::split(std::string_view text, std::size_t line)
{
    const auto ends_at = [&](std::string_view rest) {
        return std::min(separator_ == ' ' ? rest.find_first_of(blanks) : rest.find(separator_), rest.size());
    };
    std::vector<std::string_view> values;
    for (bool goes_on = true; goes_on;) {
        text.remove_prefix(std::min(text.find_first_not_of(separator_ == '\t' ? " \r" : blanks), text.size()));
        if (text.starts_with('"')) {
            std::string& value = unquoted_.emplace_back();
            for (text.remove_prefix(1);; text.remove_prefix(1)) {
                if (text.empty()) refuse(line, "a quote is opened and not closed");
                if (text.starts_with("\"\""))
                    text.remove_prefix(1);
                else if (text.front() == '"')
                    break;
                value += text.front();
            }
            text.remove_prefix(1);
            values.push_back(value);
        } else {
            values.push_back(trimmed(text.substr(0, ends_at(text))));
        }
        text.remove_prefix(ends_at(text));
        goes_on = !text.empty();
        if (goes_on) text.remove_prefix(1);
    }
    return values;
}

void CsvTable::read_header(std::string_view text, std::size_t line, const std::vector<std::string_view>& known)
{
    header_line_ = line;
    constexpr std::string_view separators = ",;\t";
    const auto separates = [&](char c) { return text.find(c) != std::string_view::npos; };
    const auto found = std::ranges::find_if(separators, separates);
    if (found != separators.end())
        separator_ = *found;
    else if (separates(' '))
        separator_ = ' ';
    for (const std::string_view name : split(text, line)) {
        if (!known.empty() && std::ranges::find(known, name) == known.end())
            refuse(line,
                fmt::format("unknown column '{}'; the header may name {}", shown(name), enumerate_names(known, "and")));
        if (column(name) >= 0) refuse(line, fmt::format("column '{}' is there twice", shown(name)));
        names_.emplace_back(name);
    }
}

void CsvTable::read_row(std::string_view text, std::size_t line, bool of_numbers)
{
    const auto values = split(text, line);
    if (values.size() != names_.size())
        refuse(line, fmt::format("the header names {} columns, this line has {}", names_.size(), values.size()));
    std::ranges::copy(values, std::back_inserter(values_));
    lines_.push_back(line);
    for (int k = 0; of_numbers && k < static_cast<int>(values.size()); ++k) value(lines_.size() - 1, k);
}

} // namespace talus
