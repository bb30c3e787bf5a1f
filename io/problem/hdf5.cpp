// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/problem/hdf5.hpp"

#include "io/text/input_error.hpp"
#include "io/text/sentence.hpp"

#include <fmt/format.h>
#include <hdf5_hl.h>

namespace talus
{

namespace
{

/// Keeps the innermost reason of an error, unless there is one already.
herr_t keep_reason(hid_t stack, void* kept)
{
    std::string& first = *static_cast<std::string*>(kept);
    const auto keep_innermost = [](unsigned depth, const H5E_error2_t* error, void* reason) -> herr_t {
        if (depth == 0 && error->desc) *static_cast<std::string*>(reason) = error->desc;
        return 0;
    };
    return first.empty() ? H5Ewalk2(stack, H5E_WALK_UPWARD, keep_innermost, &first) : 0;
}

hid_t open_in_memory(std::string& bytes, const std::string& name)
{
    if (!bytes.starts_with("\x89HDF\r\n\x1a\n")) throw InputError(name + ": not an HDF5 file");
    return H5LTopen_file_image(bytes.data(), bytes.size(), H5LT_FILE_IMAGE_DONT_COPY | H5LT_FILE_IMAGE_DONT_RELEASE);
}

hid_t create_in_memory()
{
    constexpr std::size_t step = std::size_t{1} << 20; // in which the file grows [B]
    const Hdf5Id access(H5Pcreate(H5P_FILE_ACCESS));
    H5Pset_fapl_core(access, step, false);
    return H5Fcreate("file in memory", H5F_ACC_TRUNC, H5P_DEFAULT, access);
}

Hdf5Id list_of(std::size_t length)
{
    const hsize_t extent = length;
    return Hdf5Id(H5Screate_simple(1, &extent, nullptr));
}

} // namespace

Hdf5Errors::Hdf5Errors()
{
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, keep_reason, &first_);
}

Hdf5Errors::~Hdf5Errors()
{
    H5Eset_auto2(H5E_DEFAULT, print_, data_);
}

std::string Hdf5Errors::reason() const
{
    return first_.empty() ? "no reason given" : one_line(first_);
}

Hdf5Reader::Hdf5Reader(std::string bytes, std::string name)
    : bytes_(std::move(bytes)), name_(std::move(name)), file_(open_in_memory(bytes_, name_))
{
    if (file_ < 0) throw InputError(fmt::format("{}: HDF5 cannot read it: {}", name_, errors_.reason()));
}

void Hdf5Reader::refuse(const std::string& path, const std::string& problem) const
{
    throw InputError(fmt::format("{}: {} {}", name_, path, problem));
}

void Hdf5Reader::check(herr_t result, const std::string& path) const
{
    if (result < 0) refuse(path, fmt::format("cannot be read by HDF5: {}", errors_.reason()));
}

bool Hdf5Reader::has(const std::string& path) const
{
    const htri_t valid = H5LTpath_valid(file_, path.c_str(), true);
    check(valid, path);
    return valid > 0;
}

/// The number of values in a dataset: 1 of one value that is no list.
std::size_t Hdf5Reader::length(const std::string& path, H5T_class_t wanted, const char* kind) const
{
    if (!has(path)) refuse(path, "is missing");
    int dimensions = 0;
    check(H5LTget_dataset_ndims(file_, path.c_str(), &dimensions), path);
    if (dimensions > 1) refuse(path, fmt::format("must be a list, not an array of {} dimensions", dimensions));
    hsize_t extent = 1;
    H5T_class_t found = H5T_NO_CLASS;
    std::size_t size = 0;
    check(H5LTget_dataset_info(file_, path.c_str(), &extent, &found, &size), path);
    if (found != wanted) refuse(path, fmt::format("must be {}", kind));
    return extent;
}

int Hdf5Reader::whole_number(const std::string& path) const
{
    const std::vector<int> values = whole_numbers(path);
    if (values.size() != 1) refuse(path, fmt::format("must be one number, not {}", values.size()));
    return values.front();
}

std::vector<int> Hdf5Reader::whole_numbers(const std::string& path) const
{
    std::vector<int> values(length(path, H5T_INTEGER, "whole numbers"));
    check(H5LTread_dataset_int(file_, path.c_str(), values.data()), path);
    return values;
}

Eigen::VectorXd Hdf5Reader::numbers(const std::string& path) const
{
    Eigen::VectorXd values(static_cast<Eigen::Index>(length(path, H5T_FLOAT, "floating-point numbers")));
    check(H5LTread_dataset_double(file_, path.c_str(), values.data()), path);
    return values;
}

std::string Hdf5Reader::text(const std::string& path) const
{
    if (length(path, H5T_STRING, "one text") != 1) refuse(path, "must be one text");
    const Hdf5Id dataset(H5Dopen2(file_, path.c_str(), H5P_DEFAULT)), type(H5Dget_type(dataset));
    if (H5Tis_variable_str(type) > 0) {
        char* variable = nullptr; // HDF5 makes the room
        check(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, &variable), path);
        const std::string text = variable ? variable : "";
        H5free_memory(variable);
        return text;
    }
    std::string text(H5Tget_size(type), '\0');
    check(H5LTread_dataset_string(file_, path.c_str(), text.data()), path);
    return text.c_str();
}

Hdf5Writer::Hdf5Writer(std::string name)
    : name_(std::move(name)), file_(create_in_memory()), links_(H5Pcreate(H5P_LINK_CREATE)),
      datasets_(H5Pcreate(H5P_DATASET_CREATE))
{
    check(file_, "/");
    check(H5Pset_create_intermediate_group(links_, 1), "/");
    check(H5Pset_obj_track_times(datasets_, false), "/"); // which H5LTmake_dataset cannot be asked for
}

void Hdf5Writer::check(hid_t result, const std::string& path) const
{
    if (result < 0) throw OutputError(fmt::format("{}: HDF5 cannot write {}: {}", name_, path, errors_.reason()));
}

void Hdf5Writer::add_group(const std::string& path)
{
    check(Hdf5Id(H5Gcreate2(file_, path.c_str(), links_, H5P_DEFAULT, H5P_DEFAULT)), path);
}

void Hdf5Writer::add(const std::string& path, hid_t type, hid_t space, const void* values)
{
    const Hdf5Id dataset(H5Dcreate2(file_, path.c_str(), type, space, links_, datasets_, H5P_DEFAULT));
    check(dataset, path);
    check(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), path);
}

void Hdf5Writer::add(const std::string& path, int value)
{
    add(path, std::vector<int>{value});
}

void Hdf5Writer::add(const std::string& path, const std::vector<int>& values)
{
    add(path, H5T_NATIVE_INT, list_of(values.size()), values.data());
}

void Hdf5Writer::add(const std::string& path, const Eigen::VectorXd& values)
{
    add(path, H5T_NATIVE_DOUBLE, list_of(static_cast<std::size_t>(values.size())), values.data());
}

void Hdf5Writer::add(const std::string& path, const std::string& text)
{
    const Hdf5Id type(H5Tcopy(H5T_C_S1));
    check(H5Tset_size(type, text.size() + 1), path);
    add(path, type, Hdf5Id(H5Screate(H5S_SCALAR)), text.c_str());
}

std::string Hdf5Writer::bytes() const
{
    check(H5Fflush(file_, H5F_SCOPE_LOCAL), "/");
    const ssize_t size = H5Fget_file_image(file_, nullptr, 0);
    check(size, "/");
    std::string bytes(static_cast<std::size_t>(size), '\0');
    check(H5Fget_file_image(file_, bytes.data(), bytes.size()), "/");
    return bytes;
}

} // namespace talus
