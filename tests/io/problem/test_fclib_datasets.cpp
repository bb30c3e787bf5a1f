// SPDX-License-Identifier: GPL-3.0-or-later
/// Files of contact problems, written dataset by dataset, some of them wrong.
#include "io/problem/fclib.hpp"
#include "io/problem/hdf5.hpp"
#include "io/text/input_error.hpp"
#include "tests/io/scene_folder.hpp"

#include <catch2/catch.hpp>

#include <limits>
#include <map>
#include <optional>
#include <variant>

using namespace talus;
using namespace talus::test;
using Eigen::VectorXd;

namespace
{

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

VectorXd vector(std::initializer_list<double> values)
{
    return Eigen::Map<const VectorXd>(values.begin(), static_cast<Eigen::Index>(values.size()));
}

using Value = std::variant<int, std::vector<int>, VectorXd, std::string>;
using Content = std::map<std::string, Value>;

/// One contact in the plane, W = (1 2; 3 4).
Content local_content()
{
    const std::string group = "/fclib_local";
    return {{group + "/spacedim", 2}, {group + "/vectors/mu", vector({0.5})}, {group + "/vectors/q", vector({-1, 2})},
        {group + "/W/m", 2}, {group + "/W/n", 2}, {group + "/W/nzmax", 4}, {group + "/W/nz", 4},
        {group + "/W/i", std::vector{0, 0, 1, 1}}, {group + "/W/p", std::vector{0, 1, 0, 1}},
        {group + "/W/x", vector({1, 2, 3, 4})}, {group + "/info/title", std::string("one contact")}};
}

/// One body of one coordinate, one contact with rolling friction, a constraint.
Content rolling_content()
{
    const std::string group = "/fclib_global_rolling";
    const auto one_entry = [](int columns) {
        return Content{{"/m", 1}, {"/n", columns}, {"/nzmax", 1}, {"/nz", 1}, {"/i", std::vector{0}},
            {"/p", std::vector{0}}, {"/x", vector({1})}};
    };
    Content content = {{group + "/spacedim", 5}, {group + "/vectors/mu", vector({0.5})},
        {group + "/vectors/mu_r", vector({0.1})}, {group + "/vectors/f", vector({1})},
        {group + "/vectors/w", vector({1, 2, 3, 4, 5})}, {group + "/vectors/b", vector({1})}};
    for (const auto& [matrix, columns] : {std::pair{"/M", 1}, {"/H", 5}, {"/G", 1}})
        for (const auto& [name, value] : one_entry(columns)) content[group + matrix + name] = value;
    return content;
}

std::string bytes_of(const Content& content)
{
    Hdf5Writer file("in memory");
    for (const auto& [path, value] : content) std::visit([&, &p = path](const auto& v) { file.add(p, v); }, value);
    return file.bytes();
}

std::string refusal_of(const std::string& bytes)
{
    const SceneFolder folder;
    const auto path = folder.write("p.hdf5", bytes);
    return folder.without_folder(error_of<InputError>([&] { read_fclib(path); }));
}

/// A change of one dataset and what is said about it, without the name of the file.
struct Fault {
    std::string path;
    std::optional<Value> value; ///< none: the dataset is missing
    std::string sentence;
};

void check_refusal(Content content, const Fault& fault)
{
    INFO(fault.path);
    content.erase(fault.path);
    if (fault.value) content[fault.path] = *fault.value;
    CHECK(refusal_of(bytes_of(content)) == "p.hdf5: " + fault.sentence);
}

} // namespace

TEST_CASE("triplets, compressed columns and compressed rows give the same matrix", "[fclib]")
{
    Content content = local_content();
    const auto set = [&](const std::string& name, Value value) { content["/fclib_local/W/" + name] = value; };
    const Eigen::Matrix2d expected{{1, 2}, {3, 4}};
    const auto W = [&] {
        const SceneFolder folder;
        return Eigen::MatrixXd(read_fclib(folder.write("p.hdf5", bytes_of(content))).W);
    };
    CHECK(W() == expected);

    SECTION("compressed columns")
    {
        set("nz", -1);
        set("p", std::vector{0, 2, 4});
        set("i", std::vector{0, 1, 0, 1});
        set("x", vector({1, 3, 2, 4}));
        CHECK(W() == expected);
    }
    SECTION("compressed rows")
    {
        set("nz", -2);
        set("p", std::vector{0, 2, 4});
        set("i", std::vector{0, 1, 0, 1});
        CHECK(W() == expected);
    }
    SECTION("with more room than entries, which old releases of FCLIB wrote whole")
    {
        set("nzmax", 6);
        set("x", vector({1, 2, 3, 4, not_a_number, not_a_number}));
        CHECK(W() == expected);
    }
    SECTION("with an entry in two parts, and a zero")
    {
        set("nzmax", 6);
        set("nz", 6);
        set("i", std::vector{0, 0, 1, 1, 1, 0});
        set("p", std::vector{0, 1, 0, 1, 1, 1});
        set("x", vector({1, 2, 3, 3, 1, 0}));
        CHECK(W() == expected);
    }
}

