// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/problem/fclib.hpp"
#include "io/problem/hdf5.hpp"
#include "io/text/input_error.hpp"
#include "tests/io/scene_folder.hpp"

#include <catch2/catch.hpp>

#include <functional>

using namespace talus;
using namespace talus::test;

namespace
{

std::string whole_file()
{
    return read_file(std::filesystem::path(TALUS_SOURCE_DIR) / "tests/data/fclib/local_problem_test.hdf5");
}

std::string refusal_of(const std::string& bytes, const std::function<void(const Hdf5Reader&)>& read)
{
    return error_of<InputError>([&] { read(Hdf5Reader(bytes, "p.hdf5")); });
}

/// A file that is written by the means of HDF5.
std::string bytes_of(const std::function<void(hid_t file)>& write)
{
    const SceneFolder folder;
    const auto path = folder.path() / "p.hdf5";
    {
        const Hdf5Id file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
        write(file);
    }
    return read_file(path);
}

/// Writes the dataset /list.
void write_list(hid_t file, hid_t type, std::vector<hsize_t> extent, const void* values, hid_t settings = H5P_DEFAULT)
{
    const Hdf5Id space(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr));
    const Hdf5Id list(H5Dcreate2(file, "/list", type, space, H5P_DEFAULT, settings, H5P_DEFAULT));
    if (values) H5Dwrite(list, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
}

/// A file with the numbers 0 to 9999 in compressed pieces.
std::string compressed_file()
{
    return bytes_of([](hid_t file) {
        const Hdf5Id settings(H5Pcreate(H5P_DATASET_CREATE));
        const hsize_t chunk = 300;
        H5Pset_chunk(settings, 1, &chunk);
        H5Pset_deflate(settings, 6);
        const Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(10000, 0.0, 9999.0);
        write_list(file, H5T_NATIVE_DOUBLE, {10000}, values.data(), settings);
    });
}

} // namespace

TEST_CASE("a list that is stored in compressed pieces is read", "[hdf5]")
{
    const std::string bytes = compressed_file();
    CHECK(bytes.size() < 8 * 10000);
    CHECK(Hdf5Reader(bytes, "p.hdf5").numbers("/list") == Eigen::VectorXd::LinSpaced(10000, 0.0, 9999.0));
}

TEST_CASE("a problem that another tool has stored in compressed pieces is read", "[hdf5][fclib]")
{
    FclibProblem problem;
    problem.mu = Eigen::VectorXd::Constant(200, 0.5);
    problem.q = Eigen::VectorXd::LinSpaced(600, -1.0, 1.0);
    problem.W = Eigen::MatrixXd::Identity(600, 600).sparseView();
    const SceneFolder folder;
    const auto path = folder.path() / "p.hdf5";
    write_fclib(problem, path);
    {
        const Hdf5Id file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT));
        const Hdf5Id settings(H5Pcreate(H5P_DATASET_CREATE));
        const hsize_t extent = 600, chunk = 100;
        H5Pset_chunk(settings, 1, &chunk);
        H5Pset_shuffle(settings);
        H5Pset_deflate(settings, 9);
        const Hdf5Id space(H5Screate_simple(1, &extent, nullptr));
        for (const char* name : {"/fclib_local/vectors/q", "/fclib_local/W/x"}) {
            H5Ldelete(file, name, H5P_DEFAULT);
            const Hdf5Id list(H5Dcreate2(file, name, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, settings, H5P_DEFAULT));
            const Eigen::VectorXd ones = Eigen::VectorXd::Ones(600);
            const auto& values = std::string(name).ends_with("q") ? problem.q : ones;
            H5Dwrite(list, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
        }
    }
    const FclibProblem again = read_fclib(path);
    CHECK(again.q == problem.q);
    CHECK((again.W - problem.W).norm() == 0.0);
}

