// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contacts/contact_survey.hpp"

#include <algorithm>

namespace talus
{

ContactSurvey& ContactSurvey::operator+=(const ContactSurvey& other)
{
    count += other.count;
    impacts += other.impacts;
    overlapping += other.overlapping;
    worst_strain = std::max(worst_strain, other.worst_strain);
    closing_speed = std::max(closing_speed, other.closing_speed);
    worst_overlap = std::max(worst_overlap, other.worst_overlap);
    overlap_sum += other.overlap_sum;
    stored_energy += other.stored_energy;
    push_out_energy += other.push_out_energy;
    attraction_energy += other.attraction_energy;
    return *this;
}

void ContactSurvey::then(const ContactSurvey& next)
{
    const ContactSurvey before = *this;
    *this = next;
    worst_overlap = std::max(worst_overlap, before.worst_overlap);
    stored_energy = before.stored_energy;
    push_out_energy += before.push_out_energy;
    attraction_energy = before.attraction_energy;
}

ContactSurvey survey_of(const TouchSums& sums, double attraction_energy)
{
    ContactSurvey survey{.attraction_energy = attraction_energy};
    for (int lane = 0; lane < pack_size; ++lane)
        survey += {.count = static_cast<std::size_t>(sums.contacts[lane]),
            .overlapping = static_cast<std::size_t>(sums.overlapping[lane]),
            .impacts = static_cast<std::size_t>(sums.impacts[lane]),
            .worst_strain = sums.worst_strain[lane],
            .closing_speed = sums.closing_speed[lane],
            .worst_overlap = sums.worst_overlap[lane],
            .overlap_sum = sums.overlap[lane],
            .stored_energy = sums.stored_energy[lane],
            .push_out_energy = sums.push_out_energy[lane]};
    return survey;
}

} // namespace talus
