# SPDX-License-Identifier: GPL-3.0-or-later
"""What all pictures of a run share is found on some of its frames."""
import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

from colours import array
from read_run import read_frame

SURVEYED_FRAMES = 10  # spread evenly over the run


def surveyed(frames):
    """Some of the frames, as vtkPolyData."""
    spread = numpy.unique(numpy.linspace(0, len(frames) - 1, SURVEYED_FRAMES).round().astype(int))
    return [read_frame(frames[index]) for index in spread]


def points_of(poly_data):
    """The points, one a row."""
    if not poly_data.GetNumberOfPoints():
        return numpy.empty((0, 3))
    return vtk_to_numpy(poly_data.GetPoints().GetData())


def grain_corners(grains):
    """Lowest and highest corner of the box around the grains; no rows where there are none."""
    if not grains.GetNumberOfPoints():
        return numpy.empty((0, 3))
    centres, radii = points_of(grains), array(grains, "radius")[:, None]
    return numpy.array([(centres - radii).min(axis=0), (centres + radii).max(axis=0)])


def diagonal(points):
    return float(numpy.linalg.norm(numpy.ptp(points, axis=0))) if len(points) else 0.0


def box_corners(points):
    """The eight corners of the box around the points."""
    return numpy.array(numpy.meshgrid(*zip(points.min(axis=0), points.max(axis=0)))).reshape(3, 8).T
