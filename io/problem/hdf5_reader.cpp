// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/problem/hdf5_reader.hpp"

#include "io/text/input_error.hpp"
#include "io/text/sentence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <initializer_list>

namespace talus
{

namespace
{

/// HDF5 asks for copies of the file's bytes; it gets the bytes themselves, which it only reads.
H5FD_file_image_callbacks_t no_copies(void* bytes)
{
    H5FD_file_image_callbacks_t callbacks{};
    callbacks.image_malloc = [](std::size_t, H5FD_file_image_op_t, void* data) { return data; };
    callbacks.image_memcpy = [](void* to, const void*, std::size_t, H5FD_file_image_op_t, void*) { return to; };
    callbacks.image_realloc = [](void*, std::size_t, H5FD_file_image_op_t, void*) -> void* { return nullptr; };
    callbacks.image_free = [](void*, H5FD_file_image_op_t, void*) -> herr_t { return 0; };
    callbacks.udata_copy = [](void* data) { return data; };
    callbacks.udata_free = [](void*) -> herr_t { return 0; };
    callbacks.udata = bytes;
    return callbacks;
}

/// A file in memory, for reading.
Hdf5Id open_bytes(std::string_view bytes, const std::string& name)
{
    if (!bytes.starts_with("\x89HDF\r\n\x1a\n")) throw InputError(fmt::format("{}: not an HDF5 file", name));
    const Hdf5Id access(H5Pcreate(H5P_FILE_ACCESS));
    void* image = const_cast<char*>(bytes.data());
    H5FD_file_image_callbacks_t callbacks = no_copies(image);
    H5Pset_fapl_core(access, 1, false);
    H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
    H5Pset_file_image_callbacks(access, &callbacks);
    H5Pset_file_image(access, image, bytes.size());
    Hdf5Id file(H5Fopen("bytes in memory", H5F_ACC_RDONLY, access));
    if (file < 0) throw InputError(fmt::format("{}: HDF5 cannot read it: {}", name, hdf5_error()));
    return file;
}

/// In the dataset of a text of variable length: the length (4), the address of a heap (8), an index in it (4) [B].
constexpr std::size_t variable_text_size = 16;

bool is_one_of(hid_t type, std::initializer_list<hid_t> kinds)
{
    return std::ranges::any_of(kinds, [&](hid_t kind) { return H5Tequal(type, kind) > 0; });
}

bool is_floating_point(hid_t type)
{
    return is_one_of(type, {H5T_IEEE_F64LE, H5T_IEEE_F32LE, H5T_IEEE_F64BE, H5T_IEEE_F32BE});
}

bool is_whole(hid_t type)
{
    return is_one_of(type, {H5T_STD_I32LE, H5T_STD_I64LE, H5T_STD_U32LE, H5T_STD_U64LE, H5T_STD_I32BE, H5T_STD_I64BE,
                               H5T_STD_U32BE, H5T_STD_U64BE, H5T_STD_I16LE, H5T_STD_U16LE, H5T_STD_I8LE, H5T_STD_U8LE});
}

/// A whole number of the file, whose numbers are little-endian. @pre it lies within the bytes
template <class Whole> Whole whole_at(std::string_view bytes, std::uint64_t offset)
{
    Whole value = 0;
    for (std::size_t i = sizeof(Whole); i-- > 0;)
        value = static_cast<Whole>(value << 8 | static_cast<unsigned char>(bytes[offset + i]));
    return value;
}

bool lies_within(std::uint64_t offset, std::uint64_t size, std::string_view bytes)
{
    return size <= bytes.size() && offset <= bytes.size() - size;
}

std::string up_to_null(std::string text)
{
    text.erase(std::min(text.find('\0'), text.size()));
    return text;
}

} // namespace

std::string hdf5_error()
{
    std::string reason;
    const auto keep_first = [](unsigned depth, const H5E_error2_t* error, void* text) -> herr_t {
        if (depth == 0 && error->desc) *static_cast<std::string*>(text) = error->desc;
        return 0;
    };
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &reason);
    return reason.empty() ? "no reason given" : one_line(reason);
}

