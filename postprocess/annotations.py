# SPDX-License-Identifier: GPL-3.0-or-later
"""What stands over the drawing: title, colour bar and legend, in pixels of the drawn picture."""
import numpy
import vtkmodules.vtkRenderingFreeType  # noqa: F401  draws the text
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor2D, vtkPolyDataMapper2D, vtkTextActor

from palette import INK, MATERIALS

MARGIN, BAND = 0.03, 0.12  # shares of the picture left free all round, and at the top for title and colour bar


def white_edge(size):
    """A strip over the upper edge: there the shade of what the lower edge cuts appears again."""
    height = 0.5 * MARGIN * size[1]
    mapper = vtkPolyDataMapper2D()
    mapper.SetInputData(polygon([(0, 0, 0), (size[0], 0, 0), (size[0], height, 0), (0, height, 0)]))
    strip = vtkActor2D()
    strip.SetMapper(mapper)
    strip.SetPosition(0, size[1] - height)
    strip.GetProperty().SetColor(1.0, 1.0, 1.0)
    return strip


def title_line(words, size):
    height = min(0.029 * size[1], 1.8 * size[0] / len(words))
    line = text_actor(words, height, MARGIN * size[0], (1.0 - MARGIN) * size[1])
    line.GetTextProperty().SetVerticalJustificationToTop()
    return line


def label_height(size):
    """Of all words but the title, in pixels of the drawn picture."""
    return min(0.022 * size[1], 0.032 * size[0])


def colour_bar(table, label, size):
    """A small bar under the title, with its values and its meaning below."""
    height = label_height(size)
    width = min(0.35 * size[0], 0.3 * size[1])
    left, bottom = MARGIN * size[0], (1.0 - MARGIN - 0.075) * size[1]
    steps = table.GetNumberOfTableValues()
    edges = numpy.linspace(0.0, width, steps + 1)
    points, cells = vtkPoints(), vtkCellArray()
    for edge in edges:
        points.InsertNextPoint(edge, 0.0, 0.0)
        points.InsertNextPoint(edge, height, 0.0)
    for step in range(steps):
        cells.InsertNextCell(4, [2 * step, 2 * step + 2, 2 * step + 3, 2 * step + 1])
    strip = vtkPolyData()
    strip.SetPoints(points)
    strip.SetPolys(cells)
    low, high = table.GetTableRange()
    strip.GetCellData().SetScalars(numpy_to_vtk(numpy.linspace(low, high, steps), deep=True))
    mapper = vtkPolyDataMapper2D()
    mapper.SetInputData(strip)
    mapper.SetLookupTable(table)
    mapper.UseLookupTableScalarRangeOn()
    bar = vtkActor2D()
    bar.SetMapper(mapper)
    bar.SetPosition(left, bottom)
    yield bar
    below = bottom - 0.008 * size[1]
    for share in (0.0, 0.5, 1.0):
        value = text_actor(f"{low + share * (high - low):.3g}", 0.9 * height, left + share * width, below)
        value.GetTextProperty().SetVerticalJustificationToTop()
        if share > 0.0:
            value.GetTextProperty().SetJustificationToCentered()
        yield value
    meaning = text_actor(label, height, left + width + 1.4 * height, bottom + 0.5 * height)
    meaning.GetTextProperty().SetVerticalJustificationToCentered()
    yield meaning


def legend(names, size):
    """Under the title a square in its colour for each name, and the name."""
    height = label_height(size)
    left, bottom = MARGIN * size[0], (1.0 - MARGIN - 0.075) * size[1]
    for index, name in enumerate(names):
        square = vtkActor2D()
        mapper = vtkPolyDataMapper2D()
        mapper.SetInputData(polygon([(0, 0, 0), (height, 0, 0), (height, height, 0), (0, height, 0)]))
        square.SetMapper(mapper)
        square.SetPosition(left, bottom)
        square.GetProperty().SetColor(MATERIALS[index % len(MATERIALS)])
        yield square
        text = text_actor(name, height, left + 1.4 * height, bottom + 0.5 * height)
        text.GetTextProperty().SetVerticalJustificationToCentered()
        yield text
        left += height * (3.0 + 0.6 * len(name))


def text_actor(words, height, left, bottom):
    """Words at a place of the drawn picture, in its pixels."""
    actor = vtkTextActor()
    actor.SetInput(words)
    text = actor.GetTextProperty()
    text.SetFontFamilyToArial()
    text.SetFontSize(round(height))
    text.SetColor(INK)
    text.BoldOff()
    text.ItalicOff()
    text.ShadowOff()
    actor.SetPosition(left, bottom)
    return actor


def polygon(corners):
    """One polygon as vtkPolyData."""
    points = vtkPoints()
    for corner in corners:
        points.InsertNextPoint(*corner)
    cells = vtkCellArray()
    cells.InsertNextCell(len(corners), list(range(len(corners))))
    poly_data = vtkPolyData()
    poly_data.SetPoints(points)
    poly_data.SetPolys(cells)
    return poly_data
