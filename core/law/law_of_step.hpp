// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/lanes.hpp"
#include "core/law/thresholds.hpp"

namespace talus
{

struct Model;
struct StepLength;

/// What the laws of all contacts of a step share.
struct LawOfStep {
    double h;                     ///< of this step or sub-step [s]
    double threshold_speed = 0.0; ///< slowest impact: that of the whole step [m/s]
    double elastic_speed = 0.0;   ///< opening so, a spring gives back all that it stores [m/s]
    bool rigid = false;           ///< `projected`
    double min_sweeps = 2.0;      ///< N_min
    double push_out_speed = 0.0;  ///< p [m/s]
    double parts = 1.0;           ///< sub-steps of the whole step
    double min_diameter = 0.0;    ///< d_min [m]
    bool elastic = false;         ///< materials have moduli
};

LawOfStep law_of_step(const Model& model, const StepLength& step);

} // namespace talus
