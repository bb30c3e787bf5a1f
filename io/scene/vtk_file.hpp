// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/scene/quiet_vtk.hpp"
#include "io/text/input_error.hpp"
#include "io/text/input_file.hpp"

#include <vtkErrorCode.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <fmt/format.h>

#include <exception>

namespace talus
{

/// What one of VTK's readers of XML files makes of a file.
/// @param kind in sentences: "a VTK file"
/// @throws InputError where the file is missing or damaged
template <class Reader> auto read_vtk_file(const std::filesystem::path& path, const std::string& kind)
{
    require_file(path, kind);
    const QuietVtk vtk;
    vtkNew<Reader> reader;
    reader->SetFileName(path.c_str());
    std::string error;
    try {
        reader->Update();
        error = vtk.sentence();
        if (error.empty() && reader->GetErrorCode() != vtkErrorCode::NoError)
            error = vtkErrorCode::GetStringFromErrorCode(reader->GetErrorCode());
    } catch (const std::exception&) { // lists longer than there can be, or than there is memory for
        error = "its sizes are too large to be true";
    }
    if (!error.empty()) throw InputError(fmt::format("{}: VTK cannot read it: {}", path.string(), error));
    return vtkSmartPointer(reader->GetOutput());
}

} // namespace talus
