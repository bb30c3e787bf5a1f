// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/archive.hpp"
#include "core/simulation/simulation.hpp"
#include "io/run/summary.hpp"
#include "scenarios/scene.hpp"

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace talus
{

/// What a look at one step found: how far the step is from the same step solved to the end, from the same start.
struct ErrorLook {
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

    double time = 0.0;                   ///< at the end of the step [s]
    double velocity_error = unknown;     ///< of the centres of the spheres, rms [m/s]
    double flow_speed = unknown;         ///< rms speed of the spheres [m/s]
    double change_by_contacts = unknown; ///< rms of what contacts change in the velocities in that step [m/s]
    double force_error = unknown;    ///< of the contact forces, rms by their mean; unknown where there are none, or the
                                     ///< step was split, whose parts do not have the same contacts
    double residual = 0.0;           ///< ε of the solution that it is compared with
    bool to_the_end = false;         ///< that solution has reached the tolerance of looks
    std::vector<double> wall_errors; ///< of the force on each wall [N]; empty unless the step sums up wall loads
    std::vector<double> wall_forces; ///< what they are to be [N]

    double of_flow() const { return velocity_error / flow_speed; }
    double of_contacts() const { return velocity_error / change_by_contacts; }

    void persist(Archive& archive)
    {
        archive(time, velocity_error, flow_speed, change_by_contacts, force_error, residual, to_the_end, wall_errors,
            wall_forces);
    }
};

/// How far the velocities are, after the next step, from those that the same step has when it is solved to the end:
/// root of the mean square over the spheres [m/s]. Both steps are made on copies.
double velocity_error_of_next_step(const Simulation& simulation);

/// The walls whose force a sensor of the scene watches, by index.
std::vector<std::size_t> watched_walls(const scene::Scene& scene, const Model& model);

/// Looks at the error of the solver while a run goes on: now and then a step is made once more on a copy, from the same
/// start, and solved to the end, or as far as there is time for. The run itself does not change by it.
///
/// When, and how far, follows from the steps alone and never from the clock, so that the looks of a run are the same
/// bits on any machine, for any number of threads, and after a stop. Every step gains looks a share of its contact
/// updates (contacts × sweeps, the rest of a step counted as some more), and a look spends what has been gained. One is
/// due every so many steps; it is put off to the next time where what was gained does not carry it far enough to say
/// anything. When there are `most` looks, every second one is forgotten and the next ones are due half as often: so
/// they are spread evenly over a run of any length, which need not be known.
class ErrorLooks
{
public:
    static constexpr double usual_share = 0.03; ///< of what steps cost
    static constexpr double large_share = 0.3;  ///< where the user asks for more

    /// From now on looks may take this share of what the steps cost.
    void set_share(double share) { share_ = share; }

    /// Before a step: keeps the state that it begins with where a look at it is due.
    void before_step(const Simulation& simulation);

    /// Whether the step to come, or just made, is one to look at.
    bool is_open() const { return copy_ != nullptr; }

    /// After the step, while its contacts are there: makes it on the copy and compares.
    void after_step(const Simulation& simulation, const StepReport& report);

    const ErrorLook& latest() const { return latest_; } ///< all unknown before the first

    const std::vector<ErrorLook>& looks() const { return looks_; } ///< that are kept, in the order of time

    SolverErrorSummary summary(const Model& model) const;

    /// @pre no look is open
    void persist(Archive& archive)
    {
        archive(looks_, latest_, made_, put_off_, interval_, credit_, contacts_, sweeps_);
    }

private:
    static constexpr std::size_t most = 40;

    double share_ = usual_share;
    std::vector<ErrorLook> looks_;
    ErrorLook latest_;
    std::int64_t made_ = 0, put_off_ = 0;
    std::int64_t interval_ = 64;       ///< between two looks [steps]
    double credit_ = 0.0;              ///< what looks may cost now [contact updates]
    std::int64_t contacts_ = 0;        ///< of the last step
    int sweeps_ = 0;                   ///< of the last step
    std::shared_ptr<Simulation> copy_; ///< as the step begins; none between steps, when looks may be copied
};

} // namespace talus
