// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/world/model.hpp"

namespace talus
{

/// What decides whether a bed needs more than sweeps.
struct BedMeasures {
    double depth = 0.0;      ///< how deep it may become, in mean diameters; 0 without gravity
    double mass_ratio = 1.0; ///< of its heaviest sphere to its lightest
    double body_ratio = 1.0; ///< of its heaviest sphere or piston to its lightest sphere
};

/// Whether pressures may be scaled: not along periodic axes, where a bed presses against its own images, which balances
/// whatever its size, so that nothing keeps such a pressure from growing with the noise.
bool may_scale_pressures(const Model& model);

/// Whether sweeps alone would take too long to carry its weight, so that pressures are scaled before them where
/// contacts are rigid.
bool needs_scaled_pressures(const BedMeasures& bed, const Model& model);

/// Whether it needs rigid contacts (`projected`), with scaled pressures: under `matched` so tall a column sways for
/// many seconds, and so heavy a sphere presses grains through the floor.
bool needs_rigid_contacts(const BedMeasures& bed);

/// N_min at least, where pressures are scaled: in very deep beds the usual three sweeps do not clean up after it. In
/// others it asks for nothing.
int least_sweeps_after_scaling(const BedMeasures& bed);

} // namespace talus
