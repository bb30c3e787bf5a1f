// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/properties/draws.hpp"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <exception>

namespace talus::test
{
namespace
{

std::int64_t setting(const char* name, std::int64_t usual)
{
    const char* value = std::getenv(name);
    return value && *value ? std::atoll(value) : usual;
}

} // namespace

void for_all_worlds(int usual, const std::function<Fault(Draw&)>& world)
{
    const std::int64_t count = setting("TALUS_PROPERTY_COUNT", usual), first = setting("TALUS_PROPERTY_SEED", 1);
    const std::int64_t told_in_full = setting("TALUS_PROPERTY_TELL", 3);
    std::int64_t wrong = 0;
    std::string faults;
    for (std::int64_t seed = first; seed < first + count; ++seed) {
        Draw draw(static_cast<std::uint64_t>(seed));
        Fault fault;
        try {
            fault = world(draw);
        } catch (const std::exception& e) {
            fault = e.what();
        }
        if (!fault) continue;
        if (++wrong <= told_in_full) faults += "\nseed " + std::to_string(seed) + ": " + *fault;
    }
    INFO(wrong << " of " << count << " worlds are wrong" << faults);
    CHECK(wrong == 0);
}

} // namespace talus::test
