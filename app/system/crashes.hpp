// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace talus
{

/// From now on a crash of the program ends it with one sentence on standard error, on where the run was and how to go
/// on, and the exit code of a fault of Talus.
void catch_crashes();

} // namespace talus
