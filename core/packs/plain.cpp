// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/packs/packed_sweep.hpp"
#include "core/packs/packed_touch.hpp"

namespace talus
{

const Kernels plain_kernels = {"plain", packs::sweeps<2>(), packs::touches<2>()};

} // namespace talus
