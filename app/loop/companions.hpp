// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/archive.hpp"
#include "core/base/statistics.hpp"
#include "core/simulation/simulation.hpp"
#include "core/step/time_step.hpp"
#include "io/run/summary.hpp"
#include "scenarios/scene.hpp"

#include <cstdint>
#include <functional>
#include <vector>

namespace talus
{

/// How a result changes with the step and with the tolerance, over pieces of a run that companions have made.
///
/// Grains in flow are chaotic: whatever is changed, two runs soon differ as two samples of the same thing do. A change
/// is the mean over the pieces of x − (x_same + x_seed)/2; its noise is the standard error that the scatter of these
/// tells, or, where it is more, the one that the two seeds tell, √(3/4 ⟨(x_seed − x_same)²⟩ / pieces): each of the two
/// is unsure by itself where pieces are few.
class ChangesOfResult
{
public:
    /// Takes in a piece. @param same with nothing changed; @param seed with another seed; @param step, solver with half
    /// the step, with a tenth of the tolerance. What is not a number is left out.
    void add(double same, double seed, double step, double solver);

    ChangeOfResult by_step() const { return change(step_); }
    ChangeOfResult by_solver() const { return change(solver_); }

private:
    MeanAndError step_, solver_;
    MeanAndError seed_squares_; ///< (x_seed − x_same)²

    ChangeOfResult change(const MeanAndError& differences) const;
};

/// Short runs beside the run, which tell what its results owe to its step and its solver.
///
/// Now and then, between two steps, a piece of the run is made four times from the state that it is in: as the run
/// makes it, with another seed, with half the step, and with a tenth of the tolerance (and up to ten times the sweeps,
/// so that it can be met). Each has sensors of its own, which look after a quarter of the piece, when contacts have
/// come to the overlap that is theirs with the new step. So the run itself does not change by it. Another seed means
/// that poured spheres come in at other places, and that all velocities are changed by up to a millionth, which chaos
/// makes grow.
///
/// A piece begins only where a sensor's window holds what is measured of it, and never within another. When, follows
/// from the steps alone and never from the clock: steps gain companions a share of their contact updates, a piece
/// spends what it costs, and the next one waits until that is earned. So the pieces are the same on any machine, for
/// any number of threads, after a stop, and for a run that is made longer; the last one may go on beyond the run's end.
///
/// They see what a step does within a piece. What it has done before, to a heap that lies there, they begin with; and
/// forces that friction leaves open are others once a shorter step has pushed the overlap out.
class Companions
{
public:
    static constexpr double usual_share = 2.0; ///< of what steps cost, where the user asks for companions

    /// From now on companions may cost this share of what the steps cost; 0: there are none.
    void set_share(double share) { share_ = share; }

    /// Before a step: makes a piece where one is due.
    /// @param scene of the simulation; @param go_on asked before each step: where it says no, the piece is given up,
    /// and due again
    void before_step(const Simulation& simulation, const scene::Scene& scene, const std::function<bool()>& go_on = {});

    void after_step(const StepReport& report);

    /// Whether they were asked for, now or before a stop.
    bool any() const { return share_ > 0.0 || pieces_ > 0; }

    std::int64_t pieces() const { return pieces_; }

    /// Of a quantity, counted over the results of all sensors in their order.
    ChangesOfResult of_result(std::size_t k) const { return k < changes_.size() ? changes_[k] : ChangesOfResult(); }

    /// How long a piece is [s]: sixteen samples of the sensors, and no less than a grain takes to fall four diameters.
    static double piece_length(const Model& model, const scene::Scene& scene);

    void persist(Archive& archive) { archive(changes_, pieces_, next_, credit_); }

private:
    double share_ = 0.0;
    std::vector<ChangesOfResult> changes_; ///< by quantity; none before the first piece
    std::int64_t pieces_ = 0;
    double next_ = 0.0;   ///< when the next may begin [s]
    double credit_ = 0.0; ///< what companions may cost now [contact updates]

    bool is_due(const Simulation& simulation, const scene::Scene& scene) const;
};

} // namespace talus
