# SPDX-License-Identifier: GPL-3.0-or-later
"""The walls of a run: the triangles of each, when it stands, and where it is in each frame that is played."""
from functools import lru_cache

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

from read_run import read_frame
from run_page.packing import blob, pack_floats


@lru_cache(maxsize=None)
def walls_in(frame):
    """The corners of the triangles of each wall, three rows a triangle, by its index."""
    data = read_frame(frame)
    if not data.GetNumberOfCells():
        return {}
    corners = vtk_to_numpy(data.GetPoints().GetData()).astype(float)[
        vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
    wall = vtk_to_numpy(data.GetCellData().GetArray("wall"))
    return {int(index): corners[wall == index].reshape(-1, 3) for index in numpy.unique(wall)}


def pose_between(first, now):
    """The motion that brings one set of points to the other: a rotation, row by row, and a shift."""
    middle_first, middle_now = first.mean(axis=0), now.mean(axis=0)
    u, _, vt = numpy.linalg.svd((first - middle_first).T @ (now - middle_now))
    mirror = numpy.diag([1.0, 1.0, numpy.sign(numpy.linalg.det(u @ vt)) or 1.0])
    rotation = vt.T @ mirror @ u.T
    return rotation, middle_now - rotation @ middle_first


def pack_walls(run, times):
    """A list of walls with their blobs: corners as they first were, and for those that move a pose for each time."""
    names = [wall.get("name", "") for wall in run.scene().get("wall", [])]
    corners, spans, poses = {}, {}, {}
    still = run.frames("walls")
    for k, frame in enumerate(still):
        until = still[k + 1].time if k + 1 < len(still) else None
        for index, points in walls_in(frame).items():
            corners.setdefault(index, points)
            spans.setdefault(index, []).append([frame.time, until])
    moving = run.frames("moving_walls")
    for k, time in enumerate(times):
        frames = [frame for frame in moving if frame.time <= time + 1e-9]
        for index, points in (walls_in(frames[-1]) if frames else {}).items():
            first = corners.setdefault(index, points)
            if len(first) == len(points):
                poses.setdefault(index, {})[k] = pose_between(first, points)
    walls, blobs = [], {}
    for index, points in sorted(corners.items()):
        shape = blob(pack_floats(points))
        blobs[shape.key] = shape.data
        wall = {"name": names[index] if index < len(names) else str(index), "blob": shape.key, "corners": len(points),
                "box": [points.min(axis=0).tolist(), points.max(axis=0).tolist()], "spans": joined(spans.get(index, []))}
        if index in poses:
            rows = numpy.full((len(times), 12), numpy.nan)  # not a number: it is not there
            for k, (rotation, shift) in poses[index].items():
                rows[k] = numpy.concatenate([rotation.ravel(), shift])
            packed = blob(pack_floats(rows))
            blobs[packed.key] = packed.data
            wall["poses"] = packed.key
        walls.append(wall)
    return walls, blobs


def joined(spans):
    """Spans of time that follow each other without a gap become one."""
    whole = []
    for begin, end in spans:
        if whole and whole[-1][1] == begin:
            whole[-1][1] = end
        else:
            whole.append([begin, end])
    return whole
