// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace talus
{

/// Starts this program anew, once, with GOMP_SPINCOUNT set, unless the user has set that or OMP_WAIT_POLICY.
///
/// A thread of GCC's OpenMP that has nothing to do spins for a millisecond and more before it sleeps, on a processor
/// that others may need: on a busy machine of two cores a discharging silo took twice as long. The variable is read
/// when the library is loaded, before main, so there is no other way to set it.
void restart_with_short_spins(char** argv);

} // namespace talus