TEST_CASE("a broken local problem is refused with what is wrong", "[fclib]")
{
    const std::string g = "/fclib_local", W = g + "/W";
    const std::vector<Fault> faults = {
        {g + "/spacedim", {}, "/fclib_local/spacedim is missing"},
        {g + "/spacedim", 5, "/fclib_local/spacedim must be 2 or 3, not 5"},
        {g + "/spacedim", 3, "/fclib_local/vectors/q must have 3 values, not 2"},
        {g + "/spacedim", vector({2}), "/fclib_local/spacedim must be whole numbers"},
        {g + "/spacedim", std::vector{2, 2}, "/fclib_local/spacedim must be one number, not 2"},
        {g + "/vectors/mu", {}, "/fclib_local/vectors/mu is missing"},
        {g + "/vectors/mu", vector({-0.5}), "/fclib_local/vectors/mu[0] must be at least 0, not -0.5"},
        {g + "/vectors/mu", vector({not_a_number}), "/fclib_local/vectors/mu[0] is nan, not a finite number"},
        {g + "/vectors/mu", vector({1, 1}), "/fclib_local/vectors/q must have 4 values, not 2"},
        {g + "/vectors/q", {}, "/fclib_local/vectors/q is missing"},
        {g + "/vectors/q", vector({1, infinity}), "/fclib_local/vectors/q[1] is inf, not a finite number"},
        {g + "/vectors/q", 1, "/fclib_local/vectors/q must be floating-point numbers"},
        {g + "/vectors/q", std::string("1, 2"), "/fclib_local/vectors/q must be floating-point numbers"},
        {W + "/m", {}, "/fclib_local/W/m is missing"},
        {W + "/m", 3, "/fclib_local/W/m must be 2 to go with the vectors, not 3"},
        {W + "/m", 2000000000, "/fclib_local/W/m must be 2 to go with the vectors, not 2000000000"},
        {W + "/n", -2, "/fclib_local/W/n must be 2 to go with the vectors, not -2"},
        {W + "/nzmax", -1, "/fclib_local/W/nzmax must be from 0 to 2147483647, not -1"},
        {W + "/nzmax", 3, "/fclib_local/W/nz must be from -2 to 3, not 4"},
        {W + "/nz", -3, "/fclib_local/W/nz must be from -2 to 4, not -3"},
        {W + "/nz", 3, "/fclib_local/W/i must have 3 values, not 4"},
        {W + "/nz", -1, "/fclib_local/W/p must have 3 values, not 4"},
        {W + "/i", {}, "/fclib_local/W/i is missing"},
        {W + "/i", vector({0, 0, 1, 1}), "/fclib_local/W/i must be whole numbers"},
        {W + "/i", std::vector{0, 0, 1}, "/fclib_local/W/i must have 4 values, not 3"},
        {W + "/i", std::vector{0, 0, 1, 2}, "/fclib_local/W has an entry in row 2; its rows are 0 to 1"},
        {W + "/p", std::vector{0, -1, 0, 1}, "/fclib_local/W has an entry in column -1; its columns are 0 to 1"},
        {W + "/p", std::vector{0, 1}, "/fclib_local/W/p must have 4 values, not 2"},
        {W + "/x", {}, "/fclib_local/W/x is missing"},
        {W + "/x", vector({1, 2, 3}), "/fclib_local/W/x must have 4 values, not 3"},
        {W + "/x", vector({1, not_a_number, 3, 4}), "/fclib_local/W/x[1] is nan, not a finite number"},
        {g + "/info/title", 7, "/fclib_local/info/title must be one text"},
        {g + "/V/m", 2, "/fclib_local/V states constraints, which are read in the global form only"},
        {"/solution/r", vector({1}), "/solution/r must have 2 values, not 1"},
        {"/solution/v", vector({1}), "/solution/v must have 0 values, not 1"},
        {"/solution/u", vector({1, -infinity}), "/solution/u[1] is -inf, not a finite number"},
        {"/guesses/1/u", vector({1, 2}), "/guesses/number_of_guesses is missing"},
        {"/guesses/number_of_guesses", -1, "/guesses/number_of_guesses must be at least 0, not -1"},
        {"/guesses/number_of_guesses", 2000000000, "/guesses/1 is missing, but there must be 2000000000 guesses"},
    };
    for (const Fault& fault : faults) check_refusal(local_content(), fault);
}

