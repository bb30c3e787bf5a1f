// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/sphere_file.hpp"
#include "io/text/input_error.hpp"
#include "tests/fuzz/fuzzed_file.hpp"

/// Any bytes are either a table of spheres or refused with a sentence.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
    try {
        talus::read_spheres(talus::fuzz::fuzzed_file("spheres.csv", bytes, size));
    } catch (const talus::InputError&) {
    }
    return 0;
}
