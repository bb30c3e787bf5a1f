// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace talus::test
{

/// What became of one world.
struct Verdict {
    enum class Outcome {
        holds,
        fails,
        unsolved, ///< the sweeps did not get there: no answer
        no_room,  ///< walls leave none: what is asked of such worlds holds
        left_out  ///< the property says nothing about this world
    };
    Outcome outcome = Outcome::holds;
    std::string why = {};    ///< it fails, in a line or more, with the world; of an unsolved one a line
    double measure = 0.0;    ///< of which the largest is reported
    bool must_solve = false; ///< it is a world of a kind that is always solved
};

using Check = std::function<Verdict(std::uint64_t seed)>;

/// Looks at the worlds of TALUS_PROPERTIES_COUNT seeds (1000) from TALUS_PROPERTIES_SEED (1) on, tells how many there
/// were of each outcome, prints TALUS_PROPERTIES_TELL (3) of those that fail, and fails where one fails, where more
/// than 1 % of those that have room are unsolved, or one of a kind that is always solved.
///
/// With TALUS_PROPERTIES_PROGRESS, a folder, it notes there how far it has come, and goes on from there when it is
/// called again with the same TALUS_PROPERTIES_PROGRAM (a checksum) and seed.
/// @param name of the notes; @param share of the worlds asked for that it looks at, where one costs more
void hold(const std::string& name, const Check& check, double share = 1.0);

} // namespace talus::test
