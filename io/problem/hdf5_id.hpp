// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <hdf5.h>

#include <string>
#include <utility>

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
    Hdf5Id(Hdf5Id&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)) {}
    Hdf5Id& operator=(Hdf5Id&& other) noexcept
    {
        std::swap(id_, other.id_);
        return *this;
    }

    operator hid_t() const { return id_; } ///< < 0 where HDF5 failed

private:
    hid_t id_;
};

/// Keeps HDF5 from printing its errors as long as it lives.
class QuietHdf5
{
public:
    QuietHdf5()
    {
        H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    }
    ~QuietHdf5() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
    QuietHdf5(const QuietHdf5&) = delete;
    QuietHdf5& operator=(const QuietHdf5&) = delete;

private:
    H5E_auto2_t print_ = nullptr;
    void* data_ = nullptr;
};

/// The innermost of HDF5's errors since its last call, one line.
std::string hdf5_error();

} // namespace talus
