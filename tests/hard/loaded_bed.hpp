// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/step/time_step.hpp"
#include "core/simulation/simulation.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace talus::test
{

inline constexpr int grains_per_layer = 16; ///< of the tubes below

/// A bed of about so many layers at rest in a smooth tube 4.4 d wide: what its floor carries is what lies on it. Law
/// `projected` with scaling of pressures.
Simulation bed_at_rest(int layers, int seed = 1);

/// How many steps it takes until the force-profile error is within 5 %, and on the mean of a hundred steps stays so: a
/// load makes grains find new places, and while one does, the profile is off for some steps, as it should be.
std::size_t steps_until_carried(const std::vector<double>& errors);

/// What happened to a load in 3000 steps.
struct LoadHistory {
    std::vector<double> errors;         ///< force-profile error after each step
    std::vector<double> sweeps = {0.0}; ///< made before each step, and in all

    template <class Step, class Error> LoadHistory(Step&& step, Error&& error)
    {
        for (int k = 0; k < 3000; ++k) {
            sweeps.push_back(sweeps.back() + step().solve.sweeps);
            errors.push_back(error());
        }
    }

    std::size_t steps_until_carried() const { return talus::test::steps_until_carried(errors); }
    double sweeps_until_carried() const { return sweeps[steps_until_carried()]; }
};

/// z of the centre of mass [m].
double center_height(const State& state);

/// A copy of a bed in such a tube, a quarter of whose weight is put on its top layer.
class LoadedBed
{
public:
    /// @param end of the tube along x [m]; grains beyond it belong to another bed, and carry no load
    explicit LoadedBed(const Simulation& bed, double end = infinity);

    Model model; ///< settings may be changed

    StepReport step();

    /// Of the force through the worst horizontal cut in the last step, as a share of the force on the floor. A force
    /// through a cut is the weight and the load above it less what their momentum has gained.
    double profile_error() const;

    const State& state() const { return state_; }

private:
    State state_;
    ContactNetwork network_;
    std::vector<std::int64_t> from_top_; ///< ids of the bed's grains
    std::vector<double> momentum_;       ///< of each grain before the step, by id [kg m/s]
    double weight_ = 0.0;                ///< of the bed [N]
};

} // namespace talus::test
