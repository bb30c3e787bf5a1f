// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/packs/kernels.hpp"

namespace talus
{

std::vector<const Kernels*> usable_kernels()
{
    std::vector<const Kernels*> usable;
#ifdef __x86_64__
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) usable.push_back(&avx512_kernels);
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) usable.push_back(&avx2_kernels);
#endif
    usable.push_back(&plain_kernels);
    return usable;
}

const Kernels& fastest_kernels()
{
    static const Kernels& fastest = *usable_kernels().front();
    return fastest;
}

} // namespace talus
