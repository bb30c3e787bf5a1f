// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/candidates/contact_network.hpp"
#include "core/contacts/assembly.hpp"
#include "core/contacts/wall_load.hpp"
#include "core/step/diagnostics.hpp"
#include "core/world/model.hpp"
#include "core/world/placed_wall.hpp"
#include "core/world/state.hpp"

#include <functional>
#include <optional>
#include <vector>

namespace talus
{

/// The phases of a step, in order. `advance` calls the observer when one begins.
enum class Phase { search, assembly, warm_start, sweeps, positions, report };

using PhaseObserver = std::function<void(Phase)>;

/// How a step went. Returned by value, so nothing leaks from one step into the next. Of a step that was split:
/// sums of what adds up (sweeps, impulses, work), the worst of errors, speeds and overlaps, and the rest of its last
/// sub-step.
struct StepReport {
    int sub_steps = 1; ///< into which the step was split (sub_steps.hpp)
    int sweeps = 0;
    double residual = 0.0;            ///< ε after the last sweep (gauss_seidel.hpp)
    bool converged = true;            ///< residual ≤ tolerance
    std::size_t candidates = 0;       ///< listed pairs, walls included
    std::size_t contacts = 0;         ///< contacts in the problem, walls included
    std::size_t overlapping = 0;      ///< contacts with g < 0
    double worst_overlap = 0.0;       ///< at the beginning of the step [m]
    double mean_overlap = 0.0;        ///< over the overlapping contacts [m]
    double cone_violation = 0.0;      ///< worst |λ_t| − μ λ_n [N s]
    double kinetic_energy = 0.0;      ///< of the new velocities, pistons included, as in what follows [J]
    double potential_energy = 0.0;    ///< −Σ m g·x of the new positions, periodic axes left out [J]
    double gravity_work = 0.0;        ///< of gravity along periodic axes in the step [J]
    double contact_energy = 0.0;      ///< ½ k g² stored in the compliant contacts at the beginning of the step [J]
    double fastest_speed = 0.0;       ///< [m/s]
    std::size_t long_moves = 0;       ///< spheres, and pistons, that moved more than 0.1 d in the step
    std::size_t searched = 0;         ///< spheres whose neighbours were searched anew
    Vec3 wall_impulse = Vec3::Zero(); ///< Σ λ over the contacts with walls that are not pistons, on the spheres [N s]
    double wall_work = 0.0;           ///< that walls which move as told did on the spheres [J]
    double load_work = 0.0;           ///< that loads did on pistons [J]
    std::vector<WallLoad> wall_loads; ///< by wall; empty unless a sensor asks for them
    std::vector<Incident> incidents;  ///< empty in every healthy step
};

/// A step before its impulses: who touches whom, and under which law.
struct BegunStep {
    std::vector<PlacedWall> walls; ///< where they stand, and their mean velocities over the step
    std::size_t searched = 0;      ///< spheres whose neighbours were searched anew
    ContactSurvey survey;
    double impulse_scale = 1.0; ///< of the carried impulses, where the step before had another length
};

/// The beginning of a step, from which `contacts` has the problem that the rest of it solves. Positions and velocities
/// stay as they are; the spheres' order may change.
BegunStep begin_step(State& state, ContactNetwork& contacts, const Model& model, const PhaseObserver& observer = {});

/// Advances the state by one step h, or one sub-step: velocities first, then positions.
///
/// `contacts` belongs to `state`: it carries the candidate list and the impulses from step to step.
StepReport advance(State& state, ContactNetwork& contacts, const Model& model, const PhaseObserver& observer = {});

/// Likewise, unless the impulses have made a sphere or a piston faster than `fastest` [m/s]: then nothing has moved,
/// and velocities are as they were.
std::optional<StepReport> advance_unless_faster(
    double fastest, State& state, ContactNetwork& contacts, const Model& model, const PhaseObserver& observer = {});

} // namespace talus
