# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes that are surfaces with a name, for programs that have no triangles. A mesh is corners, (n, 3) [m], and triangles,
(m, 3) indices of them."""
import math

import numpy
from numpy.linalg import norm

SAME_PLACE = 1e-4  # of the mesh's size
MOST_SAG = 0.05  # of the radius
ALL_ROUND = 0.9  # of the area of a surface once round: what chords leave of it, and no slit does


def same_place(corners):
    return SAME_PLACE * norm(numpy.ptp(corners, axis=0))


def round_parts(corners, triangles):
    """The mesh as cones and disks, in tables as a scene has them, and how far its triangles come up short of them at most
    [m]: its corners lie on rings round x, y or z, and its triangles join these all the way round, with no chord more than a
    twentieth of the radius within the circle. No parts where it is not round."""
    for axis in (2, 1, 0):
        if found := round_parts_about(axis, corners, triangles):
            return found
    return [], 0.0


def round_parts_about(axis, corners, triangles):
    """The same for one axis; None where it is not round."""
    near, center = same_place(corners), (corners / len(corners)).sum(axis=0)
    off = corners - center
    off[:, axis] = 0.0
    rings, ring_of = find_rings(numpy.column_stack([corners[:, axis], norm(off, axis=1)]), near)
    sag = chord_sag(corners[triangles], ring_of[triangles], rings)
    if sag is None:
        return None
    p, q, r = numpy.moveaxis(corners[triangles], 1, 0)
    joined, joint = numpy.unique(numpy.sort(ring_of[triangles])[:, [0, 2]], axis=0, return_inverse=True)
    areas = numpy.bincount(joint.ravel(), weights=0.5 * norm(numpy.cross(q - p, r - p), axis=1))
    if not all(area > ALL_ROUND * round_area(*rings[pair], pair[0] == pair[1]) for pair, area in zip(joined, areas)):
        return None
    return [round_part(axis, center, *sorted(rings[pair].tolist()), pair[0] == pair[1], near) for pair in joined], sag


def find_rings(places, near):
    """Rings of corners, each by its place along the axis and its radius, and the ring of each corner."""
    rings, count, ring_of = numpy.empty_like(places), 0, numpy.empty(len(places), dtype=int)
    for k, own in enumerate(places):
        found = numpy.hypot(*(rings[:count] - own).T) < near
        ring_of[k] = found.argmax() if found.any() else count
        if ring_of[k] == count:
            rings[count] = own
            count += 1
    return rings[:count], ring_of


def chord_sag(corners, ring_of, rings):
    """How far chords between two corners on a ring are within the circle at most [m]; None where that is too far, or a
    triangle joins three rings. A disk may be made of chords across it, so only joints of two rings must be near the
    circle."""
    on_a_ring = ring_of == numpy.roll(ring_of, -1, axis=1)  # the edge that begins at a corner
    if not on_a_ring.any(axis=1).all():
        return None
    chosen = on_a_ring & ~on_a_ring.all(axis=1, keepdims=True)
    radius, chord = rings[ring_of[chosen], 1], norm((numpy.roll(corners, -1, axis=1) - corners)[chosen], axis=1)
    sag = radius - numpy.sqrt(numpy.maximum(0.0, radius**2 - 0.25 * chord**2))
    return None if (sag > MOST_SAG * radius).any() else sag.max(initial=0.0)


def round_area(one, other, is_disk):
    """Area of a surface round the axis between two rings; of a disk where they are one."""
    if is_disk:
        return math.pi * one[1] ** 2
    return math.pi * (one[1] + other[1]) * math.hypot(*(one - other))


def round_part(axis, center, low, high, is_disk, flat):
    """The surface round the axis between two rings, or the disk within one."""
    base, direction = center.copy(), numpy.eye(3)[axis]
    base[axis] = low[0]
    if high[0] - low[0] > flat:
        return {"shape": "cone", "base": base, "axis": direction, "base_radius": low[1], "top_radius": high[1],
                "height": high[0] - low[0]}
    return {"shape": "disk", "center": base, "normal": direction, "radius": max(low[1], high[1]),
            "hole_radius": 0.0 if is_disk else min(low[1], high[1])}


def plates(corners, triangles):
    """The mesh as plates, two triangles each, whose angles need not be right: corner and two edges of each [m]. None where
    it is not made of such."""
    near, places, taken, found = same_place(corners), corners[triangles], numpy.zeros(len(triangles), dtype=bool), []
    for n, place in enumerate(places):
        for p, q, r in () if taken[n] else (place, numpy.roll(place, -1, axis=0), numpy.roll(place, -2, axis=0)):
            partners = numpy.flatnonzero(makes_plate(places[n + 1:], p, q, r, near) & ~taken[n + 1:])
            if len(partners):
                taken[[n, n + 1 + partners[0]]] = True
                found.append((r, p - r, q - r))
                break
        if not taken[n]:
            return []
    return found


def makes_plate(places, p, q, r, near):
    """Which triangles make a plate with p, q and r: they have p and q, and p + q − r."""
    def is_near(place):
        return norm(places - place, axis=2) < near

    ends = is_near(p) | is_near(q)
    return (is_near(p + q - r) & numpy.roll(ends, 1, axis=1) & numpy.roll(ends, 2, axis=1)).any(axis=1)
