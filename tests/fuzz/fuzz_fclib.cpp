// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/multibody/algorithm_3_1.hpp"
#include "io/problem/fclib_problem.hpp"
#include "io/text/input_error.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

namespace
{

constexpr talus::multibody::SolveSettings few_sweeps{.max_sweeps = 3};

void solve(const talus::FclibProblem& file)
{
    if (file.form == talus::FclibForm::local) {
        const auto problem = talus::assembled(file, "fuzzed.hdf5");
        talus::multibody::AssembledIterate x(problem);
        solve_projected(x, few_sweeps);
    } else {
        const auto bodies = talus::with_bodies(file, "fuzzed.hdf5");
        talus::multibody::Iterate x(bodies.problem);
        solve_projected(x, few_sweeps);
    }
}

} // namespace

/// Any bytes are either a problem, which can be swept, or refused with a sentence.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
    try {
        solve(talus::parse_fclib(std::string(reinterpret_cast<const char*>(bytes), size), "fuzzed.hdf5"));
    } catch (const talus::InputError&) {
    }
    return 0;
}

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* bytes, std::size_t size, std::size_t most);

/// Keeps the size that the file's superblock names true: HDF5 would refuse nearly everything there, and get no further.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* bytes, std::size_t size, std::size_t most, unsigned seed)
{
    constexpr std::size_t end_of_file = 40; // its place in a superblock of version 0
    size = LLVMFuzzerMutate(bytes, size, most);
    const bool mend = seed % 16 != 0 && size >= end_of_file + 8;
    for (std::size_t i = 0; mend && i < 8; ++i)
        bytes[end_of_file + i] = static_cast<std::uint8_t>(std::uint64_t{size} >> 8 * i);
    return size;
}
