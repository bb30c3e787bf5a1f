// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/checkpoint.hpp"
#include "io/text/checksum.hpp"
#include "io/text/input_error.hpp"
#include "scenarios/build/build_scene.hpp"
#include "tests/fuzz/fuzzed_file.hpp"
#include "tests/scenarios/small_scene.hpp"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>

namespace
{

constexpr const char* version = "0.1.0";
constexpr std::size_t size_at = 8 + 4 + 4 + 8 + 5, sum_at = size_at + 8, state_at = sum_at + 4; ///< in its header

talus::Simulation simulation()
{
    auto scene = talus::test::small_scene();
    scene.pour.push_back(talus::test::small_pour());
    scene.sensor.push_back(talus::test::sensor("flow", "mass_flow"));
    return talus::build_scene(scene).simulation;
}

/// A good one, from which all others come.
std::string good_checkpoint()
{
    auto begun = simulation();
    for (int k = 0; k < 50; ++k) talus::step(begun);
    talus::Archive archive;
    archive(begun);
    const auto path = talus::fuzz::fuzzed_file("checkpoint.latest", nullptr, 0);
    talus::write_checkpoint(path.parent_path(), version, archive.bytes());
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

} // namespace

/// Any bytes are either a checkpoint, whose state is put back into a simulation that goes on from there, or refused.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
    try {
        const auto path = talus::fuzz::fuzzed_file("checkpoint.latest", bytes, size);
        std::filesystem::remove(path.parent_path() / "checkpoint.previous");
        talus::Archive archive(talus::read_checkpoint(path.parent_path(), version).state);
        auto resumed = simulation();
        archive(resumed);
        for (int k = 0; k < 3; ++k) {
            const auto report = talus::step(resumed);
            if (!report.incidents.empty()) break; // a run ends there
            for (const auto& sensor : resumed.sensors) sensor->sample(snapshot(resumed, report));
        }
    } catch (const talus::InputError&) {
    } catch (const talus::ArchiveError&) {
    }
    return 0;
}

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* bytes, std::size_t size, std::size_t most);

/// Keeps size and checksum of the state true most of the time: they would refuse nearly everything.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* bytes, std::size_t size, std::size_t most, unsigned seed)
{
    static const std::string good = good_checkpoint();
    if (size <= state_at && good.size() <= most) {
        size = good.size();
        std::memcpy(bytes, good.data(), size);
    }
    size = LLVMFuzzerMutate(bytes, size, most);
    if (seed % 8 == 0 || size < state_at) return size;
    std::memcpy(bytes, good.data(), size_at);
    const std::uint64_t state_size = size - state_at;
    std::memcpy(bytes + size_at, &state_size, sizeof state_size);
    const std::uint32_t sum = talus::checksum(std::string(reinterpret_cast<char*>(bytes) + state_at, state_size));
    std::memcpy(bytes + sum_at, &sum, sizeof sum);
    return size;
}