Hdf5Reader::Hdf5Reader(std::string_view bytes, std::string name)
    : bytes_(bytes), name_(std::move(name)), left_(2 * bytes.size()), file_(open_bytes(bytes_, name_))
{
}

void Hdf5Reader::refuse(const std::string& path, const std::string& problem) const
{
    throw InputError(fmt::format("{}: {} {}", name_, path, problem));
}

void Hdf5Reader::refuse_with_reason(const std::string& path) const
{
    refuse(path, fmt::format("cannot be read by HDF5: {}", hdf5_error()));
}

bool Hdf5Reader::has(const std::string& path) const
{
    for (std::size_t end = 0; end != std::string::npos;) {
        end = path.find('/', end + 1);
        const std::string part = path.substr(0, end);
        const htri_t exists = H5Lexists(file_, part.c_str(), H5P_DEFAULT);
        if (exists < 0) refuse_with_reason(part);
        if (exists == 0) return false;
        H5L_info_t link;
        if (H5Lget_info(file_, part.c_str(), &link, H5P_DEFAULT) < 0) refuse_with_reason(part);
        if (link.type != H5L_TYPE_HARD) refuse(part, "is a link to another place, which is not followed");
    }
    return true;
}

Hdf5Reader::Dataset Hdf5Reader::open(const std::string& path)
{
    if (!has(path)) refuse(path, "is missing");
    Hdf5Id object(H5Oopen(file_, path.c_str(), H5P_DEFAULT));
    if (object < 0) refuse_with_reason(path);
    if (H5Iget_type(object) != H5I_DATASET) refuse(path, "must be a dataset, not a group");

    Hdf5Id type(H5Dget_type(object));
    if (type < 0) refuse_with_reason(path);
    const std::size_t size = H5Tis_variable_str(type) > 0 ? variable_text_size : H5Tget_size(type);
    const std::size_t values = length(path, object);
    const std::uint64_t offset = H5Dget_offset(object);
    const bool written = H5Dget_storage_size(object) > 0;
    Dataset dataset{std::move(object), std::move(type), values, size, written, offset};
    check_storage(path, dataset);
    spend(path, dataset);
    return dataset;
}

/// Refuses what would need more room than the file justifies, and takes it off what is left.
void Hdf5Reader::spend(const std::string& path, const Dataset& dataset)
{
    const std::uint64_t most = left_ / std::max<std::uint64_t>(dataset.size, 1);
    if (dataset.length > most)
        refuse(path, fmt::format("has {} values; with them the file says it has more than its {} bytes can hold",
                         dataset.length, bytes_.size()));
    left_ -= dataset.length * dataset.size;
}

std::size_t Hdf5Reader::length(const std::string& path, hid_t dataset) const
{
    const Hdf5Id space(H5Dget_space(dataset));
    if (space < 0) refuse_with_reason(path);
    const H5S_class_t kind = H5Sget_simple_extent_type(space);
    if (kind == H5S_SCALAR) return 1;
    if (kind != H5S_SIMPLE) refuse(path, "holds no values");
    const int dimensions = H5Sget_simple_extent_ndims(space);
    if (dimensions != 1) refuse(path, fmt::format("must be a list, not an array of {} dimensions", dimensions));
    hsize_t extent = 0;
    H5Sget_simple_extent_dims(space, &extent, nullptr);
    return extent;
}

/// Checks that the values lie in the file, in one piece, before any room is made for them.
void Hdf5Reader::check_storage(const std::string& path, const Dataset& dataset) const
{
    const Hdf5Id settings(H5Dget_create_plist(dataset.id));
    if (settings < 0) refuse_with_reason(path);
    if (H5Pget_layout(settings) != H5D_CONTIGUOUS || H5Pget_external_count(settings) != 0)
        refuse(path, "must be stored in one piece, uncompressed (as h5repack -f NONE -l CONTI does)");
    const std::uint64_t stored = H5Dget_storage_size(dataset.id);
    if (!dataset.written) return;
    if (dataset.size == 0 || stored / dataset.size != dataset.length || stored % dataset.size != 0)
        refuse(
            path, fmt::format("has {} values of {} bytes, but {} bytes stored", dataset.length, dataset.size, stored));
    if (!lies_within(dataset.offset, stored, bytes_))
        refuse(path, fmt::format("has {} bytes, which do not lie within the file's {}", stored, bytes_.size()));
}

