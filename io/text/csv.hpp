// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <deque>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace talus
{

/// A table under a header that names its columns, from a CSV file.
class CsvTable
{
public:
    /// Columns are separated by commas, else by semicolons, tabs or blanks, whichever the header has first of these; a
    /// value may stand in quotes. Blank lines, spaces round a value and lines that begin with # do not count.
    /// @param known the columns that the file may have, all of numbers; empty: any
    /// @throws InputError with file and line where a column is unknown or there twice, or a line has too few or too
    /// many
    ///   values
    explicit CsvTable(const std::filesystem::path& path, const std::vector<std::string_view>& known = {});

    std::size_t row_count() const { return lines_.size(); }
    const std::vector<std::string>& names() const { return names_; }

    /// Where a column is; -1 where the file has none of that name.
    int column(std::string_view name) const;

    /// As it stands there.
    std::string_view text(std::size_t row, int column) const
    {
        return values_[row * names_.size() + static_cast<std::size_t>(column)];
    }

    /// @throws InputError where it is not a finite number
    double value(std::size_t row, int column) const;

    /// @throws InputError "file:line: sentence" for a row
    [[noreturn]] void refuse_row(std::size_t row, const std::string& sentence) const;

    /// @throws InputError "file:line: sentence" for the header
    [[noreturn]] void refuse_header(const std::string& sentence) const;

private:
    std::string file_, bytes_;
    std::deque<std::string> unquoted_; ///< values that do not stand as they are in the bytes
    char separator_ = ',';
    std::size_t header_line_ = 0;
    std::vector<std::string> names_;
    std::vector<std::string_view> values_; ///< row by row
    std::vector<std::size_t> lines_;       ///< of the file, for each row

    [[noreturn]] void refuse(std::size_t line, const std::string& sentence) const;
    std::vector<std::string_view> split(std::string_view text, std::size_t line);
    void read_header(std::string_view text, std::size_t line, const std::vector<std::string_view>& known);
    void read_row(std::string_view text, std::size_t line, bool of_numbers);
};

} // namespace talus
