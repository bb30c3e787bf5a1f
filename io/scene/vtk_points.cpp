// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/vtk_points.hpp"

#include "io/scene/quiet_vtk.hpp"
#include "io/scene/trial_run.hpp"
#include "io/text/input_error.hpp"
#include "io/text/input_file.hpp"

#include <vtkErrorCode.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <fmt/format.h>

#include <exception>
#include <string>

namespace talus
{

namespace
{

template <class Reader> vtkSmartPointer<vtkPointSet> read_with(const std::filesystem::path& path)
{
    const QuietVtk vtk;
    vtkNew<Reader> reader;
    reader->SetFileName(path.c_str());
    try {
        reader->Update();
    } catch (const std::exception&) { // lists longer than there can be, or than there is memory for
        throw InputError(fmt::format("{}: VTK cannot read it: its sizes are too large to be true", path.string()));
    }
    const std::string error = vtk.sentence();
    if (!error.empty()) throw InputError(fmt::format("{}: VTK cannot read it: {}", path.string(), error));
    if (reader->GetErrorCode() != vtkErrorCode::NoError)
        throw InputError(fmt::format(
            "{}: VTK cannot read it: {}", path.string(), vtkErrorCode::GetStringFromErrorCode(reader->GetErrorCode())));
    return reader->GetOutput();
}

vtkSmartPointer<vtkPointSet> read_unprotected(const std::filesystem::path& path)
{
    return path.extension() == ".vtp" ? read_with<vtkXMLPolyDataReader>(path)
                                      : read_with<vtkXMLUnstructuredGridReader>(path);
}

/// What VTK may use to read a file of this size. Compressed files grow at most a thousandfold, and that is far.
TrialLimits limits_for(std::uintmax_t size)
{
    return {.seconds = 10 + static_cast<int>(size >> 20), .memory = (std::size_t{256} << 20) + 32 * size};
}

} // namespace

vtkSmartPointer<vtkPointSet> read_points(const std::filesystem::path& path)
{
    require_file(path, "a VTK file");
    // A damaged file may crash VTK's reader, or have it ask for more memory than there is.
    try_in_a_copy([&] { read_unprotected(path); }, limits_for(std::filesystem::file_size(path)),
        fmt::format("{}: VTK cannot read it: the file is damaged, or holds more than its size allows", path.string()));
    return read_unprotected(path);
}

} // namespace talus
