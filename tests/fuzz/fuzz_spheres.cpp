// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/sphere_file.hpp"
#include "io/text/input_error.hpp"
#include "tests/fuzz/fuzzed_file.hpp"

#include <string_view>

/// Any bytes are either a list of spheres or refused with a sentence. Of which kind they are, what is in them says.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
    const std::string_view text(reinterpret_cast<const char*>(bytes), size);
    const bool is_vtk = text.substr(0, 200).find("VTK") != text.npos;
    const bool has_cells = text.substr(0, 200).find("UnstructuredGrid") != text.npos;
    const char* name = !is_vtk ? "spheres.csv" : has_cells ? "spheres.vtu" : "spheres.vtp";
    try {
        talus::read_spheres(talus::fuzz::fuzzed_file(name, bytes, size));
    } catch (const talus::InputError&) {
    }
    return 0;
}
