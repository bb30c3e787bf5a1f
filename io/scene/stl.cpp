// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/stl.hpp"

#include "io/text/input_error.hpp"
#include "io/text/input_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <string>
#include <string_view>

namespace talus
{

namespace
{

/// The corners of all triangles, three for each.
using Corners = std::vector<Vec3>;

constexpr std::string_view byte_order_mark = "\xef\xbb\xbf"; ///< that some editors put before UTF-8
constexpr std::string_view blanks = " \t\r\n";

/// Where the line ends that a text begins with, whichever system's its line ends are.
std::size_t end_of_line(std::string_view text)
{
    return std::min(text.find_first_of("\r\n"), text.size());
}

/// The text without blanks and lines of comments before its first word.
std::string_view from_first_word(std::string_view text)
{
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    for (;;) {
        text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
        if (!text.starts_with('#') && !text.starts_with(';') && !text.starts_with("//")) return text;
        text.remove_prefix(end_of_line(text));
    }
}

/// Reads the words of an ASCII STL file: solid NAME, facets, endsolid NAME.
class AsciiParser
{
public:
    AsciiParser(const std::string& file, std::string_view text) : file_(file), rest_(text) {}

    Corners parse()
    {
        Corners corners;
        for (std::string_view word = next_word(); !word.empty(); word = next_word()) {
            expect(word, "solid");
            skip_line(); // its name
            while (parse_facet(corners)) {}
            skip_line();
        }
        return corners;
    }

private:
    const std::string& file_;
    std::string_view rest_;
    std::size_t line_ = 1;

    /// Appends the corners of a facet; false where the solid ends instead.
    bool parse_facet(Corners& corners)
    {
        const std::string_view word = required_word("'facet' or 'endsolid'");
        if (equals(word, "endsolid")) return false;
        expect(word, "facet");
        keyword("normal");
        for (int i = 0; i < 3; ++i) required_word("a number"); // not used: the normal follows from the corners
        keyword("outer");
        keyword("loop");
        for (int corner = 0; corner < 3; ++corner) {
            keyword("vertex");
            const double x = parse_coordinate();
            const double y = parse_coordinate();
            const double z = parse_coordinate();
            corners.emplace_back(x, y, z);
        }
        keyword("endloop");
        keyword("endfacet");
        return true;
    }

    double parse_coordinate()
    {
        const std::string_view word = required_word("a number");
        const auto number = finite_number(word);
        if (!number) refuse(fmt::format("'{}' is not a finite number", shortened(word)));
        return *number;
    }

    void keyword(std::string_view wanted) { expect(required_word(fmt::format("'{}'", wanted)), wanted); }

    void expect(std::string_view word, std::string_view wanted) const
    {
        if (!equals(word, wanted)) refuse(fmt::format("'{}' is wanted here, not '{}'", wanted, shortened(word)));
    }

    std::string_view required_word(std::string_view wanted)
    {
        const std::string_view word = next_word();
        if (word.empty()) refuse(fmt::format("the file ends where {} is wanted", wanted));
        return word;
    }

    /// The next word, or nothing at the end of the file.
    std::string_view next_word()
    {
        const std::string_view from_word = from_first_word(rest_);
        const std::string_view passed = rest_.substr(0, rest_.size() - from_word.size());
        for (std::size_t i = 0; i < passed.size(); ++i)
            line_ += passed[i] == '\n' || (passed[i] == '\r' && !passed.substr(i + 1).starts_with('\n'));
        const std::string_view word = from_word.substr(0, from_word.find_first_of(blanks));
        rest_ = from_word.substr(word.size());
        return word;
    }

    void skip_line() { rest_.remove_prefix(end_of_line(rest_)); }

    static bool equals(std::string_view word, std::string_view lower_case)
    {
        return std::ranges::equal(word, lower_case, {}, [](unsigned char c) { return std::tolower(c); });
    }

    static std::string_view shortened(std::string_view word) { return word.substr(0, 40); }

    [[noreturn]] void refuse(const std::string& sentence) const
    {
        throw InputError(fmt::format("{}:{}: {}", file_, line_, sentence));
    }
};

constexpr std::size_t binary_header = 84;   ///< 80 bytes of anything and the number of triangles
constexpr std::size_t binary_triangle = 50; ///< a normal and three corners of three floats each, and two bytes

/// The number of triangles that a binary file says it has.
std::size_t binary_count(std::string_view bytes)
{
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + binary_header - sizeof count, sizeof count);
    return count;
}

bool is_text(std::string_view bytes)
{
    return bytes.substr(0, 1024).find('\0') == std::string_view::npos;
}

Corners parse_binary(const std::string& file, std::string_view bytes)
{
    if (bytes.size() < binary_header)
        throw InputError(fmt::format("{}: neither ASCII STL nor long enough for binary STL", file));
    const std::size_t count = binary_count(bytes);
    const std::size_t wanted = binary_header + binary_triangle * count;
    if (bytes.size() != wanted && is_text(bytes))
        throw InputError(
            fmt::format("{}: it is text, but no ASCII STL, which begins with 'solid'; meshes are read from "
                        "STL files only",
                file));
    if (bytes.size() != wanted)
        throw InputError(fmt::format("{}: as binary STL with {} triangles it must have {} bytes, but it has {}", file,
            count, wanted, bytes.size()));
    Corners corners;
    corners.reserve(3 * count);
    for (std::size_t triangle = 0; triangle < count; ++triangle) {
        Eigen::Matrix3f points;
        const std::size_t after_normal = binary_header + binary_triangle * triangle + 3 * sizeof(float);
        std::memcpy(points.data(), bytes.data() + after_normal, 9 * sizeof(float));
        if (!points.allFinite())
            throw InputError(
                fmt::format("{}: triangle {} has a coordinate that is not a finite number", file, triangle + 1));
        for (int corner = 0; corner < 3; ++corner) corners.emplace_back(points.col(corner).cast<double>());
    }
    return corners;
}

/// A file that begins with "solid" is ASCII, unless zero bytes show a binary file whose free header begins so.
bool is_ascii(std::string_view bytes)
{
    const std::string_view text = from_first_word(bytes).substr(0, 5);
    const bool begins_solid =
        std::ranges::equal(text, std::string_view("solid"), {}, [](unsigned char c) { return std::tolower(c); });
    return begins_solid && is_text(bytes);
}

TriangleSoup merge_equal_corners(const Corners& corners)
{
    const auto before = [](const Vec3& a, const Vec3& b) {
        return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
    };
    TriangleSoup soup{corners, {}};
    std::ranges::sort(soup.vertices, before);
    soup.vertices.erase(std::unique(soup.vertices.begin(), soup.vertices.end()), soup.vertices.end());
    const auto index_of = [&](const Vec3& corner) {
        const auto found = std::ranges::lower_bound(soup.vertices, corner, before);
        return static_cast<std::int32_t>(found - soup.vertices.begin());
    };
    for (std::size_t i = 0; i < corners.size(); i += 3)
        soup.triangles.push_back({index_of(corners[i]), index_of(corners[i + 1]), index_of(corners[i + 2])});
    return soup;
}

} // namespace

TriangleSoup read_stl(const std::filesystem::path& path)
{
    const std::string file = path.string();
    const std::string bytes = read_bytes(path, "an STL file");
    const Corners corners = is_ascii(bytes) ? AsciiParser(file, bytes).parse() : parse_binary(file, bytes);
    if (corners.empty()) throw InputError(fmt::format("{}: it has no triangles", file));
    return merge_equal_corners(corners);
}

} // namespace talus
