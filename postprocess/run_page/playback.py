# SPDX-License-Identifier: GPL-3.0-or-later
"""Chooses the frames of a run that its page plays, and packs them."""
import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

from read_run import read_frame
from run_page.packing import Grains, pack_group, pack_spheres

MOST_FRAMES = 60  # intervals between the frames that are played
GRAIN_FRAMES = 2_000_000  # grains times frames, more of which would make the page too heavy
LEAST_FRAMES = 10
GROUP = 10  # frames, of which the first is stored whole, so that one may begin there
QUANTUM = 0.004  # of positions [d]; up to eight times as much for many grains, which are small on the screen


def point_array(frame, name):
    values = frame.GetPointData().GetArray(name)
    return None if values is None else vtk_to_numpy(values)


def points_of(frame):
    return vtk_to_numpy(frame.GetPoints().GetData()) if frame.GetNumberOfPoints() else numpy.empty((0, 3))


def chosen(count, grains, most=None, live=False):
    """Which of `count` frames are played: evenly, with the first and the last. Of a run that goes on every second of
    them stays when they become too many, so that little is to be packed anew."""
    most = most or int(numpy.clip(GRAIN_FRAMES / max(1, grains), LEAST_FRAMES, MOST_FRAMES))
    stride = max(1, -(-(count - 1) // most))
    if live:
        stride = 1 << (stride - 1).bit_length()
    return sorted({*range(0, count, stride), count - 1}) if count else []


class Playback:
    """The frames of a run that are played. Made again for a run that goes on, it packs only what is new."""

    def __init__(self, live=False):
        self.live = live
        self.read = {}  # what is kept of each frame read, by its file
        self.groups = {}  # packed, by the files of their frames
        self.fixed = None  # origin [m] and quantum [m]

    def pack(self, run, most=None):
        """What the viewer needs to play it, and the blobs that this names by their keys."""
        frames = run.frames()
        last = self.read_of(frames[-1])[0] if frames else None
        numbers = chosen(len(frames), len(last.ids) if last else 0, most, self.live)
        frames = [frames[number] for number in numbers]
        grains = [self.read_of(frame)[0] for frame in frames]
        blobs, groups = {}, []
        if self.fixed is None and any(len(one.ids) for one in grains):
            self.fixed = self.find_grid(frames, grains)
        origin, quantum = self.fixed or (numpy.zeros(3), 1.0)
        for first in range(0, len(frames), GROUP):
            key = tuple(frame.path.name for frame in frames[first:first + GROUP])
            if key not in self.groups:
                self.groups[key] = pack_group(grains[first:first + GROUP], origin, quantum)
            packed, shape = self.groups[key]
            blobs[packed.key] = packed.data
            groups.append({"blob": packed.key, "first": first, **shape})
        spheres, table = self.pack_table(frames)
        blobs[spheres.key] = spheres.data
        low, high = box_around([one.positions for one in grains], float(table["high"]))
        data = {"times": [frame.time for frame in frames], "numbers": numbers, "origin": origin.tolist(),
                "quantum": quantum, "groups": groups, "spheres": {"blob": spheres.key, **table},
                "box": [low.tolist(), high.tolist()], **self.speeds(frames, grains)}
        return data, blobs

    def read_of(self, frame):
        """The grains of a frame, their radii and materials."""
        if frame.path not in self.read:
            data = read_frame(frame)
            ids, radii, materials = (point_array(data, name) for name in ("id", "radius", "material"))
            positions = points_of(data)
            ids = numpy.arange(len(positions)) if ids is None else ids.astype(numpy.int64)
            radii = numpy.zeros(len(ids)) if radii is None else radii
            materials = numpy.zeros(len(ids), dtype=numpy.uint8) if materials is None else materials.astype(numpy.uint8)
            self.read[frame.path] = (Grains(ids, positions), radii.copy(), materials)
        return self.read[frame.path]

    def pack_table(self, frames):
        """The grains of all frames that are played, each once."""
        parts = [self.read[frame.path] for frame in frames]
        if not parts:
            return pack_spheres(numpy.empty(0), numpy.empty(0), numpy.empty(0))
        ids, at = numpy.unique(numpy.concatenate([grains.ids for grains, _, _ in parts]), return_index=True)
        radii = numpy.concatenate([radii for _, radii, _ in parts])[at]
        return pack_spheres(ids, radii, numpy.concatenate([materials for _, _, materials in parts])[at])

    def find_grid(self, frames, grains):
        """Where positions are counted from, and in which steps."""
        most = max(range(len(grains)), key=lambda k: len(grains[k].ids))
        diameter = 2 * float(numpy.mean(self.read[frames[most].path][1])) or 1.0
        coarser = numpy.clip(len(grains[most].ids) / 12_500, 1.0, 8.0)
        positions = grains[most].positions
        return positions[numpy.isfinite(positions).all(axis=1)].mean(axis=0), float(QUANTUM * coarser * diameter)

    def speeds(self, frames, grains):
        """The greatest speed between two frames, and the frame to open with: not an early one, and one in which there are
        many grains, some of which move and some do not."""
        scores, fastest = [0.0] * len(frames), 0.0
        moves = []
        for k in range(len(frames) - 1):
            _, here, there = numpy.intersect1d(grains[k].ids, grains[k + 1].ids, assume_unique=True, return_indices=True)
            step = max(frames[k + 1].time - frames[k].time, 1e-30)
            way = numpy.linalg.norm(grains[k + 1].positions[there] - grains[k].positions[here], axis=1)
            speeds = way[numpy.isfinite(way)] / step
            moves.append(speeds)
            if speeds.size:
                fastest = max(fastest, float(numpy.quantile(speeds, 0.9999)))
        most = max((len(one.ids) for one in grains), default=0)
        for k, speeds in list(enumerate(moves))[len(frames) // 3:]:
            if speeds.size and fastest > 0:
                scores[k] = float(numpy.std(numpy.minimum(speeds, fastest / 2))) * len(speeds) / most
        return {"fastest": fastest, "best": int(numpy.argmax(scores)) if scores else 0}


def box_around(positions, radius):
    """Lowest and highest corner of the box around nearly all grains: of the few that fly far away it takes no notice."""
    positions = [one[numpy.isfinite(one).all(axis=1)] for one in positions]
    positions = [one for one in positions if len(one)]
    if not positions:
        return -numpy.ones(3), numpy.ones(3)
    lows = numpy.array([numpy.quantile(one, 0.002, axis=0) for one in positions])
    highs = numpy.array([numpy.quantile(one, 0.998, axis=0) for one in positions])
    return lows.min(axis=0) - radius, highs.max(axis=0) + radius