void Hdf5Reader::read(const std::string& path, const Dataset& dataset, hid_t type, void* values) const
{
    if (dataset.length == 0) return;
    if (H5Dread(dataset.id, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) refuse_with_reason(path);
}

std::int64_t Hdf5Reader::whole_number(const std::string& path)
{
    const Dataset dataset = open(path);
    if (!is_whole(dataset.type)) refuse(path, "must be a whole number of 8 to 64 bits");
    if (dataset.length != 1) refuse(path, fmt::format("must be one number, not {}", dataset.length));
    std::int64_t value = 0;
    read(path, dataset, H5T_NATIVE_INT64, &value);
    return value;
}

std::vector<int> Hdf5Reader::whole_numbers(const std::string& path)
{
    const Dataset dataset = open(path);
    if (!is_whole(dataset.type)) refuse(path, "must be whole numbers of 8 to 64 bits");
    std::vector<int> values(dataset.length);
    read(path, dataset, H5T_NATIVE_INT, values.data());
    return values;
}

Eigen::VectorXd Hdf5Reader::numbers(const std::string& path)
{
    const Dataset dataset = open(path);
    if (!is_floating_point(dataset.type)) refuse(path, "must be floating-point numbers of 32 or 64 bits");
    Eigen::VectorXd values(static_cast<Eigen::Index>(dataset.length));
    read(path, dataset, H5T_NATIVE_DOUBLE, values.data());
    return values;
}

std::string Hdf5Reader::text(const std::string& path)
{
    const Dataset dataset = open(path);
    if (H5Tget_class(dataset.type) != H5T_STRING || dataset.length != 1) refuse(path, "must be one text");
    if (!dataset.written) return "";
    if (H5Tis_variable_str(dataset.type) > 0) return up_to_null(variable_text(path, dataset));
    return up_to_null(std::string(bytes_.substr(dataset.offset, dataset.size)));
}

/// A text in the file's heap, found without HDF5: its release 1.10 makes room for as many bytes as the dataset says,
/// up to 4 GiB, and copies as many as the heap says.
std::string Hdf5Reader::variable_text(const std::string& path, const Dataset& dataset) const
{
    const auto size = whole_at<std::uint32_t>(bytes_, dataset.offset);
    const auto heap = whole_at<std::uint64_t>(bytes_, dataset.offset + 4);
    const auto index = whole_at<std::uint32_t>(bytes_, dataset.offset + 12);
    if (size == 0) return "";
    const std::string_view object = heap_object(path, heap, index);
    if (object.size() != size)
        refuse(path, fmt::format("must be {} bytes of text, but the file's heap has {}", size, object.size()));
    return std::string(object);
}

/// An object of a global heap collection: "GCOL", version, 3 bytes of nothing and its size; then the objects, each
/// with index, number of references, 4 bytes of nothing and its size, filled up to 8 bytes; index 0 is what is free.
/// [HDF5 File Format Specification 3.0, III.E]
std::string_view Hdf5Reader::heap_object(const std::string& path, std::uint64_t heap, std::uint32_t index) const
{
    constexpr std::uint64_t header = 16;
    if (!lies_within(heap, header, bytes_) || bytes_.substr(heap, 4) != "GCOL")
        refuse(path, "is in a heap that is not in the file");
    const auto size = whole_at<std::uint64_t>(bytes_, heap + 8);
    const std::string_view collection = bytes_.substr(heap, std::min<std::uint64_t>(size, bytes_.size() - heap));
    for (std::uint64_t at = header; lies_within(at, header, collection);) {
        const auto object_index = whole_at<std::uint16_t>(collection, at);
        const auto object_size = whole_at<std::uint64_t>(collection, at + 8);
        at += header;
        if (object_index == 0 || !lies_within(at, object_size, collection)) break;
        if (object_index == index) return collection.substr(at, object_size);
        at += (object_size + 7) / 8 * 8;
    }
    refuse(path, "is not in the file's heap");
}

} // namespace talus
