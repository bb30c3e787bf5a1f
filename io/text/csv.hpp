// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace talus
{

/// A table of finite numbers under a header that names its columns, from a CSV file.
class CsvTable
{
public:
    /// Columns are separated by commas; blank lines, spaces round a value and lines that begin with # do not count.
    /// @param known the columns that the file may have
    /// @throws InputError with file and line where a column is unknown or there twice, a line has too few or too many
    ///   values, or a value is not a finite number
    CsvTable(const std::filesystem::path& path, const std::vector<std::string_view>& known);

    std::size_t row_count() const { return lines_.size(); }

    /// Where a column is; -1 where the file has none of that name.
    int column(std::string_view name) const;

    double value(std::size_t row, int column) const
    {
        return values_[row * names_.size() + static_cast<std::size_t>(column)];
    }

    /// @throws InputError "file:line: sentence" for a row
    [[noreturn]] void refuse_row(std::size_t row, const std::string& sentence) const;

    /// @throws InputError "file:line: sentence" for the header
    [[noreturn]] void refuse_header(const std::string& sentence) const;

private:
    std::string file_;
    std::size_t header_line_ = 0;
    std::vector<std::string> names_;
    std::vector<double> values_;     ///< row by row
    std::vector<std::size_t> lines_; ///< of the file, for each row

    [[noreturn]] void refuse(std::size_t line, const std::string& sentence) const;
    void read_header(std::string_view text, std::size_t line, const std::vector<std::string_view>& known);
    void read_row(std::string_view text, std::size_t line);
};

} // namespace talus
