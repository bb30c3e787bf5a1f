// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/study/study.hpp"

#include "app/loop/open_scene.hpp"
#include "app/study/findings.hpp"
#include "app/study/study_page.hpp"
#include "app/study/study_result.hpp"
#include "app/study/study_run.hpp"
#include "app/study/workers.hpp"
#include "app/system/signals.hpp"
#include "app/system/terminal.hpp"
#include "core/base/statistics.hpp"
#include "io/run/run_files.hpp"
#include "io/scene/scene_file.hpp"
#include "io/scene/study_file.hpp"
#include "io/text/input_error.hpp"
#include "io/text/input_file.hpp"
#include "scenarios/build/build_scene.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <fmt/ranges.h>
#include <omp.h>

namespace talus
{
namespace
{

namespace fs = std::filesystem;

/// Says which study a folder is of.
constexpr const char* study_mark = "study.resolved.toml";

/// When the first sensor begins to look, or half of the duration.
double automatic_start(const scene::Scene& scene)
{
    double first = infinity;
    for (const scene::SensorTable& sensor : scene.sensor) first = std::min(first, sensor.from);
    return first > 0.0 && first < scene.time.duration ? first : 0.5 * scene.time.duration;
}

double number_or(const scene::NumberOrName& value, double automatic)
{
    return value.name.empty() ? value.number : automatic;
}

/// A row that is to be made.
struct Job {
    Setting setting;
    std::int64_t seed;
};

/// A study with all that it has found so far.
class StudyBook
{
public:
    StudyBook(StudyFrame frame, std::vector<Setting> settings, std::vector<std::int64_t> seeds, PageHead head)
        : frame_(std::move(frame)), settings_(std::move(settings)), seeds_(std::move(seeds)), head_(std::move(head)),
          rows_(read_rows(rows_path()))
    {
        // A line that was cut off is not gone on with.
        std::string whole;
        for (const StudyRow& row : rows_) whole += row_text(row) + "\n";
        write_atomically(rows_path(), whole);
    }

    const StudyFrame& frame() const { return frame_; }

    /// How many there are in all.
    std::size_t runs() const { return settings_.size() * seeds_.size(); }

    /// What is not there yet, the reference of each seed first: it takes longest.
    std::vector<Job> missing() const
    {
        std::vector<Job> jobs;
        for (const Setting& setting : settings_)
            for (const std::int64_t seed : seeds_)
                if (std::ranges::none_of(
                        rows_, [&](const StudyRow& row) { return row.setting == setting.name && row.seed == seed; }))
                    jobs.push_back({setting, seed});
        return jobs;
    }

    void add(const StudyRow& row)
    {
        rows_.push_back(row);
        std::ofstream file(rows_path(), std::ios::binary | std::ios::app);
        file << row_text(row) << "\n" << std::flush;
        if (!file) throw OutputError(fmt::format("{}: cannot be written", rows_path().string()));
    }

    StudyResult write_result() const
    {
        StudyResult result = compare(settings_, rows_);
        write_atomically(frame_.folder / "study.csv", study_csv(result));
        write_atomically(frame_.folder / "study.html", study_page(result, head_));
        return result;
    }

private:
    fs::path rows_path() const { return frame_.folder / "rows.jsonl"; }

