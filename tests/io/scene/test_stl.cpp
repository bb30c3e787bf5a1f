// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/stl.hpp"
#include "io/text/input_error.hpp"
#include "tests/io/scene_folder.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstring>
#include <limits>

using namespace talus;
using namespace talus::test;

namespace
{

const std::string facet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

void append_bytes(std::string& bytes, auto value)
{
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
}

/// Two triangles of the unit square, as binary STL that says it has `count`.
std::string binary_square(std::uint32_t count = 2, float last_coordinate = 0.0F)
{
    std::string bytes = "solid in name only";
    bytes.resize(80, '\0');
    append_bytes(bytes, count);
    const float square[2][9] = {{0, 0, 0, 1, 0, 0, 1, 1, 0}, {0, 0, 0, 1, 1, 0, 0, 1, last_coordinate}};
    for (const auto& triangle : square) {
        for (int i = 0; i < 3; ++i) append_bytes(bytes, std::numeric_limits<float>::quiet_NaN()); // normal: not used
        for (const float coordinate : triangle) append_bytes(bytes, coordinate);
        append_bytes(bytes, std::uint16_t{0});
    }
    return bytes;
}

std::string refusal_of_stl(const std::string& bytes)
{
    const SceneFolder folder;
    const auto path = folder.write("w.stl", bytes);
    return folder.without_folder(error_of<InputError>([&] { read_stl(path); }));
}

TriangleSoup soup_of(const std::string& bytes)
{
    const SceneFolder folder;
    return read_stl(folder.write("w.stl", bytes));
}

} // namespace

TEST_CASE("an ASCII file gives its triangles", "[stl]")
{
    const TriangleSoup soup = soup_of("solid two words\n" + facet + "endsolid two words\n");
    REQUIRE(soup.triangles.size() == 1);
    const auto& [a, b, c] = soup.triangles[0];
    CHECK(soup.vertices[static_cast<std::size_t>(a)] == Vec3(0, 0, 0));
    CHECK(soup.vertices[static_cast<std::size_t>(b)] == Vec3(1, 0, 0));
    CHECK(soup.vertices[static_cast<std::size_t>(c)] == Vec3(0, 1, 0));
}

TEST_CASE("ASCII takes capitals, Windows line ends, signs, exponents and several solids", "[stl]")
{
    const TriangleSoup soup = soup_of("SOLID a\r\n FACET NORMAL 0 0 1\r\n OUTER LOOP\r\n VERTEX +1.5e-3 -2E0 .5\r\n"
                                      "VERTEX 1 0 0\r\nVERTEX 0 1 0\r\nENDLOOP\r\nENDFACET\r\nENDSOLID a\r\nsolid b\n" +
                                      facet + "endsolid b");
    REQUIRE(soup.triangles.size() == 2);
    CHECK(soup.vertices[static_cast<std::size_t>(soup.triangles[0][0])] == Vec3(1.5e-3, -2, 0.5));
}

TEST_CASE("ASCII with a byte order mark, comments or old line ends is read", "[stl]")
{
    std::string old = "solid a\n" + facet + "endsolid a\n";
    std::ranges::replace(old, '\n', '\r');
    for (const std::string& bytes :
        {"\xef\xbb\xbfsolid a\n" + facet + "endsolid a\n", "# made by hand\nsolid a\n" + facet + "endsolid\n",
            "; a\n// b\nsolid a\n# c\n" + facet + "# d\nendsolid a\n", old})
        CHECK(soup_of(bytes).triangles.size() == 1);
    std::ranges::replace(old, '0', 'o');
    CHECK(refusal_of_stl(old) == "w.stl:4: 'o' is not a finite number");
}

TEST_CASE(
    "a binary file gives its triangles with equal corners merged, even where its header begins with solid", "[stl]")
{
    const TriangleSoup soup = soup_of(binary_square());
    REQUIRE(soup.triangles.size() == 2);
    CHECK(soup.vertices.size() == 4);
    CHECK(soup.vertices[static_cast<std::size_t>(soup.triangles[1][2])] == Vec3(0, 1, 0));
    CHECK(soup.triangles[0][0] == soup.triangles[1][0]);
}

TEST_CASE("broken ASCII is refused with its line", "[stl]")
{
    CHECK(refusal_of_stl("solid\n" + facet) == "w.stl:9: the file ends where 'facet' or 'endsolid' is wanted");
    CHECK(refusal_of_stl("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\n") ==
          "w.stl:6: 'vertex' is wanted here, not 'endloop'");
    CHECK(refusal_of_stl("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 zero\n") ==
          "w.stl:4: 'zero' is not a finite number");
    CHECK(refusal_of_stl("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 nan 0\n") ==
          "w.stl:4: 'nan' is not a finite number");
    CHECK(refusal_of_stl("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 1,5 0\n") ==
          "w.stl:4: '1,5' is not a finite number");
    CHECK(
        refusal_of_stl("solid\n" + facet + "endsolid\nrubbish\n") == "w.stl:10: 'solid' is wanted here, not 'rubbish'");
    CHECK(refusal_of_stl("solid empty\nendsolid empty\n") == "w.stl: it has no triangles");
}

TEST_CASE("broken binary is refused with what it lacks", "[stl]")
{
    CHECK(refusal_of_stl(binary_square().substr(0, 150)) ==
          "w.stl: as binary STL with 2 triangles it must have 184 bytes, but it has 150");
    CHECK(refusal_of_stl(binary_square() + "tail") ==
          "w.stl: as binary STL with 2 triangles it must have 184 bytes, but it has 188");
    CHECK(refusal_of_stl(binary_square(4000000000)) ==
          "w.stl: as binary STL with 4000000000 triangles it must have 200000000084 bytes, but it has 184");
    CHECK(refusal_of_stl(binary_square(2, std::numeric_limits<float>::quiet_NaN())) ==
          "w.stl: triangle 2 has a coordinate that is not a finite number");
    const std::string obj =
        "# a mesh of another kind\n" + std::string(100, ' ') + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    CHECK(refusal_of_stl(obj) ==
          "w.stl: it is text, but no ASCII STL, which begins with 'solid'; meshes are read from STL files only");
    CHECK(refusal_of_stl("not a mesh") == "w.stl: neither ASCII STL nor long enough for binary STL");
    CHECK(refusal_of_stl(binary_square(0).substr(0, 84)) == "w.stl: it has no triangles");
}

TEST_CASE("a mesh file that is missing, empty, a folder or too large is refused", "[stl]")
{
    const SceneFolder folder;
    const auto refusal = [&](const std::filesystem::path& path) {
        return folder.without_folder(error_of<InputError>([&] { read_stl(path); }));
    };
    CHECK(refusal(folder.path() / "none.stl") == "none.stl: no such file");
    CHECK(refusal(folder.write("empty.stl", "")) == "empty.stl: the file is empty");
    std::filesystem::create_directory(folder.path() / "folder.stl");
    CHECK(refusal(folder.path() / "folder.stl") == "folder.stl: not an STL file");
    const auto huge = folder.write("huge.stl", "solid");
    std::filesystem::resize_file(huge, (std::uintmax_t{1} << 30) + 1); // sparse
    CHECK(refusal(huge) == "huge.stl: an STL file has at most 1073741824 bytes, this one 1073741825");
}
