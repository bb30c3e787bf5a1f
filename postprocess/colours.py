# SPDX-License-Identifier: GPL-3.0-or-later
"""What the colour of the grains tells: any array of the frames, with its unit, and a scale for all frames of a run."""
from typing import NamedTuple

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

from read_run import RunError

UNITS = {"radius": "mm", "velocity": "m/s", "angular_velocity": "rad/s", "force": "N", "x": "m", "y": "m", "z": "m"}
FACTORS = {"radius": 1e3}  # to that unit from SI
NAMES = {"velocity": "speed", "angular_velocity": "spin"}  # of the size of a vector
AXES = ("x", "y", "z")
RAMP_SHARE = 0.98  # of the values lie below the last colour, so that a few fast grains do not ruin the scale


class Colouring(NamedTuple):
    """What the colour of the grains tells."""

    label: str  # of the colour bar; empty: no bar
    low: float
    high: float
    names: tuple = ()  # of the values 0, 1, …, where they have names; then each has a colour of its own


def array(poly_data, name):
    """The values of an array of the points.

    Raises RunError where the frame has none of this name.
    """
    values = poly_data.GetPointData().GetArray(name)
    if values is None:
        data = poly_data.GetPointData()
        there = [data.GetArrayName(k) for k in range(data.GetNumberOfArrays())]
        raise RunError(f"The frames hold no '{name}', only {', '.join(there)}, and x, y, z; see particle_arrays in the "
                       "scene's [output].")
    return vtk_to_numpy(values)


def quantity_and_axis(color_by):
    """"velocity_z" is the array velocity and the axis 2; "velocity" has no axis."""
    name, _, ending = color_by.rpartition("_")
    return (name, AXES.index(ending)) if name and ending in AXES else (color_by, None)


def grain_values(grains, color_by):
    """A number for each grain."""
    count = grains.GetNumberOfPoints()
    if color_by == "none" or not count:
        return numpy.zeros(count)
    if color_by in AXES:
        return vtk_to_numpy(grains.GetPoints().GetData())[:, AXES.index(color_by)]
    name, axis = quantity_and_axis(color_by)
    values = array(grains, name)
    if values.ndim == 2:
        values = numpy.linalg.norm(values, axis=1) if axis is None else values[:, axis]
    return values * FACTORS.get(name, 1)


def label_of(color_by):
    name, axis = quantity_and_axis(color_by)
    words = name.replace("_", " ") if axis is not None else NAMES.get(name, name.replace("_", " "))
    unit = UNITS.get(name)
    return words + (f" {AXES[axis]}" if axis is not None else "") + (f" [{unit}]" if unit else "")


def round_up(value):
    """The next of 1, 2, 5, 10, …"""
    power = 10.0 ** numpy.floor(numpy.log10(value))
    return next(step * power for step in (1, 2, 5, 10) if step * power >= 0.999 * value)


def colouring(color_by, values, materials, limits):
    """How values like these are coloured.

    materials: their names by index; limits: lowest and highest value of the scale, or None for one by the values.
    """
    if color_by == "none" or not values.size:
        return Colouring("", 0.0, 1.0)
    if color_by == "material":
        return Colouring("material", 0.0, len(materials) - 1.0, tuple(materials))
    label = label_of(color_by)
    if limits:
        return Colouring(label, *limits)
    if color_by in ("velocity", "angular_velocity", "force"):
        fast = float(numpy.quantile(values, RAMP_SHARE))
        return Colouring(label, 0.0, round_up(fast) if fast > 0 else 1.0)
    if color_by == "id" or numpy.unique(values[:1000]).size < 20:
        low, high = float(values.min()), float(values.max())
    else:
        low, high = (float(f"{value:.3g}") for value in numpy.quantile(values, (1 - RAMP_SHARE, RAMP_SHARE)))
    return Colouring(label, low, high if high > low else low + 1.0)
