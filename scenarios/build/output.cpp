// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/build/output.hpp"

#include "scenarios/build/region.hpp"

namespace talus
{

OutputChoice build_output(const scene::Scene& scene)
{
    const auto& table = scene.output;
    OutputChoice choice{table.particle_arrays, table.contact_arrays, table.contact_threshold, {}};
    if (table.region.shape != "everything") choice.region = build_region(table.region, "output.region");
    return choice;
}

} // namespace talus
