// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/problem/hdf5_writer.hpp"

#include "io/text/input_error.hpp"

#include <fmt/format.h>

namespace talus
{

namespace
{

Hdf5Id create_in_memory()
{
    constexpr std::size_t step = std::size_t{1} << 20; // in which the file grows [B]
    const Hdf5Id access(H5Pcreate(H5P_FILE_ACCESS));
    H5Pset_fapl_core(access, step, false);
    H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
    return Hdf5Id(H5Fcreate("file in memory", H5F_ACC_TRUNC, H5P_DEFAULT, access));
}

Hdf5Id list_of(std::size_t length)
{
    const hsize_t extent = length;
    return Hdf5Id(H5Screate_simple(1, &extent, nullptr));
}

} // namespace

Hdf5Writer::Hdf5Writer(std::string name)
    : name_(std::move(name)), file_(create_in_memory()), links_(H5Pcreate(H5P_LINK_CREATE)),
      datasets_(H5Pcreate(H5P_DATASET_CREATE))
{
    check(file_, "/");
    check(H5Pset_create_intermediate_group(links_, 1), "/");
    check(H5Pset_obj_track_times(datasets_, false), "/");
}

void Hdf5Writer::check(hid_t result, const std::string& path) const
{
    if (result < 0) throw OutputError(fmt::format("{}: HDF5 cannot write {}: {}", name_, path, hdf5_error()));
}

void Hdf5Writer::add_group(const std::string& path)
{
    check(Hdf5Id(H5Gcreate2(file_, path.c_str(), links_, H5P_DEFAULT, H5P_DEFAULT)), path);
}

void Hdf5Writer::add(const std::string& path, hid_t stored, hid_t type, hid_t space, const void* values)
{
    const Hdf5Id dataset(H5Dcreate2(file_, path.c_str(), stored, space, links_, datasets_, H5P_DEFAULT));
    check(dataset, path);
    check(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), path);
}

void Hdf5Writer::add(const std::string& path, int value)
{
    add(path, std::vector<int>{value});
}

void Hdf5Writer::add(const std::string& path, const std::vector<int>& values)
{
    add(path, H5T_STD_I32LE, H5T_NATIVE_INT, list_of(values.size()), values.data());
}

void Hdf5Writer::add(const std::string& path, const Eigen::VectorXd& values)
{
    add(path, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, list_of(static_cast<std::size_t>(values.size())), values.data());
}

void Hdf5Writer::add(const std::string& path, const std::string& text)
{
    const Hdf5Id type(H5Tcopy(H5T_C_S1));
    check(H5Tset_size(type, text.size() + 1), path);
    add(path, type, type, Hdf5Id(H5Screate(H5S_SCALAR)), text.c_str());
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
