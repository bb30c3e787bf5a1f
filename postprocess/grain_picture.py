# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws spheres, walls and force chains with VTK. It needs a window system: render.py brings one."""
from typing import NamedTuple

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLookupTable, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPlane, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkFeatureEdges, vtkPolyDataNormals, vtkTubeFilter
from vtkmodules.vtkImagingCore import vtkImageShrink3D
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow,
                                         vtkWindowToImageFilter)
from vtkmodules.vtkRenderingOpenGL2 import vtkOpenGLSphereMapper

from annotations import BAND, MARGIN, colour_bar, legend, polygon, title_line, white_edge
from camera import Clip, View
from colours import Colouring
from palette import FAINT_GRAIN, FORCES, INK, MATERIALS, RAMP, WALL

VIEW_ANGLE = 20.0  # degrees; narrow, so that parallels nearly stay parallel
OVERSAMPLING = 2  # drawn pixels across a shown one, as the sphere mapper leaves outlines jagged
BEYOND = 0.12  # how far walls are drawn round what is to be seen, by its diagonal …
PLANE_BEYOND = 6.0  # … and planes, which have no end


class Setting(NamedTuple):
    """What the pictures of a run have in common."""

    view: View
    points: numpy.ndarray  # all that must be in the picture [m], one a row
    colouring: Colouring
    size: tuple  # width and height in pixels
    zoom: float = 1.0
    center: numpy.ndarray = None  # what is in the middle [m]; None: that of the points
    clip: Clip = None
    strongest: float = 0.0  # force of the thickest chains [N]


class Content(NamedTuple):
    """What one picture shows."""

    title: str
    grains: vtkPolyData  # with the array `radius`
    values: numpy.ndarray  # what colours each of the grains
    walls: vtkPolyData  # triangles, without those of planes and of …
    wall_grains: vtkPolyData  # … walls of grains
    planes: list  # a point and a normal of each
    contacts: vtkPolyData = None  # lines with `normal_force`, drawn as tubes, with the grains faint


def fitting_size(view, points, longest=1200):
    """A size of picture in the shape of what it shows, though neither very narrow nor very flat."""
    width, height = numpy.ptp(points @ view.right), numpy.ptp(points @ view.above)
    ratio = width * (1 - 2 * MARGIN - BAND) / (max(height, 1e-3 * width) * (1 - 2 * MARGIN))
    ratio = min(max(ratio, 0.6), 1.5)
    return tuple(2 * round(longest / 2 * side) for side in (min(1.0, ratio), 1 / max(1.0, ratio)))


class Painter:
    """Draws one picture after the other into the same window."""

    def __init__(self, setting):
        self.setting = setting
        self.drawn_size = tuple(OVERSAMPLING * pixels for pixels in setting.size)
        self.renderer = vtkRenderer()
        self.renderer.SetBackground(1.0, 1.0, 1.0)
        self.renderer.SetUseDepthPeeling(True)  # translucent walls behind each other, in the right order
        self.renderer.SetMaximumNumberOfPeels(8)
        for lamp in lamps():
            self.renderer.AddLight(lamp)
        self.window = vtkRenderWindow()
        self.window.OffScreenRenderingOn()
        self.window.SetSize(*self.drawn_size)
        self.window.SetMultiSamples(0)
        self.window.AlphaBitPlanesOn()  # for the depth peeling
        self.window.AddRenderer(self.renderer)
        aim_camera(self.renderer.GetActiveCamera(), setting)

    def png(self, content):
        """The picture as the bytes of a PNG file."""
        image = self._draw(content)  # to be kept: what a connection leads to is not
        writer = vtkPNGWriter()
        writer.SetInputConnection(image.GetOutputPort())
        writer.WriteToMemoryOn()
        writer.Write()
        return bytes(vtk_to_numpy(writer.GetResult()))

    def pixels(self, content):
        """The picture as an array of rows from above, each of pixels with red, green and blue from 0 to 255."""
        image = self._draw(content)
        width, height = self.setting.size
        colours = vtk_to_numpy(image.GetOutput().GetPointData().GetScalars()).reshape(height, width, -1)
        return numpy.ascontiguousarray(colours[::-1, :, :3])

    def _draw(self, content):
        setting, renderer = self.setting, self.renderer
        renderer.RemoveAllViewProps()
        if content.grains.GetNumberOfPoints():
            self._add_grains(content)
        if content.walls.GetNumberOfCells():
            for actor in wall_actors(content.walls, line_width=max(self.drawn_size) / 700):
                cut_off(actor, setting, BEYOND)
                renderer.AddActor(actor)
        if content.wall_grains.GetNumberOfCells():
            actor = wall_faces(content.wall_grains, feature_angle=180.0)
            cut_off(actor, setting, BEYOND)
            renderer.AddActor(actor)
        for point, normal in content.planes:
            actor = plane_actor(point, normal, setting)
            cut_off(actor, setting, PLANE_BEYOND, clipped=abs(normal @ setting.view.above) < 0.7)
            renderer.AddActor(actor)
        renderer.AddActor2D(white_edge(self.drawn_size))
        renderer.AddActor2D(title_line(content.title, self.drawn_size))
        renderer.ResetCameraClippingRange()
        drawn = vtkWindowToImageFilter()
        drawn.SetInput(self.window)
        drawn.ReadFrontBufferOff()
        shown = vtkImageShrink3D()
        shown.SetInputConnection(drawn.GetOutputPort())
        shown.SetShrinkFactors(OVERSAMPLING, OVERSAMPLING, 1)
        shown.MeanOn()
        shown.Update()
        return shown

    def _add_grains(self, content):
        setting, renderer = self.setting, self.renderer
        radius = float(numpy.mean(content.grains.GetPointData().GetArray("radius").GetRange()))
        if content.contacts is not None:
            # no shade in the crevices: it would hide what is behind translucent grains
            renderer.SetUseSSAO(False)
            renderer.AddActor(faint_grains_actor(content.grains))
            table = ramp_table(0.0, setting.strongest, FORCES)
            if content.contacts.GetNumberOfCells():
                renderer.AddActor(chains_actor(content.contacts, setting.strongest, radius, table))
            self._add_flat(colour_bar(table, "normal force [N]", self.drawn_size))
            return
        colouring = setting.colouring
        table = step_table(len(colouring.names)) if colouring.names else ramp_table(colouring.low, colouring.high, RAMP)
        renderer.AddActor(grains_actor(content.grains, content.values, table))
        darken_crevices(renderer, radius)
        if colouring.names:
            self._add_flat(legend(colouring.names, self.drawn_size))
        elif colouring.label:
            self._add_flat(colour_bar(table, colouring.label, self.drawn_size))

    def _add_flat(self, actors):
        for actor in actors:
            self.renderer.AddActor2D(actor)


