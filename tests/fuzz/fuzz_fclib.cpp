// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/fclib.hpp"
#include "io/input_error.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

/// Any bytes are either a problem or refused with a sentence.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
    try {
        talus::parse_fclib(std::string(reinterpret_cast<const char*>(bytes), size), "fuzzed.hdf5");
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
