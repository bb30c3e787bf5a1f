// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/packed_sweep.hpp"

namespace talus
{

const SweepKernels avx2_kernels = packed_sweep::kernels<4>("avx2");

} // namespace talus