def ramp_table(low, high, ramp, steps=256):
    """Colours from a value to another along a ramp."""
    places, knots = zip(*ramp)
    at = numpy.linspace(0.0, 1.0, steps)
    table = vtkLookupTable()
    table.SetNumberOfTableValues(steps)
    table.SetTableRange(low, high if high > low else low + 1.0)
    for index, colour in enumerate(zip(*(numpy.interp(at, places, channel) for channel in zip(*knots)))):
        table.SetTableValue(index, *colour, 1.0)
    return table


def step_table(count):
    """A colour for each of the values 0, 1, …"""
    table = vtkLookupTable()
    table.SetNumberOfTableValues(max(1, count))
    table.SetTableRange(-0.5, max(1, count) - 0.5)
    for index in range(max(1, count)):
        table.SetTableValue(index, *MATERIALS[index % len(MATERIALS)], 1.0)
    return table


def spheres_actor(poly_data, values, table):
    mapper = vtkOpenGLSphereMapper()
    mapper.SetInputData(poly_data)
    mapper.SetScaleArray("radius")
    if table is None:
        mapper.ScalarVisibilityOff()
    else:
        scalars = numpy_to_vtk(numpy.ascontiguousarray(values, dtype=float), deep=True)
        scalars.SetName("colour")
        poly_data.GetPointData().SetScalars(scalars)
        mapper.SetLookupTable(table)
        mapper.UseLookupTableScalarRangeOn()
    actor = vtkActor()
    actor.SetMapper(mapper)
    return actor


def grains_actor(poly_data, values, table):
    actor = spheres_actor(poly_data, values, table)
    look = actor.GetProperty()
    look.SetAmbient(0.42)
    look.SetDiffuse(0.78)
    look.SetSpecular(0.15)
    look.SetSpecularPower(25.0)
    return actor


def faint_grains_actor(poly_data):
    """Grains through which one sees what is behind."""
    actor = spheres_actor(poly_data, None, None)
    actor.GetProperty().SetColor(FAINT_GRAIN)
    actor.GetProperty().SetOpacity(0.25)
    return actor


def chains_actor(contacts, strongest, radius, table):
    """Contacts as tubes, as thick as their force; one as strong as `strongest` [N] has 0.4 times the
    radius of a grain."""
    force = vtk_to_numpy(contacts.GetCellData().GetArray("normal_force")).astype(float)
    ends = vtk_to_numpy(contacts.GetPoints().GetData()).reshape(-1, 2, 3)
    drawn = force > 0.02 * strongest
    force, ends = force[drawn], ends[drawn]
    lines = vtkPolyData()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(numpy.ascontiguousarray(ends.reshape(-1, 3)), deep=True))
    lines.SetPoints(points)
    cells = vtkCellArray()
    pairs = numpy.arange(2 * len(force), dtype=numpy.int64)
    cells.SetData(2, numpy_to_vtkIdTypeArray(pairs, deep=True))
    lines.SetLines(cells)
    share = numpy.repeat(numpy.minimum(force / strongest, 1.5), 2)
    thickness = numpy_to_vtk(0.4 * radius * numpy.maximum(share, 0.08), deep=True)
    thickness.SetName("thickness")
    lines.GetPointData().SetScalars(thickness)
    shown_force = numpy_to_vtk(numpy.repeat(force, 2), deep=True)
    shown_force.SetName("force")
    lines.GetPointData().AddArray(shown_force)
    tubes = vtkTubeFilter()
    tubes.SetInputData(lines)
    tubes.SetVaryRadiusToVaryRadiusByAbsoluteScalar()
    tubes.SetNumberOfSides(10)
    tubes.CappingOn()
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(tubes.GetOutputPort())
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("force")
    mapper.SetLookupTable(table)
    mapper.UseLookupTableScalarRangeOn()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetAmbient(0.35)
    actor.GetProperty().SetDiffuse(0.75)
    return actor