TEST_CASE("broken pointers are refused", "[fclib]")
{
    const std::string W = "/fclib_local/W";
    Content content = local_content();
    content[W + "/nz"] = GENERATE(-1, -2);
    content[W + "/p"] = std::vector{0, 2, 4};
    const std::vector<Fault> faults = {
        {W + "/p", std::vector{0, 4}, W + "/p must have 3 values, not 2"},
        {W + "/p", std::vector{1, 2, 4}, W + "/p must begin with 0, not 1"},
        {W + "/p", std::vector{0, 3, 2}, W + "/p must not fall, as it does from 3 to 2"},
        {W + "/p", std::vector{0, 2, 5}, W + "/p must end with at most nzmax = 4, not 5"},
        {W + "/nzmax", 2147483647, W + "/i must have 2147483647 values, not 4"},
        {W + "/x", vector({1, 2, 3}), W + "/x must have 4 values, not 3"},
    };
    for (const Fault& fault : faults) check_refusal(content, fault);
}

TEST_CASE("a broken global problem is refused with what is wrong", "[fclib]")
{
    const std::string g = "/fclib_global_rolling";
    CHECK(refusal_of(bytes_of(rolling_content())) == "no error");
    const std::vector<Fault> faults = {
        {g + "/spacedim", 3, g + "/spacedim must be 5, not 3"},
        {g + "/vectors/mu_r", {}, g + "/vectors/mu_r is missing"},
        {g + "/vectors/mu_r", vector({1, 1}), g + "/vectors/mu_r must have 1 values, not 2"},
        {g + "/vectors/mu_r", vector({-1}), g + "/vectors/mu_r[0] must be at least 0, not -1"},
        {g + "/vectors/f", vector({1, 2}), g + "/M/m must be 2 to go with the vectors, not 1"},
        {g + "/vectors/w", vector({1, 2, 3}), g + "/vectors/w must have 5 values, not 3"},
        {g + "/vectors/b", {}, g + "/vectors/b is missing"},
        {g + "/vectors/b", vector({1, 2}), g + "/G/n must be 2 to go with the vectors, not 1"},
        {g + "/M/x", vector({-infinity}), g + "/M/x[0] is -inf, not a finite number"},
        {g + "/H/n", 4, g + "/H/n must be 5 to go with the vectors, not 4"},
        {g + "/H/p", std::vector{5}, g + "/H has an entry in column 5; its columns are 0 to 4"},
        {g + "/G/m", 2, g + "/G/m must be 1 to go with the vectors, not 2"},
        {"/solution/l", vector({1, 2}), "/solution/l must have 1 values, not 2"},
    };
    for (const Fault& fault : faults) check_refusal(rolling_content(), fault);
}

TEST_CASE("what is no contact problem is refused", "[fclib]")
{
    CHECK(refusal_of("not HDF5") == "p.hdf5: not an HDF5 file");
    CHECK(refusal_of(bytes_of({{"/fclib/W/m", 1}})) ==
          "p.hdf5: /fclib_local, /fclib_global and /fclib_global_rolling are missing: it holds no contact problem");
    CHECK(refusal_of(bytes_of({{"/fclib_local", 1}}))
              .starts_with("p.hdf5: /fclib_local/spacedim cannot be read by HDF5: "));
    const SceneFolder folder;
    const auto refusal = [&](const std::filesystem::path& path) {
        return folder.without_folder(error_of<InputError>([&] { read_fclib(path); }));
    };
    CHECK(refusal(folder.path() / "none.hdf5") == "none.hdf5: no such file");
    CHECK(refusal(folder.write("empty.hdf5", "")) == "empty.hdf5: the file is empty");
    CHECK(refusal(folder.path()) == folder.path().string() + ": not an HDF5 file");
}
