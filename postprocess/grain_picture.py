# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws spheres and walls with VTK. It needs a window system: render.py brings one."""
from typing import NamedTuple

import numpy
import vtkmodules.vtkRenderingFreeType  # noqa: F401  draws the text
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkCommonDataModel import vtkPlane
from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkFeatureEdges, vtkPolyDataNormals
from vtkmodules.vtkImagingCore import vtkImageShrink3D
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import (vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkTextActor,
                                         vtkWindowToImageFilter)
from vtkmodules.vtkRenderingOpenGL2 import vtkOpenGLSphereMapper

VIEWS = {  # from where one looks, and what is up
    "front": ((0.0, -1.0, 0.2), (0.0, 0.0, 1.0)),
    "side": ((1.0, 0.0, 0.2), (0.0, 0.0, 1.0)),
    "iso": ((0.6, -1.0, 0.7), (0.0, 0.0, 1.0)),
    "top": ((0.0, 0.0, 1.0), (0.0, 1.0, 0.0)),
}
VIEW_ANGLE = 20.0  # degrees; narrow, so that parallels nearly stay parallel
OVERSAMPLING = 2  # drawn pixels across a shown one, as the sphere mapper leaves outlines jagged
MARGIN, BAND = 0.03, 0.12  # shares of the picture left free all round, and at the top for title and colour bar

INK = (0.16, 0.17, 0.20)
WALL = (0.50, 0.57, 0.66)
SAND = (0.94, 0.81, 0.63)
RAMP = ((0.0, SAND), (0.3, (0.97, 0.67, 0.36)), (0.65, (0.82, 0.28, 0.33)), (1.0, (0.35, 0.14, 0.48)))
MATERIALS = (SAND, (0.42, 0.60, 0.75), (0.80, 0.45, 0.36), (0.52, 0.66, 0.45), (0.60, 0.50, 0.68))


class Colouring(NamedTuple):
    """What the colour of the grains tells."""

    label: str  # of the colour bar; empty: no bar
    low: float
    high: float
    steps: int = 256  # how many colours


class Setting(NamedTuple):
    """What the pictures of a run have in common."""

    view: str  # one of VIEWS
    points: numpy.ndarray  # all that must be in the picture [m], one a row
    colouring: Colouring
    size: tuple  # width and height in pixels


def fitting_size(view, points, longest=1200):
    """A size of picture in the shape of what it shows, though neither very narrow nor very flat."""
    right, above, _ = view_axes(view)
    width, height = numpy.ptp(points @ right), numpy.ptp(points @ above)
    ratio = width * (1 - 2 * MARGIN - BAND) / (max(height, 1e-3 * width) * (1 - 2 * MARGIN))
    ratio = min(max(ratio, 0.6), 1.5)
    return (round(longest * min(1.0, ratio)), round(longest / max(1.0, ratio)))


def write_picture(path, grains, values, walls, title, setting):
    """Draws one frame into a PNG file. Raises OSError where that cannot be written.

    grains: vtkPolyData with the array `radius`; values: what colours each of them; walls: vtkPolyData of triangles.
    """
    size = tuple(OVERSAMPLING * pixels for pixels in setting.size)
    renderer = vtkRenderer()
    renderer.SetBackground(1.0, 1.0, 1.0)
    for lamp in lamps():
        renderer.AddLight(lamp)
    if grains.GetNumberOfPoints():
        table = lookup_table(setting.colouring)
        renderer.AddActor(grains_actor(grains, values, table))
        darken_crevices(renderer, float(numpy.mean(grains.GetPointData().GetArray("radius").GetRange())))
        if setting.colouring.label:
            renderer.AddActor2D(colour_bar(table, setting.colouring, size))
    if walls.GetNumberOfCells():
        for actor in wall_actors(walls, line_width=max(size) / 700):
            cut_off_far_away(actor, setting.points)
            renderer.AddActor(actor)
    renderer.AddActor2D(title_line(title, size))
    aim_camera(renderer.GetActiveCamera(), setting, size)
    renderer.ResetCameraClippingRange()
    renderer.SetUseDepthPeeling(True)  # translucent walls behind each other, in the right order
    renderer.SetMaximumNumberOfPeels(8)
    path.write_bytes(png(renderer, size))


def lookup_table(colouring):
    """The colours of a colouring: a ramp, or where it has few steps one colour for each."""
    table = vtkLookupTable()
    table.SetNumberOfTableValues(colouring.steps)
    table.SetTableRange(colouring.low, colouring.high)
    if colouring.steps <= len(MATERIALS):
        colours = MATERIALS[:colouring.steps]
    else:
        places, knots = zip(*RAMP)
        at = numpy.linspace(0.0, 1.0, colouring.steps)
        colours = numpy.array([numpy.interp(at, places, channel) for channel in zip(*knots)]).T
    for index, colour in enumerate(colours):
        table.SetTableValue(index, *colour, 1.0)
    return table


def grains_actor(poly_data, values, table):
    scalars = numpy_to_vtk(numpy.ascontiguousarray(values, dtype=float), deep=True)
    scalars.SetName("colour")
    poly_data.GetPointData().SetScalars(scalars)
    mapper = vtkOpenGLSphereMapper()
    mapper.SetInputData(poly_data)
    mapper.SetScaleArray("radius")
    mapper.SetLookupTable(table)
    mapper.UseLookupTableScalarRangeOn()
    actor = vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetAmbient(0.42)
    look.SetDiffuse(0.78)
    look.SetSpecular(0.15)
    look.SetSpecularPower(25.0)
    return actor


def darken_crevices(renderer, radius):
    """Ambient occlusion over a grain or so, by which one sees which grain lies in front."""
    renderer.SetUseSSAO(True)
    renderer.SetSSAORadius(2.4 * radius)
    renderer.SetSSAOBias(0.1 * radius)
    renderer.SetSSAOKernelSize(64)
    renderer.SetSSAOBlur(True)


