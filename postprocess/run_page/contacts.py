# SPDX-License-Identifier: GPL-3.0-or-later
"""The contacts of a run: force chains, how forces are distributed, how many contacts grains have."""
from functools import lru_cache

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

from read_run import read_frame
from run_page.packing import blob, planes, width_of, zigzag

MOST_FRAMES, CHAINS = 25, 2500  # of contacts, and how many of the strongest contacts of each
BIN, LAST_BIN = 0.25, 8.0  # of the distribution of forces [mean force]


def pack_contacts(run, times):
    """A list of frames of contacts, each beside one of these times, and their blobs."""
    output = run.scene().get("output", {})
    complete = output.get("contact_threshold", 0.0) == 0.0 and output.get("region", {}).get("shape", "everything") == "everything"
    beside = frames_beside(run.frames("contacts"), times)
    picks = sorted(beside)
    if len(picks) > MOST_FRAMES:
        picks = [picks[i] for i in numpy.unique(numpy.linspace(0, len(picks) - 1, MOST_FRAMES).round().astype(int))]
    listed, blobs = [], {}
    for k in picks:
        packed = pack_frame(beside[k], complete)
        if packed:
            blobs[packed[0].key] = packed[0].data
            listed.append({"frame": k, "time": beside[k].time, "blob": packed[0].key, **packed[1]})
    return listed, blobs


def frames_beside(frames, times):
    """For each of the times, by its number, the frame nearest to it, if none of the times lies between."""
    beside = {}
    for frame in frames if times else []:
        k = int(numpy.argmin([abs(time - frame.time) for time in times]))
        slack = max(times[min(k + 1, len(times) - 1)] - times[max(k - 1, 0)], 1e-9) / 2
        distance = abs(times[k] - frame.time)
        if distance <= slack and (k not in beside or abs(beside[k].time - times[k]) > distance):
            beside[k] = frame
    return beside


@lru_cache(maxsize=None)
def pack_frame(frame, complete):
    """The strongest contacts as a blob, and what the viewer needs to know of all; nothing where there are none.

    The blob holds, contact by contact, the first grain (what its id is above the one before), the second (above the
    first; below 0 at a wall), at walls the way from the grain's centre to the wall, and the force on a scale of 255
    steps up to the greatest; then, if the frame is complete, the number of contacts of each grain by its id.
    """
    data = read_frame(frame)
    arrays = [data.GetCellData().GetArray(name) for name in ("normal_force", "id_a", "id_b")]
    if any(array is None for array in arrays) or not data.GetNumberOfCells():
        return None
    force, a, b = (vtk_to_numpy(array) for array in arrays)
    force, a, b = numpy.nan_to_num(force), a.astype(numpy.int64), b.astype(numpy.int64)
    pressing = force[force > 0.0]  # attraction may hold others that are pulled apart
    if not len(pressing):
        return None
    mean, top = float(pressing.mean()), float(pressing.max())
    strong = numpy.argsort(-force)[:CHAINS]
    strong = strong[force[strong] >= mean]
    strong = strong[numpy.lexsort((b[strong], a[strong]))]
    lines = vtk_to_numpy(data.GetLines().GetConnectivityArray()).reshape(-1, 2)[strong]
    ends = vtk_to_numpy(data.GetPoints().GetData())[lines]
    arms = numpy.where((b[strong] < 0)[:, None], ends[:, 1] - ends[:, 0], 0.0)
    longest = float(numpy.abs(arms).max(initial=0.0)) or 1.0
    columns = [zigzag(numpy.diff(a[strong], prepend=0)), zigzag(b[strong] - a[strong])]
    widths = [width_of(column) for column in columns]
    raw = b"".join(planes(column, width) for column, width in zip(columns, widths))
    raw += numpy.rint(arms.T / longest * 127).astype(numpy.int8).tobytes()
    raw += numpy.rint(force[strong] / top * 255).astype(numpy.uint8).tobytes()
    touching = numpy.bincount(numpy.concatenate([a, b[b >= 0]])) if complete else numpy.empty(0, dtype=int)
    raw += numpy.minimum(touching, 255).astype(numpy.uint8).tobytes()
    shares, _ = numpy.histogram(pressing / mean, bins=numpy.arange(0.0, LAST_BIN + BIN / 2, BIN))
    return blob(raw), {"count": len(strong), "all": len(force), "widths": widths, "arm": longest, "mean": mean, "top": top,
                       "complete": complete, "bin": BIN, "density": (shares / len(pressing) / BIN).round(6).tolist(),
                       "touching": len(touching)}
