// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/sieve_file.hpp"

#include "io/text/csv.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace talus
{

namespace
{

/// The rows of the table from the finest sieve to the coarsest.
std::vector<std::size_t> rows_from_fine(const CsvTable& table, int size)
{
    std::vector<std::size_t> rows(table.row_count());
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = i;
    if (table.value(rows.front(), size) > table.value(rows.back(), size)) std::ranges::reverse(rows);
    return rows;
}

/// Refuses row `at` unless it follows on the finer sieve in row `before`.
void check_order(const CsvTable& table, std::size_t before, std::size_t at, int size, int passing)
{
    if (!(table.value(at, size) > table.value(before, size)))
        table.refuse_row(at, "the sizes must rise, or fall, from line to line");
    if (table.value(at, passing) < table.value(before, passing))
        table.refuse_row(at, fmt::format("a finer sieve lets {} % pass, more than the {} % of this one",
                                 table.value(before, passing), table.value(at, passing)));
}

} // namespace

SieveAnalysis read_sieves(const std::filesystem::path& path)
{
    const CsvTable table(path, {"size_mm", "size_m", "passing_percent"});
    const int millimetres = table.column("size_mm"), metres = table.column("size_m");
    const int size = std::max(millimetres, metres), passing = table.column("passing_percent");
    if ((millimetres < 0) == (metres < 0) || passing < 0)
        table.refuse_header("a sieve analysis has the columns 'size_mm' or 'size_m', and 'passing_percent'");

    const auto rows = rows_from_fine(table, size);
    if (rows.size() < 2) table.refuse_row(rows.front(), "a sieve analysis has two sieves at least");
    SieveAnalysis analysis;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        if (!(table.value(rows[k], size) > 0.0)) table.refuse_row(rows[k], "a sieve's size must be above 0");
        if (k > 0) check_order(table, rows[k - 1], rows[k], size, passing);
        analysis.sizes.push_back(table.value(rows[k], size) * (millimetres < 0 ? 1.0 : 1e-3));
        analysis.passing.push_back(0.01 * table.value(rows[k], passing));
    }
    if (analysis.passing.front() != 0.0)
        table.refuse_row(rows.front(), "0 % must pass the finest sieve, or the smallest diameter is not known");
    if (table.value(rows.back(), passing) != 100.0)
        table.refuse_row(rows.back(), "100 % must pass the coarsest sieve, or the largest diameter is not known");
    return analysis;
}

} // namespace talus
