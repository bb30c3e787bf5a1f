# SPDX-License-Identifier: GPL-3.0-or-later
"""What several cases measure of the spheres of a frame."""
import math

import numpy


def volumes(radii):
    """[m³], of each sphere; radii [m] of any precision."""
    return 4 / 3 * math.pi * numpy.asarray(radii, float) ** 3


def mean_of_highest(tops, *places):
    """The mean, over the cells of a floor, of the highest top in each [m].

    places: one array or more, which together name the cell that each sphere is in.
    """
    _, cell = numpy.unique(numpy.column_stack(places), axis=0, return_inverse=True)
    highest = numpy.full(cell.max() + 1, -numpy.inf)
    numpy.maximum.at(highest, cell, tops)
    return float(highest.mean())


def line_of_tops(along, across, tops, edges):
    """Angle [deg] of the line through the means over strips of the highest tops in bins along it."""
    middles, heights = [], []
    for low, high in zip(edges, edges[1:]):
        here = (along >= low) & (along < high)
        if here.any():
            middles.append(0.5 * (low + high))
            heights.append(mean_of_highest(tops[here], across[here]))
    return math.degrees(math.atan(numpy.polyfit(middles, heights, 1)[0]))
