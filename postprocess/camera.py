# SPDX-License-Identifier: GPL-3.0-or-later
"""From where a run is looked at: chosen by its scene, or as the user says."""
import re
from typing import NamedTuple

import numpy

VIEWS = ("auto", "front", "side", "iso", "top")
# Degrees: round the upward direction from the front, and above the horizon.
ANGLES = {"front": (0.0, 11.0), "side": (90.0, 11.0), "iso": (31.0, 31.0), "top": (0.0, 90.0)}
THIN = 0.6  # a room not wider than this share of its width is looked at across
FLAT = 0.3  # one not higher than this share of it, from higher above


class View(NamedTuple):
    """Unit vectors to the right, upwards in the picture, and towards the eye."""

    right: numpy.ndarray
    above: numpy.ndarray
    towards_eye: numpy.ndarray


def upwards(scene):
    """Against gravity; z without."""
    gravity = numpy.array(scene["world"]["gravity"], dtype=float)
    size = numpy.linalg.norm(gravity)
    return -gravity / size if size > 0 else numpy.array([0.0, 0.0, 1.0])


def view_from(up, front, azimuth, elevation):
    """The view after a turn from the front, in degrees.

    front: a direction towards the eye, from which what is along `up` is taken away.
    """
    front = front - (front @ up) * up
    front /= numpy.linalg.norm(front)
    right = numpy.cross(up, front)
    around, high = numpy.radians([azimuth, elevation])
    outwards = numpy.cos(around) * front + numpy.sin(around) * right
    towards_eye = numpy.cos(high) * outwards + numpy.sin(high) * up
    across = numpy.cross(up, outwards)
    return View(across, numpy.cross(towards_eye, across), towards_eye)


def scene_view(up, points):
    """Across the thin side of what is to be seen, from the front else, and from higher above where it is flat."""
    across = [axis for axis in numpy.eye(3) if abs(axis @ up) < 0.8]
    width, depth = (numpy.ptp(points @ axis) for axis in across[:2])
    front = -across[0] if width < THIN * depth else -across[1]
    if width < THIN * depth:
        front = across[0]  # from +x, so that y goes to the right
    height = numpy.ptp(points @ up)
    return view_from(up, front, 0.0, 25.0 if height < FLAT * max(width, depth) else ANGLES["front"][1])


def chosen_view(text, scene, points):
    """text: one of VIEWS, or two angles in degrees, as `view_angles` takes them."""
    up = upwards(scene)
    if text == "auto":
        return scene_view(up, points)
    front = numpy.array([0.0, -1.0, 0.0]) if abs(up[1]) < 0.9 else numpy.array([0.0, 0.0, 1.0])
    return view_from(up, front, *(ANGLES.get(text) or view_angles(text)))


def view_angles(text):
    """Two angles in degrees out of "30,20"; nothing where it is no such text."""
    found = re.fullmatch(r"(-?\d+(?:\.\d*)?),(-?\d+(?:\.\d*)?)", text)
    return tuple(map(float, found.groups())) if found else None


class Clip(NamedTuple):
    """A plane; what lies between it and the eye is not drawn."""

    point: numpy.ndarray  # m
    inwards: numpy.ndarray  # unit, away from the eye

    def keeps(self, points):
        """Which of the points, one a row, are drawn."""
        return (points - self.point) @ self.inwards >= 0


def clip_plane(axis, place, view, points):
    """A plane across an axis, 0 to 2, at a place [m], or in the middle of what is to be seen where that is None; None
    where one looks along it."""
    inwards = numpy.zeros(3)
    inwards[axis] = -numpy.sign(view.towards_eye[axis])
    if abs(view.towards_eye[axis]) < 0.02:
        return None
    point = (points.min(axis=0) + points.max(axis=0)) / 2
    if place is not None:
        point[axis] = place
    return Clip(point, inwards)