def darken_crevices(renderer, radius):
    """Ambient occlusion over a grain or so, by which one sees which grain lies in front."""
    renderer.SetUseSSAO(True)
    renderer.SetSSAORadius(2.4 * radius)
    renderer.SetSSAOBias(0.1 * radius)
    renderer.SetSSAOKernelSize(64)
    renderer.SetSSAOBlur(True)


def merged_corners(poly_data):
    """Triangles that share their corners, or every edge would be a rim."""
    merged = vtkCleanPolyData()
    merged.SetInputData(poly_data)
    merged.Update()
    return merged.GetOutput()


def wall_faces(poly_data, feature_angle):
    """The faces of walls, shaded as if they were smooth where they meet at less than the angle [degrees]."""
    smooth = vtkPolyDataNormals()
    smooth.SetInputData(merged_corners(poly_data))
    smooth.SetFeatureAngle(feature_angle)
    smooth.Update()
    faces = plain_actor(smooth, WALL)
    faces.GetProperty().SetAmbient(0.5)
    faces.GetProperty().SetDiffuse(0.5)
    return faces


def wall_actors(poly_data, line_width):
    """Walls as translucent faces, with their rims and sharp edges as lines."""
    faces = wall_faces(poly_data, feature_angle=20.0)
    faces.GetProperty().SetOpacity(0.16)
    edges = vtkFeatureEdges()
    edges.SetInputData(merged_corners(poly_data))
    edges.SetFeatureAngle(20.0)
    edges.Update()
    lines = plain_actor(edges, INK)
    lines.GetProperty().SetOpacity(0.55)
    lines.GetProperty().SetLineWidth(line_width)
    lines.GetProperty().LightingOff()
    return [faces, lines]


def plane_actor(point, normal, setting):
    """A plane as a large square round what is to be seen."""
    middle = (setting.points.min(axis=0) + setting.points.max(axis=0)) / 2
    middle = middle - ((middle - point) @ normal) * normal
    side = 10 * numpy.linalg.norm(numpy.ptp(setting.points, axis=0))
    u = numpy.cross(normal, numpy.eye(3)[numpy.argmin(numpy.abs(normal))])
    u /= numpy.linalg.norm(u)
    v = numpy.cross(normal, u)
    square = polygon([middle + side * (a * u + b * v) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))])
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(square)
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(WALL)
    actor.GetProperty().SetOpacity(0.16)
    actor.GetProperty().LightingOff()
    return actor


def cut_off(actor, setting, beyond, clipped=True):
    """Hides what lies far outside the box of the points, and where it is clipped what the clip plane cuts away.

    beyond: how far, by the diagonal of the box
    """
    beyond = beyond * numpy.linalg.norm(numpy.ptp(setting.points, axis=0))
    sides = [(((setting.points @ inwards).min() - beyond) * inwards, inwards)
             for axis in numpy.eye(3) for inwards in (axis, -axis)]
    if setting.clip and clipped:
        # VTK has six clipping planes: that of the user is in place of the one that faces the same way.
        sides = [(point, inwards) for point, inwards in sides if inwards @ setting.clip.inwards < 0.5]
        sides.append(setting.clip)
    for point, inwards in sides:
        plane = vtkPlane()
        plane.SetNormal(inwards)
        plane.SetOrigin(point)
        actor.GetMapper().AddClippingPlane(plane)


def plain_actor(source, colour):
    """What a filter has made, in one colour."""
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(source.GetOutput())
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


def aim_camera(camera, setting):
    """Moves back from the points along the view until all of them lie in the picture, below the band at the top; then
    nearer by the zoom."""
    size, view = setting.size, setting.view
    middle = (setting.points.min(axis=0) + setting.points.max(axis=0)) / 2
    x, y, depth = ((setting.points - middle) @ axis for axis in view)
    slope = numpy.tan(numpy.radians(VIEW_ANGLE / 2))  # half a picture's height at unit distance
    across, upwards = slope * (1 - 2 * MARGIN) * size[0] / size[1], slope * (1 - 2 * MARGIN - BAND)
    distance = (depth + numpy.maximum(numpy.abs(x) / across, numpy.abs(y) / upwards)).max()
    if setting.center is not None:
        middle = setting.center
    camera.SetViewAngle(2 * numpy.degrees(numpy.arctan(slope / setting.zoom)))
    camera.SetFocalPoint(middle)
    camera.SetPosition(middle + distance * view.towards_eye)
    camera.SetViewUp(view.above)
    camera.SetWindowCenter(0.0, BAND)
