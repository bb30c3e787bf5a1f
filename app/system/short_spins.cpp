// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/system/short_spins.hpp"

#include <cstdlib>
#include <unistd.h>

namespace talus
{

void restart_with_short_spins(char** argv)
{
    if (std::getenv("GOMP_SPINCOUNT") || std::getenv("OMP_WAIT_POLICY")) return;
    setenv("GOMP_SPINCOUNT", "2000", 1);
    execv("/proc/self/exe", argv); // returns only if it cannot; then the run goes on as it is
}

} // namespace talus
