// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/export/frame_export.hpp"

#include "io/export/csv_frame.hpp"
#include "io/export/export_folder.hpp"
#include "io/export/lammps_dump.hpp"
#include "io/export/plain_vtp.hpp"
#include "io/export/stl_text.hpp"
#include "io/run/poly_data.hpp"
#include "io/text/input_error.hpp"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <fmt/format.h>

namespace talus
{
namespace
{

/// A series of frames with the name of its files.
struct Series {
    std::string name;
    const std::vector<RecordedFrame>* frames;
};

std::string file_of(const std::string& series, std::size_t frame, const char* ending)
{
    return fmt::format("{}_{:06}.{}", series, frame, ending);
}

/// Calls write(number, time, geometry) for each frame of a series.
void for_each_frame(const std::vector<RecordedFrame>& frames, auto&& write)
{
    for (std::size_t k = 0; k < frames.size(); ++k) write(k, frames[k].time, *read_frame(frames[k]));
}

/// Names of all files where each frame has one.
std::vector<std::string> files_of(const std::vector<Series>& series, const char* ending)
{
    std::vector<std::string> files;
    for (const Series& one : series)
        for (std::size_t k = 0; k < one.frames->size(); ++k) files.push_back(file_of(one.name, k, ending));
    return files;
}

void write_csv(const RecordedRun& run, const std::vector<Series>& series, const ExportFolder& folder)
{
    for (const Series& one : series)
        for_each_frame(*one.frames, [&](std::size_t k, double time, vtkPolyData& data) {
            const bool contacts = one.frames == &run.contacts;
            folder.write(
                file_of(one.name, k, "csv"), contacts ? csv_contacts(data, time, run) : csv_spheres(data, time, run));
        });
}

void write_vtp(const std::vector<Series>& series, const ExportFolder& folder)
{
    for (const Series& one : series) {
        std::vector<ListedFrame> list;
        for_each_frame(*one.frames, [&](std::size_t k, double time, vtkPolyData& data) {
            list.push_back({time, file_of(one.name, k, "vtp")});
            folder.write(list.back().file, plain_vtp(data));
        });
        folder.write(one.name + ".pvd", frame_list(list));
    }
}

void write_dumps(const RecordedRun& run, const std::vector<Series>& walls, const ExportFolder& folder)
{
    StreamedFile particles(folder.path() / particle_dump);
    for_each_frame(run.particles,
        [&](std::size_t k, double time, vtkPolyData& data) { particles.add(dump_particles(data, k, time, run)); });
    particles.finish();
    if (!run.contacts.empty()) {
        StreamedFile between(folder.path() / contact_dump), at_walls(folder.path() / wall_contact_dump);
        for_each_frame(run.contacts, [&](std::size_t k, double time, vtkPolyData& data) {
            between.add(dump_contacts(data, k, time, run, ContactsOf::spheres));
            at_walls.add(dump_contacts(data, k, time, run, ContactsOf::walls));
        });
        between.finish();
        at_walls.finish();
    }
    for (const Series& one : walls)
        for_each_frame(*one.frames, [&](std::size_t k, double, vtkPolyData& data) {
            folder.write(file_of(one.name, k, "stl"), stl_text(data));
        });
}

std::vector<Series> with_frames(std::vector<Series> series)
{
    std::erase_if(series, [](const Series& one) { return one.frames->empty(); });
    return series;
}

void note_few_contacts(const RecordedRun& run, ExportNotes& notes)
{
    if (run.contacts.size() < run.particles.size())
        notes.push_back(fmt::format("contacts are there of {} of {} frames, for so the run has written them: [output] "
                                    "contact_interval asks for more",
            run.contacts.size(), run.particles.size()));
}

} // namespace

ExportNotes export_frames(const RecordedRun& run, FrameFormat format, const std::filesystem::path& folder, bool force)
{
    if (run.particles.empty()) throw InputError(fmt::format("{}: the run has no frames yet", run.folder.string()));
    const std::vector<Series> grains = with_frames({{"particles", &run.particles}, {"contacts", &run.contacts}});
    const std::vector<Series> walls = with_frames({{"walls", &run.still_walls}, {"moving_walls", &run.moving_walls}});
    std::vector<Series> all = grains;
    ExportNotes notes;
    note_few_contacts(run, notes);
    const auto title = [&](const char* name) { return fmt::format("{} of the run {}", name, run.folder.string()); };
    if (format == FrameFormat::csv) {
        write_csv(run, grains, ExportFolder(folder, title("csv"), files_of(grains, "csv"), force));
        if (!walls.empty()) notes.push_back("walls are not in CSV files");
        return notes;
    }
    all.insert(all.end(), walls.begin(), walls.end());
    if (format == FrameFormat::vtp) {
        std::vector<std::string> files = files_of(all, "vtp");
        for (const Series& one : all) files.push_back(one.name + ".pvd");
        write_vtp(all, ExportFolder(folder, title("vtp"), files, force));
    } else {
        std::vector<std::string> files = files_of(walls, "stl");
        files.insert(files.end(), {particle_dump, contact_dump, wall_contact_dump});
        write_dumps(run, walls, ExportFolder(folder, title("lammps-dump"), files, force));
    }
    return notes;
}

} // namespace talus
