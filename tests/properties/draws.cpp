// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/properties/draws.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <iostream>

namespace talus::test
{
namespace
{

std::int64_t setting(const std::string& name, std::int64_t usual)
{
    const char* value = std::getenv(("TALUS_PROPERTIES_" + name).c_str());
    return value && *value ? std::atoll(value) : usual;
}

} // namespace

void for_all_worlds(double share, const std::function<Fault(Draw&)>& world)
{
    const double asked = static_cast<double>(setting("COUNT", 1000));
    const std::int64_t count = std::max<std::int64_t>(1, std::llround(share * asked)), first = setting("SEED", 1);
    const std::int64_t told_in_full = setting("TELL", 3);
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
    const std::string name = Catch::getResultCapture().getCurrentTestName();
    std::cout << name << ": " << count << " worlds: " << count - wrong << " hold, " << wrong << " fail" << std::endl;
    INFO(wrong << " of " << count << " worlds are wrong" << faults);
    CHECK(wrong == 0);
}

} // namespace talus::test
