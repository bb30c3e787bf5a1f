// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace talus
{

/// How the program ends. These are part of its interface.
enum class ExitCode {
    done = 0,
    not_converged = 1, ///< `talus solve`: the tolerance was not met; the result is written all the same
    input = 2,         ///< wrong usage, a wrong scene or a wrong problem
    physics = 3,       ///< a sphere escaped, is not a number or blew up
    output = 4,        ///< a file cannot be written
    internal = 70,     ///< a fault of Talus, or no memory
    interrupted = 130, ///< by SIGINT, after a checkpoint
    terminated = 143   ///< by SIGTERM, likewise
};

} // namespace talus
