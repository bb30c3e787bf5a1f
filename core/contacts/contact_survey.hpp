// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/packs/touch_pack.hpp"

#include <cstddef>

namespace talus
{

/// What assembly learns of the contacts on its way.
struct ContactSurvey {
    std::size_t count = 0;          ///< contacts in the problem, walls included
    std::size_t overlapping = 0;    ///< pairs with g < 0, in the problem or not
    std::size_t impacts = 0;        ///< between spheres or at walls, in the problem
    double worst_strain = 0.0;      ///< largest overlap beyond that with which contacts yield, of that; in the problem
    double closing_speed = 0.0;     ///< largest −u_n of contacts that close in the step, or touch already [m/s]
    double worst_overlap = 0.0;     ///< at the beginning of the step [m]
    double overlap_sum = 0.0;       ///< over the overlapping contacts [m]
    double stored_energy = 0.0;     ///< in the contacts' springs at the beginning of the step [J] …
    double push_out_energy = 0.0;   ///< … of which pushing out has put in so much in this step [J]
    double attraction_energy = 0.0; ///< of all that attract each other, at the beginning of the step [J]

    double mean_overlap() const { return overlapping ? overlap_sum / static_cast<double>(overlapping) : 0.0; } ///< [m]
    /// The contacts of another tile of the same step.
    ContactSurvey& operator+=(const ContactSurvey& other);
    /// The next sub-step: the worst of all, the contacts of the last, the energy at the beginning.
    void then(const ContactSurvey& next);
};

/// What the touches of a tile add up to. @param attraction_energy of them all [J]
ContactSurvey survey_of(const TouchSums& sums, double attraction_energy);

} // namespace talus