    StudyFrame frame_;
    std::vector<Setting> settings_;
    std::vector<std::int64_t> seeds_;
    PageHead head_;
    std::vector<StudyRow> rows_;
};

/// The whole study with its scene and the files that it names: rows of another are not to be mixed with it.
std::string identity(const OpenedScene& opened, const scene::Study& study)
{
    std::string content = resolved_scene(opened.scene);
    for (const NamedFile& file : named_files(opened.scene)) content += fmt::format("{} {}\n", file.path, file.sum);
    return fmt::format(
        "# Talus {}, scene {:08x}: {}\n{}", TALUS_VERSION, checksum(content), opened.name, resolved_study(study));
}

/// Takes away what a study wrote; other files in its folder stay.
void remove_study(const fs::path& folder)
{
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename();
        if (name == "rows.jsonl" || name == "study.csv" || name == "study.html" || name == study_mark ||
            name.starts_with("start_of_seed_"))
            fs::remove_all(entry.path());
    }
}

/// Takes possession of the folder of a study: empty, not there, or of the same study, which goes on.
/// @param study what must be the same
FolderLock make_study_folder(const fs::path& folder, const std::string& study, bool force)
{
    const fs::path mark = folder / study_mark;
    const auto is_lock = [](const fs::directory_entry& entry) { return entry.path().filename() == lock_name; };
    if (fs::exists(folder) && !fs::is_directory(folder))
        throw InputError(fmt::format("{}: is a file, not a folder for a study", folder.string()));
    if (fs::exists(folder) && !fs::exists(mark) && !std::ranges::all_of(fs::directory_iterator(folder), is_lock))
        throw InputError(fmt::format("{}: the folder is not empty and holds no study", folder.string()));
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw OutputError(fmt::format("{}: cannot be made: {}", folder.string(), error.message()));
    FolderLock lock(folder);
    if (fs::exists(mark) && force) {
        remove_study(folder);
    } else if (fs::exists(mark)) {
        std::ifstream file(mark, std::ios::binary);
        if (std::string(std::istreambuf_iterator<char>(file), {}) != study)
            throw InputError(
                fmt::format("{}: the folder holds another study, or one of the scene as it was; --force replaces it",
                    folder.string()));
        return lock;
    }
    write_atomically(mark, study);
    return lock;
}

/// Tells what is done, and guesses from its CPU time how long the rest takes.
class StudyProgress
{
public:
    /// @param window simulated by each run [s]
    StudyProgress(std::vector<Job> jobs, int at_once, double window, Verbosity verbosity)
        : left_(std::move(jobs)), all_(left_.size()), at_once_(at_once), window_(window),
          quiet_(verbosity == Verbosity::quiet)
    {
    }

    void tell(const StudyRow& row)
    {
        std::erase_if(left_, [&](const Job& job) { return job.setting.name == row.setting && job.seed == row.seed; });
        if (row.status == "done") (row.setting == reference_name ? references_ : others_).add(row.cpu * window_);
        if (quiet_) return;
        warn("{}/{}  {}  {} (seed {}): {}\n", all_ - left_.size(), all_, eta(), row.setting, row.seed,
            row.status == "done" ? fmt::format("{:.3g} s CPU for a simulated second", row.cpu) : row.status);
    }

private:
    std::vector<Job> left_;
    std::size_t all_;
    int at_once_;
    double window_;
    bool quiet_;
    MeanAndError references_, others_; ///< CPU time of runs [s]

