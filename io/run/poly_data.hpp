// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/vector.hpp"

#include <vtkDataSetAttributes.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <string>
#include <vector>

/// From our numbers to VTK's arrays: 32-bit floats and integers, as the frames have them; places far from the origin
/// have 64 bits.
namespace talus
{

/// Whether 32 bits lose more than a thousandth of a diameter of places that far from the origin along an axis [m].
inline bool needs_64_bits(double distance, double diameter)
{
    return distance * 0x1p-24 > 1e-3 * diameter;
}

/// Adds an array of `count` floats, value(i) each.
void add_floats(vtkDataSetAttributes& data, const char* name, std::size_t count, auto&& value)
{
    vtkNew<vtkFloatArray> array;
    array->SetName(name);
    array->SetNumberOfTuples(static_cast<vtkIdType>(count));
    for (std::size_t i = 0; i < count; ++i) array->SetValue(static_cast<vtkIdType>(i), static_cast<float>(value(i)));
    data.AddArray(array);
}

/// Adds an array of `count` vectors, value(i) each.
void add_vectors(vtkDataSetAttributes& data, const char* name, std::size_t count, auto&& value)
{
    vtkNew<vtkFloatArray> array;
    array->SetName(name);
    array->SetNumberOfComponents(3);
    array->SetNumberOfTuples(static_cast<vtkIdType>(count));
    for (std::size_t i = 0; i < count; ++i) {
        const Eigen::Vector3f vector = value(i).template cast<float>();
        array->SetTypedTuple(static_cast<vtkIdType>(i), vector.data());
    }
    data.AddArray(array);
}

/// Adds an array of `count` integers, value(i) each.
void add_integers(vtkDataSetAttributes& data, const char* name, std::size_t count, auto&& value)
{
    vtkNew<vtkIntArray> array;
    array->SetName(name);
    array->SetNumberOfTuples(static_cast<vtkIdType>(count));
    for (std::size_t i = 0; i < count; ++i) array->SetValue(static_cast<vtkIdType>(i), static_cast<int>(value(i)));
    data.AddArray(array);
}

/// Gives a geometry `count` points, place(i) each.
/// @param diameter of the spheres, mean [m]
void set_points(vtkPolyData& geometry, std::size_t count, double diameter, auto&& place)
{
    double distance = 0.0;
    for (std::size_t i = 0; i < count; ++i) distance = std::max(distance, Vec3(place(i)).cwiseAbs().maxCoeff());
    vtkNew<vtkPoints> points;
    points->SetDataType(needs_64_bits(distance, diameter) ? VTK_DOUBLE : VTK_FLOAT);
    points->SetNumberOfPoints(static_cast<vtkIdType>(count));
    for (std::size_t i = 0; i < count; ++i) points->SetPoint(static_cast<vtkIdType>(i), Vec3(place(i)).data());
    geometry.SetPoints(points);
}

/// Makes one cell of all `count` points: without any cell ParaView shows nothing, and one for each would double the
/// file.
void add_point_cell(vtkPolyData& geometry, std::size_t count);

/// The bytes of a .vtp file: appended raw, LZ4, with `TimeValue` [s] and `units` in its field data.
/// @throws std::bad_alloc; OutputError where VTK fails
std::string vtp_bytes(vtkPolyData& geometry, double time);

/// A frame as a .pvd lists it.
struct ListedFrame {
    double time; ///< [s]
    std::string file;
};

/// The text of a .pvd file.
std::string frame_list(const std::vector<ListedFrame>& frames);

} // namespace talus
