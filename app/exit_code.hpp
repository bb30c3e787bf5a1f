// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace talus
{

/// How the program ends. These are part of its interface.
enum class ExitCode {
    done = 0,
    input = 2,   ///< wrong usage or a wrong scene
    physics = 3, ///< a sphere escaped, is not a number or blew up
    output = 4,  ///< a file cannot be written
    internal = 70,
    interrupted = 130, ///< by SIGINT, after a checkpoint
    terminated = 143   ///< by SIGTERM, likewise
};

} // namespace talus
