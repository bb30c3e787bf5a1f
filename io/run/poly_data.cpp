// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/run/poly_data.hpp"

#include "io/scene/quiet_vtk.hpp"
#include "io/text/input_error.hpp"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <fmt/format.h>

#include <new>

namespace talus
{

namespace
{

void add_time_and_units(vtkFieldData& data, double time)
{
    vtkNew<vtkDoubleArray> time_value;
    time_value->SetName("TimeValue");
    time_value->InsertNextValue(time);
    data.AddArray(time_value);
    vtkNew<vtkStringArray> units;
    units->SetName("units");
    units->InsertNextValue("SI");
    data.AddArray(units);
}

} // namespace

void add_point_cell(vtkPolyData& geometry, std::size_t count)
{
    vtkNew<vtkCellArray> cells;
    if (count > 0) cells->InsertNextCell(static_cast<int>(count));
    for (std::size_t k = 0; k < count; ++k) cells->InsertCellPoint(static_cast<vtkIdType>(k));
    geometry.SetVerts(cells);
}

std::string vtp_bytes(vtkPolyData& geometry, double time)
{
    add_time_and_units(*geometry.GetFieldData(), time);
    const QuietVtk vtk;
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->SetCompressorTypeToLZ4();
    writer->SetHeaderTypeToUInt64();
    writer->SetInputData(&geometry);
    writer->WriteToOutputStringOn();
    const bool written = writer->Write() != 0;
    // The disk is a string here: it had no memory to grow.
    if (writer->GetErrorCode() == vtkErrorCode::OutOfDiskSpaceError) throw std::bad_alloc();
    if (!written || writer->GetErrorCode() != vtkErrorCode::NoError)
        throw OutputError(
            fmt::format("VTK cannot make the frame: {}", vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode())));
    return writer->GetOutputString();
}

std::string frame_list(const std::vector<ListedFrame>& frames)
{
    std::string list = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
    for (const ListedFrame& frame : frames)
        list += fmt::format("    <DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", frame.time, frame.file);
    return list + "  </Collection>\n</VTKFile>\n";
}

} // namespace talus
