// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/sensors/sensor.hpp"
#include "core/step/time_step.hpp"

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace talus
{

/// Where every sphere that ever came in has gone.
struct ParticleLedger {
    std::int64_t inserted = 0; ///< there at the start, and poured
    std::int64_t inside = 0;
    std::int64_t left = 0;      ///< through an outlet
    std::int64_t escaped = 0;   ///< left the world where there is no outlet
    std::int64_t taken_out = 0; ///< from outside (Interventions)

    bool closes() const { return inserted == inside + left + escaped + taken_out; }
};

/// By how much a result changes when the run is made otherwise: mean over pieces of it that companions have made
/// (companions.hpp), in the unit of the result.
struct ChangeOfResult {
    double mean = std::numeric_limits<double>::quiet_NaN();
    double noise = std::numeric_limits<double>::quiet_NaN(); ///< standard error of the mean
    std::int64_t pieces = 0;

    /// Whether there are enough pieces to tell a change from chance.
    bool is_known() const;

    /// Whether it is more than chance: three times the noise, which chance alone exceeds once in a hundred times (four
    /// pieces) or less.
    bool is_seen() const;

    /// The size of a change that is seen; of another one what it may be at most, |mean| + 2 noise; not a number where
    /// it is not known.
    double error() const;
};

struct SensorSummary {
    std::string name;
    std::vector<Measurement> results;
    std::string silence; ///< why results are not numbers; empty where all are
    double window = 0.0; ///< over which they are averaged [s]
    /// Of each result, with half the step, with a tenth of the tolerance; empty without companions.
    std::vector<ChangeOfResult> by_step = {}, by_solver = {};
};

/// Said of a result that too few pieces have told something of.
inline constexpr const char* too_few_pieces =
    "fewer than four pieces of the run that companions have made fell into its window: what step and solver do to it "
    "is not known";

/// Said of a result whose samples are too few for its spread.
inline constexpr const char* too_few_samples =
    "its window holds too few independent samples, so its spread is a lower bound: average for longer";

struct PourSummary {
    std::string name;
    std::optional<std::int64_t> asked; ///< spheres in all, by the scene, where it gives a count
    std::optional<double> asked_mass;  ///< of all spheres [kg], where it gives a mass
    std::int64_t poured = 0;           ///< spheres that came in
    double poured_mass = 0.0;          ///< their mass [kg]
    std::string shortfall;             ///< why fewer came in than asked; empty where none is missing
};

/// What became of a momentum, in steps with the same spheres.
struct MomentumSums {
    double from_gravity = 0.0; ///< size of the sum of what gravity gave
    double from_walls = 0.0;   ///< the same of walls
    double left_over = 0.0;    ///< sum of the sizes of what the spheres gained or lost in single steps besides
};

/// The error of the force of the spheres on a wall, over the looks.
struct WallForceError {
    std::string wall;
    double error = 0.0; ///< rms of the difference [N]
    double force = 0.0; ///< rms of the force itself [N]
};

/// How far steps are from the same steps solved to the end, over the looks at it (error_looks.hpp): rms over spheres,
/// contacts and looks. What no look tells is not a number.
struct SolverErrorSummary {
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

    std::int64_t looks = 0;            ///< that these are from
    std::int64_t made = 0;             ///< with those that were forgotten for the sake of even spacing
    double share = 0.0;                ///< of what the steps cost that was spent on them
    std::int64_t to_the_end = 0;       ///< of `looks`: whose solution is a thousand times as good as is asked of a step
    double residual = unknown;         ///< of the solutions that were compared with
    double velocity_error = unknown;   ///< [m/s]
    double worst_velocity_error = 0.0; ///< of one look [m/s]
    double worst_time = 0.0;           ///< of that look [s]
    double in_fall_speeds = unknown;   ///< velocity error by √(g d); unknown without gravity
    double of_flow = unknown;          ///< by the rms speed of the spheres
    double of_contacts = unknown;      ///< by what contacts change in a step
    double force_error = unknown;      ///< of contact forces, by their mean
    std::vector<WallForceError> walls; ///< those that a sensor watches
};

/// How wrong the run may be. Overlaps are in mean diameters d.
struct ErrorSummary {
    double tolerance = 0.0; ///< on the residual
    double mean_residual = 0.0;
    double residual_95 = 0.0; ///< 95 % of the steps reached less
    double worst_residual = 0.0;
    std::int64_t steps_at_cap = 0;   ///< ended by max_sweeps, unconverged
    double mean_overlap = 0.0;       ///< over the overlapping contacts of all steps [d]
    double worst_overlap = 0.0;      ///< [d]
    double worst_overlap_time = 0.0; ///< when that was [s]
    std::int64_t split_steps = 0;    ///< that were made in several, for two came near each other too fast
    std::int64_t most_sub_steps = 1; ///< of a step …
    Approach split_for;              ///< … and for whose sake, if it is more than one
    double cone_violation = 0.0;     ///< worst |λ_t| − μ λ_n [N s]
    std::int64_t corrections = 0;    ///< of pressures (pressure_scaling.hpp) that were asked for; 0 where none scales
    std::int64_t refused_corrections = 0; ///< of them, for energy would have risen
    double energy_lost = 0.0;   ///< kinetic + potential + stored in contacts: sum of its falls from step to step [J]
    double energy_gained = 0.0; ///< sum of its rises, which nothing put in [J]
    double energy_put_in = 0.0; ///< work of moving walls, and of gravity along periodic axes [J]
    MomentumSums linear;        ///< momentum of the spheres [N s]
    MomentumSums angular;       ///< about the origin [N m s]; not where axes are periodic, across which it is not kept
};

struct PhaseTime {
    std::string name;
    double wall = 0.0; ///< [s]
    double cpu = 0.0;  ///< [s], of all threads
};

/// From the first step on: what the building of the scene took is not in it.
struct TimingSummary {
    double wall = 0.0;
    double cpu = 0.0;
    std::vector<PhaseTime> phases;    ///< they add up to the whole
    double contact_updates = 0.0;     ///< contacts × sweeps, over all steps
    double contact_update_rate = 0.0; ///< contact updates per CPU second of the sweeps [1/s]
};

/// One of the sentences that tell what was simulated, such as those on the step and on what is modelled.
struct Explanation {
    std::string about;
    std::string sentence;
};

/// All that is left to say when a run is over.
struct RunSummary {
    std::vector<Incident> incidents;     ///< why it failed; empty where it is done
    bool interrupted = false;            ///< before its time, after a checkpoint
    bool touched = false;                ///< its state was changed from outside (Interventions)
    std::vector<std::string> wall_names; ///< by which an incident names the wall touched last
    std::string version;                 ///< of Talus
    std::string scene;                   ///< its name
    std::string title;
    std::int64_t seed = 0;
    std::vector<Explanation> explanations;
    int threads = 0;
    double simulated_time = 0.0; ///< [s]
    double time_step = 0.0;      ///< [s]
    std::int64_t steps = 0;
    ParticleLedger ledger;
    std::vector<PourSummary> pours;
    std::vector<SensorSummary> sensors;
    ErrorSummary error;
    SolverErrorSummary solver_error;
    std::int64_t companion_pieces = 0; ///< of the run that companions have made
    double companion_length = 0.0;     ///< of such a piece [s]
    TimingSummary timing;
};

/// The incident as one sentence, with the sphere's id, its place, its speed and the wall that it touched last.
std::string describe(const Incident& incident, const std::vector<std::string>& wall_names);

/// "spheres 3 and 4".
std::string name_spheres(std::int64_t a, std::int64_t b);
/// "sphere 3 and the wall 'lid'".
std::string name_sphere_and_wall(std::int64_t sphere, const std::string& wall_name);

/// "sphere 3 and the wall 'lid', which close at 2.1 m/s".
std::string describe(const Approach& approach, const std::vector<std::string>& wall_names);

/// The incidents as JSON, a list of what summary.json has of each.
std::string incidents_text(const std::vector<Incident>& incidents, const std::vector<std::string>& wall_names);

/// The text of summary.json.
std::string summary_text(const RunSummary& summary);

/// Writes summary.json; its keys are documented in io/README.md.
/// @throws OutputError
void write_summary(const std::filesystem::path& path, const RunSummary& summary);

} // namespace talus
