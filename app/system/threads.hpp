// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace talus
{

/// That steps are made by.
inline constexpr int most_threads = 1024;

/// From now on steps are made by so many threads; 0: by as many as OpenMP takes by itself.
/// @throws UsageError where the system gives this process fewer
void use_threads(int count);

} // namespace talus
