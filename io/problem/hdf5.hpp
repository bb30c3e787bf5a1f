// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <hdf5.h>

#include <string>
#include <vector>

namespace talus
{

/// What HDF5 knows by a number, a file, a dataset or a list of settings: closed when this goes.
class Hdf5Id
{
public:
    explicit Hdf5Id(hid_t id) : id_(id) {}
    ~Hdf5Id()
    {
        if (id_ >= 0) H5Idec_ref(id_);
    }
    Hdf5Id(const Hdf5Id&) = delete;
    Hdf5Id& operator=(const Hdf5Id&) = delete;

    operator hid_t() const { return id_; } ///< < 0 where HDF5 failed

private:
    hid_t id_;
};

/// Has HDF5's errors kept instead of printed, as long as it lives.
class Hdf5Errors
{
public:
    Hdf5Errors();
    ~Hdf5Errors();
    Hdf5Errors(const Hdf5Errors&) = delete;
    Hdf5Errors& operator=(const Hdf5Errors&) = delete;

    /// The innermost reason of the first error, on one line.
    std::string reason() const;

private:
    std::string first_;
    H5E_auto2_t print_ = nullptr; ///< what was done with errors before
    void* data_ = nullptr;
};

/// The datasets of an HDF5 file, each a list or one value. Names are whole paths: /fclib_local/W/m.
///
/// Every function throws InputError where a dataset is missing, holds another kind of values or cannot be read, with a
/// sentence that begins with the names of the file and of the dataset.
class Hdf5Reader
{
public:
    /// @param bytes of the whole file
    /// @param name of the file in sentences
    /// @throws InputError where they are no HDF5 file
    Hdf5Reader(std::string bytes, std::string name);

    /// Whether there is such a group or dataset.
    bool has(const std::string& path) const;

    /// One whole number, saturated to the range of int.
    int whole_number(const std::string& path) const;

    /// A list of whole numbers, saturated to the range of int.
    std::vector<int> whole_numbers(const std::string& path) const;

    /// A list of floating-point numbers, which need not be finite.
    Eigen::VectorXd numbers(const std::string& path) const;

    /// A text of fixed or variable length up to its first null character, as it stands in the file.
    std::string text(const std::string& path) const;

    /// @throws InputError always: "file: path problem"
    [[noreturn]] void refuse(const std::string& path, const std::string& problem) const;

private:
    Hdf5Errors errors_;
    std::string bytes_;
    std::string name_;
    Hdf5Id file_;

    std::size_t length(const std::string& path, H5T_class_t wanted, const char* kind) const;
    void check(herr_t result, const std::string& path) const;
};

/// Builds an HDF5 file in memory. Names are whole paths, and the groups on the way are made; datasets are stored in one
/// piece and uncompressed, and the same content gives the same bytes.
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
    Hdf5Errors errors_;
    std::string name_;
    Hdf5Id file_;
    Hdf5Id links_;    ///< settings: make the groups on the way
    Hdf5Id datasets_; ///< settings: do not write down the time

    void add(const std::string& path, hid_t type, hid_t space, const void* values);
    void check(hid_t result, const std::string& path) const;
};

} // namespace talus
