// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/problem/hdf5_id.hpp"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace talus
{

/// Builds an HDF5 file in memory. Names are whole paths, and the groups on the way are made; datasets are stored
/// plainly, in one piece, and the same content gives the same bytes.
///
/// @throws OutputError where HDF5 cannot; its sentence begins with the name of the file
class Hdf5Writer
{
public:
    /// @param name of the file in sentences
    explicit Hdf5Writer(std::string name);

    void add_group(const std::string& path);
    void add(const std::string& path, int value); ///< a list of one, as FCLIB has it
    void add(const std::string& path, const std::vector<int>& values);
    void add(const std::string& path, const Eigen::VectorXd& values);
    void add(const std::string& path, const std::string& text); ///< of fixed length, with a null at its end

    /// The whole file.
    std::string bytes() const;

private:
    QuietHdf5 quiet_;
    std::string name_;
    Hdf5Id file_;
    Hdf5Id links_;    ///< settings: make the groups on the way
    Hdf5Id datasets_; ///< settings: do not write down the time

    void add(const std::string& path, hid_t stored, hid_t type, hid_t space, const void* values);
    void check(hid_t result, const std::string& path) const;
};

} // namespace talus
