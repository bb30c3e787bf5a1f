// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/deep_beds/choice.hpp"

namespace talus
{
namespace
{

constexpr double deep = 40.0;       ///< mean diameters; in shallower beds at rest sweeps alone do nearly as well
constexpr double heavy = 10.0;      ///< times the lightest sphere
constexpr double very_deep = 100.0; ///< mean diameters (hard case 33)
constexpr double tall = 150.0;      ///< mean diameters
constexpr double crushing = 5e4;    ///< times the lightest sphere; one of 50 d pressed a grain through the floor

} // namespace

bool may_scale_pressures(const Model& model)
{
    return !model.periodicity.any();
}

bool needs_scaled_pressures(const BedMeasures& bed, const Model& model)
{
    return may_scale_pressures(model) && (bed.depth >= deep || bed.body_ratio >= heavy);
}

bool needs_rigid_contacts(const BedMeasures& bed)
{
    return bed.depth >= tall || bed.mass_ratio >= crushing;
}

int least_sweeps_after_scaling(const BedMeasures& bed)
{
    return bed.depth >= very_deep ? 6 : 1;
}

} // namespace talus
