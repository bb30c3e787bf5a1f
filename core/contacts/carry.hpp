// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact_network.hpp"
#include "core/contacts/loads.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"
#include "core/world/step_length.hpp"

namespace talus
{

/// What is handed on to the next step, read from the solved contacts.
struct ContactOutcome {
    double cone_violation = 0.0; ///< worst |λ_t| − μ λ_n [N s], 0 if none
    WallLoad from_walls;   ///< on the spheres, of all that are not pistons, where spheres were before x ← x + h v
    WallLoad from_pistons; ///< the same of pistons
    double wall_work = 0.0; ///< of walls that move as prescribed on the spheres: Σ λ·w and Σ of rolling rows · spin [J]
    double wall_gain_work = 0.0;  ///< what is more where walls get faster, which they do evenly within the step [J]
    double push_out_energy = 0.0; ///< that contacts without springs have put in at most, pushing out [J]
    double stored_energy = 0.0;   ///< in the contacts' springs, as the step leaves them [J]
    std::size_t newly_jammed = 0; ///< contacts that came to be so in this step (TouchRecord)

    /// Of another tile of the same step, or of the next sub-step.
    ContactOutcome& operator+=(const ContactOutcome& other);
};

/// Stores the impulses of the solved contacts in their slots (an impact carries none), the compression of their
/// springs, and which of them jam, and notes each sphere's last wall.
ContactOutcome carry_impulses(ContactNetwork& network, State& state, const Model& model, const StepLength& step);

} // namespace talus
