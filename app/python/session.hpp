// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/loop/open_scene.hpp"
#include "app/loop/run_loop.hpp"

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace talus::python
{

/// A step with incidents that end the run; Python sees talus.Incident.
struct Stopped {
    std::string sentence;
    std::string incidents; ///< as JSON
};

/// What Python asks for while another thread makes a step of the same simulation.
struct Busy : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Memory that numpy looks at without a copy. As long as anyone does, the next step leaves it to them as it is, and
/// works on a copy.
struct Lease {
    std::vector<Vec3> position;
    std::vector<Body> bodies;
    std::vector<double> radius;
    std::vector<std::int64_t> id;
    std::vector<std::int32_t> material;
};

/// A simulation in the hands of a Python program, which makes its steps and may do something between them. With a
/// folder it writes there what `talus run` does; without, it keeps the same statistics and samples.
class Session : public std::enable_shared_from_this<Session>
{
public:
    /// @param threads for its steps; 0: as many as OpenMP takes
    Session(OpenedScene opened, int threads);

    /// From now on, at the beginning, all goes into this folder. @throws InputError, OutputError
    void write_into(const std::filesystem::path& folder, bool force);

    /// The run in a folder, which goes on there, or the simulation that `save` kept in a file. @throws InputError
    static std::shared_ptr<Session> resume(
        const std::filesystem::path& place, const std::vector<std::string>& overrides, int threads);

    /// Makes steps until this time [s], at least one where it lies ahead. Ctrl-C ends it between two.
    /// @throws Stopped, Busy, OutputError, pybind11::error_already_set
    void run_until(double time);

    /// The same outside a folder, with `observe` in place of its own statistics and samples.
    /// @param spent CPU time of the steps before [s]; @param longest after so much of it no step is begun [s]
    /// @return the CPU time with that of these steps [s]
    double run_observed(
        double time, double spent, double longest, const std::function<void(const StepReport&, Simulation&)>& observe);

    void save(const std::filesystem::path& file);
    std::string state();                    ///< all that changes, but what sensors have seen and the statistics
    void restore(const std::string& state); ///< as `state` gave it for the same scene, perhaps under another setting

    /// Ends the run in a folder: last frames, checkpoint, summary.json. Nothing without a folder.
    void close();

    std::string summary() const; ///< as JSON

    // For all that reads or changes between steps. @throws Busy
    Simulation& change(); ///< ends all leases
    Simulation& now();
    const OpenedScene& opened() const { return opened_; }
    const StepReport& report() const { return loop_ ? loop_->last() : last_; }

    const std::shared_ptr<Lease>& lease();
    const std::vector<std::size_t>& order(); ///< storage indices by id
    std::size_t index_of(std::int64_t id);   ///< @throws std::out_of_range
    std::vector<std::string> take_warnings();

private:
    OpenedScene opened_;
    RunOrigin origin_; ///< with the files as they were when the scene was read
    int threads_;
    std::unique_ptr<FolderLock> lock_;
    std::unique_ptr<RunLoop> loop_; ///< where there is a folder; else these do what is needed of it:
    StepReport last_;
    RunStatistics statistics_;
    PhaseClock clock_;
    Schedule samples_;

    StepWatch watch_;
    std::vector<std::string> warnings_;
    std::shared_ptr<Lease> lease_; ///< where one was asked for since the last change
    std::vector<std::size_t> order_;
    std::int64_t generation_ = 0, order_generation_ = -1; ///< rise with every step and change
    std::atomic<bool> stepping_ = false;

    void make_steps(const std::function<void()>& make);
    void after_step(const StepReport& report);
    void put_back(Archive& archive);
    void persist(Archive& archive);
};

} // namespace talus::python
