// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/sieve_file.hpp"
#include "io/text/input_error.hpp"
#include "tests/io/scene_folder.hpp"

#include <catch2/catch.hpp>

using namespace talus;
using namespace talus::test;

namespace
{

std::string refusal_of_sieve(const std::string& bytes)
{
    const SceneFolder folder;
    const auto path = folder.write("s.csv", bytes);
    return folder.without_folder(error_of<InputError>([&] { read_sieves(path); }));
}

SieveAnalysis sieves_of(const std::string& bytes)
{
    const SceneFolder folder;
    return read_sieves(folder.write("s.csv", bytes));
}

} // namespace

TEST_CASE("a sieve analysis is read in metres, from fine to coarse", "[sieve_file]")
{
    const auto text = GENERATE(as<std::string>{}, "size_mm,passing_percent\n1,0\n2,+20\n4,20\n8,1e2\n",
        "size_m,passing_percent\n0.001,0\n0.002,20\n0.004,20\n0.008,100",
        "\xef\xbb\xbfpassing_percent , size_mm\r\n\r\n# from the pan up\r\n 100 , 8\r\n20,4\r\n20,2\r\n0,1\r\n");
    const auto analysis = sieves_of(text);
    REQUIRE(analysis.sizes.size() == 4);
    const std::vector<double> sizes = {0.001, 0.002, 0.004, 0.008}, passing = {0.0, 0.2, 0.2, 1.0};
    for (std::size_t k = 0; k < 4; ++k) {
        CHECK(analysis.sizes[k] == Approx(sizes[k]).epsilon(1e-14));
        CHECK(analysis.passing[k] == Approx(passing[k]).epsilon(1e-14));
    }
}

TEST_CASE("a broken sieve analysis is refused with its line and what is allowed", "[sieve_file]")
{
    CHECK(refusal_of_sieve("size,passing_percent\n") ==
          "s.csv:1: unknown column 'size'; the header may name 'size_mm', 'size_m' and 'passing_percent'");
    CHECK(refusal_of_sieve("# nothing\n\n") ==
          "s.csv:1: a header with 'size_mm', 'size_m' or 'passing_percent' is wanted");
    CHECK(refusal_of_sieve("size_mm,passing_percent\n") == "s.csv:1: no line of numbers follows the header");
    CHECK(refusal_of_sieve("size_mm,size_mm\n") == "s.csv:1: column 'size_mm' is there twice");
    const std::string columns =
        "s.csv:1: a sieve analysis has the columns 'size_mm' or 'size_m', and 'passing_percent'";
    CHECK(refusal_of_sieve("size_mm\n1\n") == columns);
    CHECK(refusal_of_sieve("passing_percent\n1\n") == columns);
    CHECK(refusal_of_sieve("size_mm,size_m,passing_percent\n1,1,1\n") == columns);
    const std::string header = "size_mm,passing_percent\n";
    CHECK(refusal_of_sieve(header + "1,0,3\n") == "s.csv:2: the header names 2 columns, this line has 3");
    CHECK(refusal_of_sieve(header + "1,0\n2\n") == "s.csv:3: the header names 2 columns, this line has 1");
    CHECK(refusal_of_sieve(header + "1,zero\n") == "s.csv:2: 'zero' is not a finite number");
    CHECK(refusal_of_sieve(header + "1,\n") == "s.csv:2: '' is not a finite number");
    CHECK(refusal_of_sieve(header + "nan,0\n") == "s.csv:2: 'nan' is not a finite number");
    CHECK(refusal_of_sieve(header + "1,0\n1e999,100\n") == "s.csv:3: '1e999' is not a finite number");
    CHECK(refusal_of_sieve(header + "1,0\n") == "s.csv:2: a sieve analysis has two sieves at least");
    CHECK(refusal_of_sieve(header + "0,0\n1,100\n") == "s.csv:2: a sieve's size must be above 0");
    CHECK(refusal_of_sieve(header + "1,0\n2,40\n2,60\n4,100\n") ==
          "s.csv:4: the sizes must rise, or fall, from line to line");
    CHECK(refusal_of_sieve(header + "4,100\n2,60\n3,20\n1,0\n") ==
          "s.csv:3: the sizes must rise, or fall, from line to line");
    CHECK(refusal_of_sieve(header + "1,0\n2,60\n3,40\n4,100\n") ==
          "s.csv:4: a finer sieve lets 60 % pass, more than the 40 % of this one");
    CHECK(refusal_of_sieve(header + "1,5\n2,100\n") ==
          "s.csv:2: 0 % must pass the finest sieve, or the smallest diameter is not known");
    CHECK(refusal_of_sieve(header + "1,0\n2,101\n") ==
          "s.csv:3: 100 % must pass the coarsest sieve, or the largest diameter is not known");
}
