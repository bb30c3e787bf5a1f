// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/packs/packed_sweep.hpp"
#include "core/packs/packed_touch.hpp"

namespace talus
{

const Kernels avx512_kernels = {"avx512", packs::sweeps<8>(), packs::touches<8>()};

} // namespace talus
