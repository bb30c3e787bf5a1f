// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/archive.hpp"
#include "core/step/time_step.hpp"
#include "io/run/summary.hpp"

#include <array>
#include <vector>

namespace talus
{

/// What a run spends its time on: the phases of a step (in the order of Phase) and what happens around them.
enum class RunPhase {
    search,
    assembly,
    warm_start,
    sweeps,
    positions,
    report,
    pour_and_outlet,
    sensors,
    looks,
    companions,
    output
};

inline constexpr std::array<const char*, 11> phase_names = {"search", "assembly", "warm_start", "sweeps", "positions",
    "report", "pour_and_outlet", "sensors", "looks", "companions", "output"};

/// Shares out wall and CPU time among the phases. It runs from its making on and is always in one phase, so that the
/// phases add up to the whole.
class PhaseClock
{
public:
    PhaseClock();

    /// Ends the phase before and begins this one.
    void begin(RunPhase phase);
    void begin(Phase phase) { begin(static_cast<RunPhase>(phase)); }

    /// Time since the clock was made [s].
    double wall() const;

    /// Stores or puts back what the phases have taken, for a run in several parts.
    void persist(Archive& archive);

    /// What each phase has taken up to the last `begin`.
    const std::vector<PhaseTime>& phases() const { return phases_; }

private:
    struct Reading {
        double wall, cpu;
    };
    static Reading read();

    std::vector<PhaseTime> phases_;
    RunPhase current_ = RunPhase::output;
    Reading start_, last_;
};

} // namespace talus
