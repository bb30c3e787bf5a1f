# SPDX-License-Identifier: GPL-3.0-or-later
"""The spheres that all codes begin with, the walls as STL, and what is measured on spheres as they lie."""
import itertools
import math

import numpy

DENSITY = 2500.0  # kg/m3
SMALLEST, LARGEST = 0.0095, 0.0105  # m, diameters
SEGMENTS = 48  # of a round wall as STL


def jittered_lattice(count, radius, base, seed):
    """Centres and radii of spheres in an upright tube: a cubic lattice, filled from below, each moved at random within
    the room that the spacing leaves, so that nothing overlaps."""
    random = numpy.random.default_rng(seed)
    spacing = 1.1 * LARGEST
    half = math.ceil(radius / spacing)
    line = spacing * numpy.arange(-half, half + 1)
    x, y = (axis.ravel() for axis in numpy.meshgrid(line, line))
    inside = numpy.hypot(x, y) < radius - 0.5 * spacing - 0.5 * (spacing - SMALLEST)
    layer = numpy.column_stack([x[inside], y[inside]])
    layers = math.ceil(count / len(layer))
    centers = numpy.array([(x, y, base + (k + 0.5) * spacing) for k in range(layers) for x, y in layer])[:count]
    radii = random.uniform(0.5 * SMALLEST, 0.5 * LARGEST, count)
    room = 0.5 * spacing - radii
    return centers + random.uniform(-1.0, 1.0, (count, 3)) * room[:, None], radii


def write_csv(path, centers, radii):
    """As Talus reads spheres."""
    rows = [",".join(f"{value:.12g}" for value in (*center, radius)) for center, radius in zip(centers, radii)]
    path.write_text("\n".join(["x,y,z,radius", *rows]) + "\n", encoding="utf-8")


def write_data(path, centers, radii, half_width, top):
    """As LAMMPS and LIGGGHTS read them. Spheres that leave this box are gone, below it those that came through. It is
    no larger than it must be: they clear all its cells whenever they list neighbours anew, which in a room of 1 m³ took
    as long as all the rest."""
    box = ((-half_width, half_width), (-half_width, half_width), (-0.2, top + 0.02))
    lines = ["Spheres of the comparison", "", f"{len(radii)} atoms", "1 atom types", ""]
    lines += [f"{low} {high} {axis}lo {axis}hi" for axis, (low, high) in zip("xyz", box)]
    lines += ["", "Atoms", ""]
    for k, (center, radius) in enumerate(zip(centers, radii), start=1):
        lines.append(f"{k} 1 {2 * radius:.12g} {DENSITY} " + " ".join(f"{value:.12g}" for value in center))
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def write_stl(path, profiles):
    """Walls of revolution as ASCII STL: each profile is a list of (radius, height), turned round the z axis."""
    angles = [2.0 * math.pi * k / SEGMENTS for k in range(SEGMENTS + 1)]
    lines = ["solid walls"]

    def corner(ring, angle):
        return f"{ring[0] * math.cos(angle):.9f} {ring[0] * math.sin(angle):.9f} {ring[1]:.9f}"

    for profile in profiles:
        for (low, high), (one, next_one) in itertools.product(itertools.pairwise(profile), itertools.pairwise(angles)):
            triangles = [(corner(low, one), corner(high, next_one), corner(low, next_one)),
                         (corner(low, one), corner(high, one), corner(high, next_one))]
            for triangle in triangles:
                if len(set(triangle)) < 3:  # at the axis
                    continue
                lines += ["facet normal 0 0 0", " outer loop", *(f"  vertex {place}" for place in triangle),
                          " endloop", "endfacet"]
    path.write_text("\n".join([*lines, "endsolid walls"]) + "\n", encoding="utf-8")


def overlaps(centers, radii):
    """Of all pairs that overlap [m]."""
    size = 2.0 * radii.max()
    cell = numpy.floor((centers - centers.min(axis=0)) / size).astype(int)
    extent = cell.max(axis=0) + 3
    key = (cell[:, 0] * extent[1] + cell[:, 1]) * extent[2] + cell[:, 2]
    order = numpy.argsort(key, kind="stable")
    sorted_key = key[order]
    found = []
    for step in itertools.product((-1, 0, 1), repeat=3):
        other = key + (step[0] * extent[1] + step[1]) * extent[2] + step[2]
        begin, end = (numpy.searchsorted(sorted_key, other, side) for side in ("left", "right"))
        for k in range((end - begin).max(initial=0)):
            a = numpy.flatnonzero(begin + k < end)
            b = order[begin[a] + k]
            a, b = a[a < b], b[a < b]
            depth = radii[a] + radii[b] - numpy.linalg.norm(centers[a] - centers[b], axis=1)
            found.append(depth[depth > 0.0])
    return numpy.concatenate(found)


def angle_of_repose(centers, radii, inner=0.04, outer=0.14, rings=10, sectors=24):
    """Angle [deg] of the line through the mean heights of rings, each the mean over sectors of the highest top."""
    radius = numpy.hypot(centers[:, 0], centers[:, 1])
    ring = numpy.floor((radius - inner) / (outer - inner) * rings).astype(int)
    sector = numpy.floor((numpy.arctan2(centers[:, 1], centers[:, 0]) / (2 * math.pi) + 0.5) * sectors).astype(int)
    low = centers[:, 2] < 0.14  # not what is still in the funnel
    top = centers[:, 2] + radii
    middle, height = [], []
    for k in range(rings):
        here = low & (ring == k)
        tops = [top[here & (sector == s)].max() for s in range(sectors) if numpy.any(here & (sector == s))]
        if tops:
            middle.append(inner + (k + 0.5) / rings * (outer - inner))
            height.append(numpy.mean(tops))
    return math.degrees(math.atan(-numpy.polyfit(middle, height, 1)[0]))
