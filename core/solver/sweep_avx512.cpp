// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/packed_sweep.hpp"

namespace talus
{

const SweepKernels avx512_kernels = packed_sweep::kernels<8>("avx512");

} // namespace talus
