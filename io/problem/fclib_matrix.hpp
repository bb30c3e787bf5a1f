// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/problem/hdf5_reader.hpp"
#include "io/problem/hdf5_writer.hpp"

#include <Eigen/SparseCore>

#include <string>

namespace talus
{

/// Reads a sparse matrix of FCLIB: a group of m (rows), n (columns), nzmax, nz, p, i and x, named as in CSparse
/// [Davis 2006, "Direct Methods for Sparse Linear Systems", 2.1].
///
///   nz ≥ 0     nz triplets: rows i, columns p, values x
///   nz = −1    compressed columns: p[j] … p[j + 1] are the entries of column j, in rows i with values x
///   nz = −2    compressed rows: likewise, of row j, in columns i
///
/// Entries of the same place are added up. Sizes are compared before any room is made, so neither need be believed.
/// @param group its path in the file
/// @param rows,columns that it must have
/// @throws InputError
Eigen::SparseMatrix<double> read_fclib_matrix(
    Hdf5Reader& file, const std::string& group, Eigen::Index rows, Eigen::Index columns);

/// Writes a sparse matrix into a group of its own, as triplets column by column.
/// @throws OutputError
void write_fclib_matrix(Hdf5Writer& file, const std::string& group, const Eigen::SparseMatrix<double>& matrix);

/// Refuses numbers of which one of the first `count` is not finite.
/// @throws InputError
void check_finite(const Hdf5Reader& file, const std::string& path, const Eigen::VectorXd& values, Eigen::Index count);

} // namespace talus
