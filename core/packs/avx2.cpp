// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/packs/packed_sweep.hpp"
#include "core/packs/packed_touch.hpp"

namespace talus
{

const Kernels avx2_kernels = {"avx2", packs::sweeps<4>(), packs::touches<4>()};

} // namespace talus
