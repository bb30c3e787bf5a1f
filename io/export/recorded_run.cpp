// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/export/recorded_run.hpp"

#include "io/scene/scene_file.hpp"
#include "io/scene/vtk_file.hpp"

#include <vtkPolyData.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUtilities.h>

#include <fmt/format.h>

#include <algorithm>

namespace talus
{

namespace fs = std::filesystem;

namespace
{

/// The frames that a .pvd lists; none where the run has not written it.
std::vector<RecordedFrame> read_list(const fs::path& folder, const std::string& series)
{
    const fs::path path = folder / (series + ".pvd");
    if (!fs::exists(path)) return {};
    require_file(path, "a list of frames");
    const QuietVtk vtk;
    const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(path.c_str()));
    vtkXMLDataElement* list = root ? root->FindNestedElementWithName("Collection") : nullptr;
    if (!list) throw InputError(fmt::format("{}: it is not a list of frames", path.string()));
    std::vector<RecordedFrame> frames;
    for (int k = 0; k < list->GetNumberOfNestedElements(); ++k) {
        vtkXMLDataElement* entry = list->GetNestedElement(k);
        RecordedFrame frame;
        const char* file = entry->GetAttribute("file");
        if (!file || !entry->GetScalarAttribute("timestep", frame.time))
            throw InputError(fmt::format("{}: entry {} names no file or no time", path.string(), k));
        frame.file = folder / file;
        frames.push_back(frame);
    }
    std::ranges::stable_sort(frames, {}, &RecordedFrame::time);
    return frames;
}

} // namespace

RecordedRun read_run(const fs::path& folder)
{
    const fs::path scene_path = folder / "scene.resolved.toml";
    if (!fs::is_directory(folder)) throw InputError(fmt::format("{}: there is no such folder", folder.string()));
    if (!fs::exists(scene_path)) throw InputError(fmt::format("{}: the folder holds no run of Talus", folder.string()));
    const scene::Scene scene = parse_scene(read_bytes(scene_path, "a scene"));
    RecordedRun run;
    run.folder = folder;
    run.title = scene.title;
    for (const auto& material : scene.materials) run.materials.push_back(material.name);
    std::ranges::sort(run.materials);
    for (const auto& wall : scene.wall) run.walls.push_back(wall.name);
    for (const std::string& axis : scene.world.periodic) run.periodic[static_cast<std::size_t>(axis[0] - 'x')] = true;
    run.min = scene.world.min;
    run.max = scene.world.max;
    run.particles = read_list(folder, "particles");
    run.contacts = read_list(folder, "contacts");
    run.still_walls = read_list(folder, "walls");
    run.moving_walls = read_list(folder, "moving_walls");
    return run;
}

vtkSmartPointer<vtkPolyData> read_frame(const RecordedFrame& frame)
{
    return read_vtk_file<vtkXMLPolyDataReader>(frame.file, "a frame");
}

} // namespace talus
