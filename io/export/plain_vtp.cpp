// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/export/plain_vtp.hpp"

#include "io/run/poly_data.hpp"
#include "io/scene/quiet_vtk.hpp"
#include "io/text/input_error.hpp"

#include <vtkCellArray.h>
#include <vtkErrorCode.h>
#include <vtkXMLPolyDataWriter.h>

#include <fmt/format.h>

namespace talus
{

std::string plain_vtp(vtkPolyData& frame)
{
    vtkNew<vtkPolyData> geometry;
    geometry->ShallowCopy(&frame);
    if (frame.GetNumberOfVerts() > 0) { // spheres, of which a frame has one cell for all
        vtkNew<vtkCellArray> cells;
        for (vtkIdType point = 0; point < frame.GetNumberOfPoints(); ++point) cells->InsertNextCell({point});
        geometry->SetVerts(cells);
    }
    const QuietVtk vtk;
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetDataModeToBinary();
    writer->SetCompressorTypeToZLib();
    writer->SetHeaderTypeToUInt32();
    writer->SetInputData(geometry);
    writer->WriteToOutputStringOn();
    if (writer->Write() == 0 || writer->GetErrorCode() != vtkErrorCode::NoError)
        throw OutputError(
            fmt::format("VTK cannot make the frame: {}", vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode())));
    return writer->GetOutputString();
}

} // namespace talus
