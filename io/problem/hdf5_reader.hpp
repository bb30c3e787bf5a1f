// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/problem/hdf5_id.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace talus
{

/// The groups and datasets of an HDF5 file, of which nothing is believed that can be checked: what is asked for must be
/// there and not behind a soft or external link; a dataset must be a list or one value, and stored plainly (neither in
/// chunks nor compressed nor in another file) and within the file, or never written; and all that is read must together
/// be no more than twice the file (what the file holds, and as much that was never written and is 0). So no answer is
/// larger than the file justifies.
///
/// Names are whole paths, /fclib_local/W/m. Every function throws InputError where the file is broken, with a sentence
/// that begins with the names of the file and of the dataset.
class Hdf5Reader
{
public:
    /// @param bytes of the whole file; must stay as long as the reader
    /// @param name of the file in sentences
    /// @throws InputError where they are no HDF5 file
    Hdf5Reader(std::string_view bytes, std::string name);

    /// Whether there is such a group or dataset.
    bool has(const std::string& path) const;

    /// One whole number, saturated to 64 bits with a sign.
    std::int64_t whole_number(const std::string& path);

    /// A list of whole numbers, saturated to the range of int.
    std::vector<int> whole_numbers(const std::string& path);

    /// A list of floating-point numbers, which need not be finite.
    Eigen::VectorXd numbers(const std::string& path);

    /// A text of fixed or variable length up to its first null character, as it stands in the file.
    std::string text(const std::string& path);

    /// @throws InputError always: "file: path problem"
    [[noreturn]] void refuse(const std::string& path, const std::string& problem) const;

private:
    /// A dataset whose size, and place in the file, have been checked.
    struct Dataset {
        Hdf5Id id;
        Hdf5Id type;
        std::size_t length;   ///< values; 1 of one value that is no list
        std::size_t size;     ///< of a value [B]
        bool written;         ///< else HDF5 gives the value that stands for nothing, mostly 0
        std::uint64_t offset; ///< of the first in the file [B]
    };

    QuietHdf5 quiet_;
    std::string_view bytes_;
    std::string name_;
    std::uint64_t left_; ///< how much may still be read [B]
    Hdf5Id file_;

    Dataset open(const std::string& path);
    std::size_t length(const std::string& path, hid_t dataset) const;
    void check_storage(const std::string& path, const Dataset& dataset) const;
    void spend(const std::string& path, const Dataset& dataset);
    void read(const std::string& path, const Dataset& dataset, hid_t type, void* values) const;
    std::string variable_text(const std::string& path, const Dataset& dataset) const;
    std::string_view heap_object(const std::string& path, std::uint64_t heap, std::uint32_t index) const;
    [[noreturn]] void refuse_with_reason(const std::string& path) const;
};

} // namespace talus
