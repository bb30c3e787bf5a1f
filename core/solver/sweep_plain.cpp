// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/packed_sweep.hpp"

namespace talus
{

const SweepKernels plain_kernels = packed_sweep::kernels<2>("plain");

} // namespace talus