TEST_CASE("numbers of other sizes and byte orders are read", "[hdf5]")
{
    const std::vector<float> floats = {0.5f, -2.0f};
    const std::string single = bytes_of([&](hid_t file) { write_list(file, H5T_NATIVE_FLOAT, {2}, floats.data()); });
    CHECK(Hdf5Reader(single, "p.hdf5").numbers("/list") == Eigen::Vector2d(0.5, -2.0));
    const std::vector<std::int64_t> longs = {7, std::int64_t{1} << 40}; // saturated
    const std::string wide = bytes_of([&](hid_t file) { write_list(file, H5T_NATIVE_INT64, {2}, longs.data()); });
    CHECK(Hdf5Reader(wide, "p.hdf5").whole_numbers("/list") == std::vector<int>{7, 2147483647});
    const std::string foreign = bytes_of([&](hid_t file) {
        const unsigned char big_endian[2] = {1, 2};
        write_list(file, H5T_STD_U16BE, {1}, big_endian);
    });
    CHECK(Hdf5Reader(foreign, "p.hdf5").whole_number("/list") == 258);
}

TEST_CASE("a dataset of another kind or shape is refused with what it must be", "[hdf5]")
{
    const auto refusal = [](hid_t type, const std::vector<hsize_t>& extent,
                             const std::function<void(const Hdf5Reader&)>& read) {
        return refusal_of(bytes_of([&](hid_t file) { write_list(file, type, extent, nullptr); }), read);
    };
    const auto numbers = [](const Hdf5Reader& file) { file.numbers("/list"); };
    const auto whole_number = [](const Hdf5Reader& file) { file.whole_number("/list"); };
    const auto text = [](const Hdf5Reader& file) { file.text("/list"); };
    CHECK(refusal(H5T_NATIVE_DOUBLE, {2}, numbers) == "no error");
    CHECK(refusal(H5T_NATIVE_DOUBLE, {1, 2}, numbers) == "p.hdf5: /list must be a list, not an array of 2 dimensions");
    CHECK(refusal(H5T_NATIVE_INT, {2}, numbers) == "p.hdf5: /list must be floating-point numbers");
    CHECK(refusal(H5T_NATIVE_DOUBLE, {1}, whole_number) == "p.hdf5: /list must be whole numbers");
    CHECK(refusal(H5T_NATIVE_INT, {3}, whole_number) == "p.hdf5: /list must be one number, not 3");
    CHECK(refusal(H5T_NATIVE_INT, {1}, text) == "p.hdf5: /list must be one text");
    CHECK(refusal(H5T_C_S1, {2}, text) == "p.hdf5: /list must be one text");
    const Hdf5Id opaque(H5Tcreate(H5T_OPAQUE, 8));
    CHECK(refusal(opaque, {0}, numbers) == "p.hdf5: /list must be floating-point numbers");
    CHECK(refusal(H5T_NATIVE_INT, {1}, [](const Hdf5Reader& file) { file.numbers("/lost"); }) ==
          "p.hdf5: /lost is missing");
    CHECK(refusal(H5T_NATIVE_INT, {1}, [](const Hdf5Reader& file) {
        file.numbers("/");
    }).starts_with("p.hdf5: / cannot be read by HDF5: "));
}

TEST_CASE("a damaged piece of a dataset is refused", "[hdf5]")
{
    std::string bytes = compressed_file();
    const std::size_t piece = bytes.rfind("\x78\x9c"); // zlib's first bytes at this level
    REQUIRE(piece != std::string::npos);
    bytes.replace(piece + 2, 40, std::string(40, '\xff'));
    CHECK(refusal_of(bytes, [](const Hdf5Reader& file) { file.numbers("/list"); }) ==
          "p.hdf5: /list cannot be read by HDF5: inflate() failed");
}

TEST_CASE("a file that was cut is refused, wherever it was cut", "[hdf5]")
{
    const std::string whole = whole_file();
    const auto refusal = [](const std::string& bytes) { return refusal_of(bytes, [](const Hdf5Reader&) {}); };
    CHECK(refusal(whole.substr(0, whole.size() - 1)) ==
          "p.hdf5: HDF5 cannot read it: truncated file: eof = 82175, sblock->base_addr = 0, stored_eof = 82176");
    CHECK(refusal(whole.substr(0, 7)) == "p.hdf5: not an HDF5 file");
    for (const std::size_t size : {8, 20, 60, 96, 500, 2000, 4096, 40000, 80000}) {
        INFO(size);
        CHECK(refusal(whole.substr(0, size)).starts_with("p.hdf5: HDF5 cannot read it: "));
    }
}
