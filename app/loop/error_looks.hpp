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
/// start, and solved a thousand times as well. The run itself does not change by it.
///
/// The steps to look at are chosen before they are made, one in each of many equal parts of the run, so that they are a
/// fair sample of it, busy steps and quiet ones. The number of parts follows from the run's length, and from what looks
/// turn out to cost beside steps, in contact updates (contacts × sweeps, the rest of a step counted as some more):
/// where that is more than the share that they may have, two parts become one, of whose looks one is forgotten. All of
/// it follows from the steps alone and never from the clock, so that the looks of a run are the same bits on any
/// machine, for any number of threads, and after a stop.
class ErrorLooks
{
public:
    static constexpr double usual_share = 0.03; ///< of what steps cost
    static constexpr double large_share = 0.3;  ///< where the user asks for more

    /// From now on looks may take this share of what the steps cost.
    void set_share(double share) { share_ = share; }

    /// Before a step: keeps the state that it begins with where it is one to look at.
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
        archive(looks_, latest_, made_, planned_share_, part_, begin_, next_, parts_, spent_, cost_, recent_looks_,
            recent_steps_, contacts_);
    }

private:
    double share_ = usual_share;
    std::vector<ErrorLook> looks_; ///< one of each part that is over, but for those without contacts
    ErrorLook latest_;
    std::int64_t made_ = 0;
    double planned_share_ = 0.0;       ///< for which the parts were chosen
    std::int64_t part_ = 0;            ///< length of a part of the run [steps]; 0: not known yet
    std::int64_t begin_ = 0;           ///< of the part that goes on [steps]
    std::int64_t next_ = 0;            ///< step to look at
    std::int64_t parts_ = 0;           ///< that have been begun
    double spent_ = 0.0;               ///< on looks [contact updates]
    double cost_ = 0.0;                ///< of the steps [contact updates]
    double recent_looks_ = 0.0;        ///< what looks cost of late [contact updates]
    double recent_steps_ = 0.0;        ///< and those steps
    std::int64_t contacts_ = 0;        ///< of the last step
    std::shared_ptr<Simulation> copy_; ///< as the step begins; none between steps, when looks may be copied

    void begin_part(std::int64_t step);
    void join_parts();
};

} // namespace talus
