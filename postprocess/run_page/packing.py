# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers as few bytes: what the viewer (viewer/unpack.js) undoes.

Whole numbers are stored as zigzag (0, -1, 1, -2, … become 0, 1, 2, 3, …), their low bytes before their high bytes, and
deflated. Positions are whole multiples of a quantum, and of each frame only its difference to the frame before.
"""
import hashlib
import zlib
from typing import NamedTuple

import numpy


class Blob(NamedTuple):
    """Deflated bytes, and a name that changes with them."""

    key: str
    data: bytes


def blob(raw):
    data = zlib.compress(raw, 9)
    return Blob(hashlib.sha256(data).hexdigest()[:16], data)


def zigzag(numbers):
    """Whole numbers of either sign as unsigned ones, small where they are near 0."""
    numbers = numpy.asarray(numbers, dtype=numpy.int64)
    return ((numbers << 1) ^ (numbers >> 63)).astype(numpy.uint64)


def planes(unsigned, width):
    """The lowest bytes of all numbers, then the next, up to `width` of them."""
    return b"".join(((unsigned >> numpy.uint64(8 * byte)) & numpy.uint64(0xFF)).astype(numpy.uint8).tobytes()
                    for byte in range(width))


def width_of(unsigned):
    """Bytes that the largest number needs, at least one."""
    largest = int(unsigned.max(initial=0))
    return max(1, (largest.bit_length() + 7) // 8)


def pack_increasing(ids):
    """Increasing whole numbers, by their differences: four planes."""
    return planes(zigzag(numpy.diff(numpy.asarray(ids, dtype=numpy.int64), prepend=0)), 4)


def pack_floats(values):
    return numpy.ascontiguousarray(values, dtype="<f4").tobytes()


class Grains(NamedTuple):
    """The grains of a frame, in the order of their ids."""

    ids: numpy.ndarray
    positions: numpy.ndarray  # m, one a row


def pack_group(frames, origin, quantum):
    """Some frames in a row, of which the first is stored whole.

    Returns a blob, and what the viewer needs to know to read it: `count` of frames, `slots` (grains that are in any of
    them), `width` (bytes of a number). The blob holds the ids of the slots; for each frame a bit for each slot, whether
    the grain is there, changed against the frame before; for each frame and axis the differences.
    """
    ids = numpy.unique(numpy.concatenate([frame.ids for frame in frames]))
    there = numpy.zeros((len(frames), len(ids)), dtype=bool)
    steps = numpy.zeros((len(frames), 3, len(ids)), dtype=numpy.int64)
    held = numpy.zeros((3, len(ids)), dtype=numpy.int64)  # a grain that is not there stays where it was
    for k, frame in enumerate(frames):
        good = numpy.isfinite(frame.positions).all(axis=1)
        slots = numpy.searchsorted(ids, frame.ids[good])
        there[k, slots] = True
        now = held.copy()
        now[:, slots] = numpy.clip(numpy.rint((frame.positions[good] - origin) / quantum), -2**29, 2**29).T
        steps[k] = now - held
        held = now
    unsigned = zigzag(steps)
    width = width_of(unsigned)
    changed = there ^ numpy.concatenate([numpy.zeros((1, len(ids)), dtype=bool), there[:-1]])
    raw = [pack_increasing(ids), *(numpy.packbits(row, bitorder="little").tobytes() for row in changed)]
    raw += [planes(unsigned[k, axis], width) for k in range(len(frames)) for axis in range(3)]
    return blob(b"".join(raw)), {"count": len(frames), "slots": len(ids), "width": width}


def pack_spheres(ids, radii, materials):
    """What a grain keeps for life: id, radius to a 65 000th of their spread, material."""
    low, high = (float(radii.min()), float(radii.max())) if len(radii) else (0.0, 0.0)
    levels = numpy.rint((radii - low) / (high - low) * 65535).astype(numpy.uint64) if high > low else zigzag(numpy.zeros(len(ids)))
    raw = pack_increasing(ids) + planes(levels, 2) + numpy.asarray(materials, dtype=numpy.uint8).tobytes()
    return blob(raw), {"count": len(ids), "low": low, "high": high}
