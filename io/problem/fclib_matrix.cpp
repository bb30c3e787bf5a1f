// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/problem/fclib_matrix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace talus
{

namespace
{

constexpr int compressed_rows = -2; // in nz

/// What a group holds: of every entry row and column, once pointers are spread.
struct Entries {
    std::vector<int> rows, columns;
    Eigen::VectorXd values; ///< may be longer: what is beyond was never set
};

void check_count(Hdf5Reader& file, const std::string& path, Eigen::Index wanted)
{
    const std::int64_t found = file.whole_number(path);
    if (found != wanted) file.refuse(path, fmt::format("must be {} to go with the vectors, not {}", wanted, found));
}

int read_count(Hdf5Reader& file, const std::string& path, int smallest, int largest)
{
    const std::int64_t found = file.whole_number(path);
    if (found < smallest || found > largest)
        file.refuse(path, fmt::format("must be from {} to {}, not {}", smallest, largest, found));
    return static_cast<int>(found);
}

void check_length(const Hdf5Reader& file, const std::string& path, std::size_t found, std::size_t wanted)
{
    if (found != wanted) file.refuse(path, fmt::format("must have {} values, not {}", wanted, found));
}

std::vector<int> read_list(Hdf5Reader& file, const std::string& path, std::size_t wanted)
{
    std::vector<int> values = file.whole_numbers(path);
    check_length(file, path, values.size(), wanted);
    return values;
}

/// Of every entry the column, or row, that it belongs to by the pointers.
std::vector<int> read_pointers(Hdf5Reader& file, const std::string& path, Eigen::Index lines, int entries)
{
    const std::vector<int> pointers = read_list(file, path, static_cast<std::size_t>(lines) + 1);
    if (pointers.front() != 0) file.refuse(path, fmt::format("must begin with 0, not {}", pointers.front()));
    const auto fall = std::ranges::adjacent_find(pointers, std::greater<>());
    if (fall != pointers.end())
        file.refuse(path, fmt::format("must not fall, as it does from {} to {}", *fall, fall[1]));
    if (pointers.back() > entries)
        file.refuse(path, fmt::format("must end with at most nzmax = {}, not {}", entries, pointers.back()));
    std::vector<int> line_of_entry;
    line_of_entry.reserve(static_cast<std::size_t>(pointers.back()));
    for (std::size_t line = 0; line + 1 < pointers.size(); ++line)
        line_of_entry.insert(
            line_of_entry.end(), static_cast<std::size_t>(pointers[line + 1] - pointers[line]), static_cast<int>(line));
    return line_of_entry;
}

Entries read_entries(Hdf5Reader& file, const std::string& group, Eigen::Index rows, Eigen::Index columns)
{
    const int nzmax = read_count(file, group + "/nzmax", 0, std::numeric_limits<int>::max());
    const int nz = read_count(file, group + "/nz", compressed_rows, nzmax);
    const auto stored = static_cast<std::size_t>(nz >= 0 ? nz : nzmax);
    Entries entries;
    entries.rows = read_list(file, group + "/i", stored);
    if (nz >= 0)
        entries.columns = read_list(file, group + "/p", stored);
    else
        entries.columns = read_pointers(file, group + "/p", nz == compressed_rows ? rows : columns, nzmax);
    entries.rows.resize(entries.columns.size());
    if (nz == compressed_rows) std::swap(entries.rows, entries.columns);

    // old releases of FCLIB wrote nzmax values of triplets too
    entries.values = file.numbers(group + "/x");
    if (entries.values.size() != nzmax)
        check_length(file, group + "/x", static_cast<std::size_t>(entries.values.size()), stored);
    return entries;
}

void check_indices(const Hdf5Reader& file, const std::string& group, const char* what, const std::vector<int>& indices,
    Eigen::Index end)
{
    for (const int index : indices)
        if (index < 0 || index >= end)
            file.refuse(group, fmt::format("has an entry in {} {}; its {}s are 0 to {}", what, index, what, end - 1));
}

} // namespace

Eigen::SparseMatrix<double> read_fclib_matrix(
    Hdf5Reader& file, const std::string& group, Eigen::Index rows, Eigen::Index columns)
{
    check_count(file, group + "/m", rows);
    check_count(file, group + "/n", columns);
    const Entries entries = read_entries(file, group, rows, columns);
    check_indices(file, group, "row", entries.rows, rows);
    check_indices(file, group, "column", entries.columns, columns);
    const auto count = entries.rows.size();
    check_finite(file, group + "/x", entries.values, static_cast<Eigen::Index>(count));

    std::vector<Eigen::Triplet<double>> triplets;
    triplets.reserve(count);
    for (std::size_t k = 0; k < count; ++k)
        triplets.emplace_back(entries.rows[k], entries.columns[k], entries.values[static_cast<Eigen::Index>(k)]);
    Eigen::SparseMatrix<double> matrix(rows, columns);
    matrix.setFromTriplets(triplets.begin(), triplets.end());
    check_finite(
        file, group + "/x", Eigen::Map<const Eigen::VectorXd>(matrix.valuePtr(), matrix.nonZeros()), matrix.nonZeros());
    return matrix;
}

void write_fclib_matrix(Hdf5Writer& file, const std::string& group, const Eigen::SparseMatrix<double>& matrix)
{
    std::vector<int> rows, columns;
    std::vector<double> values;
    for (int column = 0; column < matrix.outerSize(); ++column) {
        for (Eigen::SparseMatrix<double>::InnerIterator entry(matrix, column); entry; ++entry) {
            rows.push_back(static_cast<int>(entry.row()));
            columns.push_back(static_cast<int>(entry.col()));
            values.push_back(entry.value());
        }
    }
    const int count = static_cast<int>(values.size());
    file.add(group + "/nzmax", count);
    file.add(group + "/m", static_cast<int>(matrix.rows()));
    file.add(group + "/n", static_cast<int>(matrix.cols()));
    file.add(group + "/nz", count);
    file.add(group + "/p", columns);
    file.add(group + "/i", rows);
    file.add(group + "/x", Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(values.data(), count)));
}

void check_finite(const Hdf5Reader& file, const std::string& path, const Eigen::VectorXd& values, Eigen::Index count)
{
    for (Eigen::Index k = 0; k < count; ++k)
        if (!std::isfinite(values[k]))
            file.refuse(fmt::format("{}[{}]", path, k), fmt::format("is {}, not a finite number", values[k]));
}

} // namespace talus