    std::string eta() const
    {
        double seconds = 0.0;
        for (const Job& job : left_) {
            const MeanAndError& like = job.setting.name == reference_name ? references_ : others_;
            if (like.count() == 0) return "ETA –";
            seconds += like.mean() / at_once_;
        }
        return fmt::format("ETA {:.0f} min", std::ceil(seconds / 60.0));
    }
};

bool goes_on()
{
    return stop_signal() == 0;
}

/// The states that runs start from, one for each seed, where they are not there yet.
/// @throws InputError where one cannot be made: there is nothing to compare then
void make_starts(const StudyFrame& frame, const std::vector<Job>& jobs, int at_once, Verbosity verbosity)
{
    std::vector<std::int64_t> seeds;
    for (const Job& job : jobs)
        if (std::ranges::find(seeds, job.seed) == seeds.end() && !has_start(frame, job.seed)) seeds.push_back(job.seed);
    if (verbosity != Verbosity::quiet && !seeds.empty())
        warn("to the start at {:.4g} s, {} {}\n", frame.start, seeds.size(), seeds.size() > 1 ? "seeds" : "seed");
    std::string failure;
    run_in_copies(
        seeds.size(), at_once, [&](std::size_t k) { return fmt::format(".{}", make_start(frame, seeds[k])); },
        [&](std::size_t, const std::string& words, const std::string& ending) {
            if (words != ".") failure = words.empty() ? ending : words.substr(1);
        },
        goes_on);
    if (!failure.empty())
        throw InputError(fmt::format(
            "{}: the scene itself does not come to the start of the study: {}", frame.scene.string(), failure));
}

void run_jobs(StudyBook& book, const std::vector<Job>& jobs, int at_once, Verbosity verbosity)
{
    StudyProgress progress(jobs, at_once, book.frame().end - book.frame().start, verbosity);
    run_in_copies(
        jobs.size(), at_once,
        [&](std::size_t k) { return row_text(run_setting(book.frame(), jobs[k].setting, jobs[k].seed)); },
        [&](std::size_t k, const std::string& words, const std::string& ending) {
            StudyRow row{.setting = jobs[k].setting.name, .seed = jobs[k].seed, .status = ending};
            if (ending.empty()) row = read_row(words);
            book.add(row);
            book.write_result();
            progress.tell(row);
        },
        goes_on);
}

/// What to run, where, and when. The scene is as the study has it.
StudyFrame frame_of(const CommandLine& line, scene::Study study, const OpenedScene& opened)
{
    StudyFrame frame;
    frame.scene = scene_path(line.scene);
    frame.study = std::move(study);
    frame.folder = line.out.empty() ? fs::path("out") / ("study-" + opened.name) : line.out;
    frame.start = number_or(frame.study.start, automatic_start(opened.scene));
    frame.end = number_or(frame.study.end, opened.scene.time.duration);
    if (!(frame.measured_from() < frame.end))
        throw UsageError(
            fmt::format("the study must end after {:.6g} s, when its settings have settled, not at {:.6g} s",
                frame.measured_from(), frame.end));
    return frame;
}

/// That the scene has where it asks for no accuracy [s]: the reference does not become coarser with the wish.
double usual_step(scene::Scene scene)
{
    scene.accuracy.clear();
    return build_scene(scene).simulation.model.time_step;
}

std::vector<std::int64_t> seeds_of(const StudyFrame& frame, const OpenedScene& opened)
{
    std::vector<std::int64_t> seeds;
    for (std::int64_t k = 0; k < frame.study.seeds; ++k) seeds.push_back(opened.scene.seed + k);
    return seeds;
}

PageHead head_of(const StudyFrame& frame, const OpenedScene& opened)
{
    const Simulation& simulation = opened.simulation;
    const StudyUnits units(simulation);
    PageHead head;
    head.title = opened.scene.title.empty() ? opened.name : opened.scene.title;
    head.what = fmt::format(
        "{} spheres, from {:.4g} s on, measured from {:.4g} to {:.4g} s, {} {}; time step of the default {:.3g} ms. "
        "Units: d = {:.3g} mm the mean diameter, g = {:.3g} m/s², M the mass of all spheres, m of one, h the time "
        "step.",
        simulation.state.count(), frame.start, frame.measured_from(), frame.end, frame.study.seeds,
        frame.study.seeds > 1 ? "seeds" : "seed", 1e3 * simulation.model.time_step, 1e3 * units.diameter,
        units.acceleration);
    if (!frame.study.set.empty()) head.what += fmt::format(" The scene with {}.", fmt::join(frame.study.set, ", "));
    return head;
}

ExitCode tell_result(const StudyResult& result, const StudyFrame& frame, Verbosity verbosity)
{
    if (const int signal = stop_signal(); signal != 0) {
        warn("stopped; to go on: the same command again\n");
        return stopped_by(signal);
    }
    if (verbosity != Verbosity::quiet) {
        for (const std::string& sentence : advice(result)) say("{}\n", sentence);
        say("all of it: {}\n", (frame.folder / "study.html").string());
    }
    return ExitCode::done;
}

} // namespace

ExitCode study_scene(const CommandLine& line)
{
    scene::Study study = line.study.empty() ? scene::Study{} : read_study(line.study);
    study.set.insert(study.set.end(), line.overrides.begin(), line.overrides.end());
    CommandLine as_set = line;
    as_set.overrides = study.set;
    const OpenedScene opened = open_scene(as_set);
    const StudyFrame frame = frame_of(line, std::move(study), opened);
    const FolderLock lock = make_study_folder(frame.folder, identity(opened, frame.study), line.force);
    warn_unless_protected(lock);

    const int at_once = line.threads > 0 ? line.threads : omp_get_num_procs();
    omp_set_num_threads(1); // a copy of a process has one thread; settings run beside each other instead
    catch_signals();

    StudyBook book(
        frame, settings_of(frame.study, usual_step(opened.scene)), seeds_of(frame, opened), head_of(frame, opened));
    const std::vector<Job> jobs = book.missing();
    if (line.verbosity != Verbosity::quiet)
        say("{}: {}\n{} of {} runs to make, {} at a time\noutput: {}\n", opened.name, opened.scene.title, jobs.size(),
            book.runs(), at_once, frame.folder.string());
    make_starts(frame, jobs, at_once, line.verbosity);
    if (goes_on()) run_jobs(book, jobs, at_once, line.verbosity);
    return tell_result(book.write_result(), frame, line.verbosity);
}

} // namespace talus