def wall_actors(poly_data, line_width):
    """Walls as translucent faces, with their rims and sharp edges as lines."""
    merged = vtkCleanPolyData()  # corners shared, or every edge would be a rim
    merged.SetInputData(poly_data)
    smooth = vtkPolyDataNormals()
    smooth.SetInputConnection(merged.GetOutputPort())
    smooth.SetFeatureAngle(20.0)
    faces = plain_actor(smooth, WALL)
    faces.GetProperty().SetOpacity(0.16)
    faces.GetProperty().SetAmbient(0.5)
    faces.GetProperty().SetDiffuse(0.5)

    edges = vtkFeatureEdges()
    edges.SetInputConnection(merged.GetOutputPort())
    edges.SetFeatureAngle(20.0)
    lines = plain_actor(edges, INK)
    lines.GetProperty().SetOpacity(0.55)
    lines.GetProperty().SetLineWidth(line_width)
    lines.GetProperty().LightingOff()
    return [faces, lines]


def cut_off_far_away(actor, points):
    """Hides what lies far outside the box of the points, as a plane may be very large."""
    beyond = 0.12 * numpy.linalg.norm(numpy.ptp(points, axis=0))
    for axis in numpy.eye(3):
        for inwards in (axis, -axis):
            plane = vtkPlane()
            plane.SetNormal(inwards)
            plane.SetOrigin(((points @ inwards).min() - beyond) * inwards)
            actor.GetMapper().AddClippingPlane(plane)


def plain_actor(source, colour):
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(colour)
    return actor


def lamps():
    """A lamp over the left shoulder and a weaker one at the eye."""
    for position, intensity in (((-0.7, 0.9, 1.0), 0.8), ((0.0, 0.0, 1.0), 0.42)):
        lamp = vtkLight()
        lamp.SetLightTypeToCameraLight()
        lamp.SetPosition(position)
        lamp.SetIntensity(intensity)
        yield lamp


def title_line(text, size):
    line = vtkTextActor()
    line.SetInput(text)
    plain_text(line.GetTextProperty(), min(0.029 * size[1], 1.8 * size[0] / len(text)))
    line.GetTextProperty().SetVerticalJustificationToTop()
    line.SetPosition(MARGIN * size[0], (1.0 - MARGIN) * size[1])
    return line


def colour_bar(table, colouring, size):
    """A small bar under the title, with its meaning above and its values below."""
    bar = vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetTitle(colouring.label)
    bar.SetOrientationToHorizontal()
    bar.SetTextPositionToPrecedeScalarBar()
    bar.SetNumberOfLabels(colouring.steps if colouring.steps <= len(MATERIALS) else 3)
    bar.SetLabelFormat("%.6g")
    bar.UnconstrainedFontSizeOn()
    bar.SetVerticalTitleSeparation(size[1] // 200)
    for text in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        plain_text(text, 0.02 * size[1])
    bar.SetPosition(MARGIN, 1.0 - MARGIN - BAND)
    bar.SetWidth(min(0.35, 0.3 * size[1] / size[0]))
    bar.SetHeight(0.076)
    bar.SetBarRatio(0.25)
    return bar


def plain_text(text, height):
    text.SetFontFamilyToArial()
    text.SetFontSize(round(height))
    text.SetColor(INK)
    text.BoldOff()
    text.ItalicOff()
    text.ShadowOff()


def view_axes(view):
    """Unit vectors to the right, upwards in the picture, and towards the eye."""
    towards_eye, up = (numpy.array(vector) / numpy.linalg.norm(vector) for vector in VIEWS[view])
    right = numpy.cross(up, towards_eye)
    right /= numpy.linalg.norm(right)
    return right, numpy.cross(towards_eye, right), towards_eye


def aim_camera(camera, setting, size):
    """Moves back from the points along the view until all of them lie in the picture, below the band at the top."""
    right, above, towards_eye = view_axes(setting.view)
    middle = (setting.points.min(axis=0) + setting.points.max(axis=0)) / 2
    x, y, depth = ((setting.points - middle) @ axis for axis in (right, above, towards_eye))
    slope = numpy.tan(numpy.radians(VIEW_ANGLE / 2))  # half a picture's height at unit distance
    across, upwards = slope * (1 - 2 * MARGIN) * size[0] / size[1], slope * (1 - 2 * MARGIN - BAND)
    distance = (depth + numpy.maximum(numpy.abs(x) / across, numpy.abs(y) / upwards)).max()
    camera.SetViewAngle(VIEW_ANGLE)
    camera.SetFocalPoint(middle)
    camera.SetPosition(middle + distance * towards_eye)
    camera.SetViewUp(above)
    camera.SetWindowCenter(0.0, BAND)


def png(renderer, size):
    """The picture as the bytes of a PNG file."""
    window = vtkRenderWindow()
    window.OffScreenRenderingOn()
    window.SetSize(*size)
    window.SetMultiSamples(0)
    window.AlphaBitPlanesOn()  # for the depth peeling
    window.AddRenderer(renderer)
    drawn = vtkWindowToImageFilter()
    drawn.SetInput(window)
    drawn.ReadFrontBufferOff()
    shown = vtkImageShrink3D()
    shown.SetInputConnection(drawn.GetOutputPort())
    shown.SetShrinkFactors(OVERSAMPLING, OVERSAMPLING, 1)
    shown.MeanOn()
    writer = vtkPNGWriter()
    writer.SetInputConnection(shown.GetOutputPort())
    writer.WriteToMemoryOn()
    writer.Write()
    return bytes(vtk_to_numpy(writer.GetResult()))
