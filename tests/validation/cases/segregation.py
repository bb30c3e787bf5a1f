# SPDX-License-Identifier: GPL-3.0-or-later
"""14. Segregation: a large sphere rises in a bed that is shaken up and down, and how fast.

Law: large spheres come to the top (Rosato, Strandburg, Prinz & Swendsen 1987, Phys. Rev. Lett. 58, 1038). In a box
with rough walls the beads rise in the middle and go down at the walls (jfi.uchicago.edu/granular/convection.html), and
a large sphere rises with those around it, as fast as these whatever its size, but does not go down again (Knight,
Jaeger & Nagel 1993, Phys. Rev. Lett. 70, 3728; both quoted from memory).

Parameters: 1150 beads of 5 mm ± 5 %, friction 0.5 between them and at the walls, restitution 0.5, ten deep in a box
ten wide; a sphere of the same stuff, 3 or 2 beads in diameter, begins at the bottom. Shaken 15 times a second with 3.5
times the acceleration of gravity for 8 s, 120 periods, with the smaller sphere for 12 s. The same in LIGGGHTS, with the
deck of `talus export`, with one seed, for its time; and with stiffer beads, of 2e7 Pa.

Tolerances, fixed before the runs:
- at the end 0.8 to 1 of the beads are below the centre of the large sphere.
- its speed over that of the beads near the axis, both between a fifth and three fifths of the bed's height: 0.5 to 1.5,
  from memory, and since the beads around it, which it carries along, are counted with them.
- time to rise until 0.8 of the beads are below it, over that of a sphere of 2 diameters: 0.5 to 2, from memory.
- the same over that in LIGGGHTS: 0.6 to 1.6; single rises are a matter of chance.
"""
import math

import numpy

from case import SEEDS, Row, over_seeds, told
from deck import spheres_of

TITLE = "segregation"
FINDINGS = """The smaller sphere rises, too, but more slowly, and seeds differ: in 8 s of shaking, as long as the runs
had at first, only one of three came up. The rise in LIGGGHTS takes two thirds of the time, in an earlier run half of
it, probably because its beads are soft there, 5e6 Pa as `talus export` has it: with stiffer ones the beads at the axis
rise more slowly, as the last rows have it, and slowest in Talus, whose contacts are rigid. LIGGGHTS with still stiffer
beads was not run. Speed and time of the rise are within wide tolerances, and yet seven and four standard errors from
Knight's 1."""
SHAKEN = 0.3  # s, from when on
AXIS = 0.0125  # m, within which beads are near it
RISEN = 0.8  # share of the beads that are below


def nut(diameter, seeds=SEEDS, program="", modulus="", **settings):
    return over_seeds("_".join(filter(None, (f"brazil_nut_{diameter}", program, modulus))), "brazil_nut", {
        "fill.0.diameter": diameter, "fill.0.position": [0, 0, diameter / 2 + 1e-4],
        "fill.1.except.0.center": [0, 0, diameter / 2 + 1e-4], "fill.1.except.0.radius": diameter / 2 + 2e-4,
        **settings}, seeds, program, modulus)


LARGE, SMALL = nut(0.015), nut(0.010, **{"time.duration": 12.3})
PEER = nut(0.015, seeds=(1,), program="liggghts")
STIFFER = nut(0.015, seeds=(1,), program="liggghts", modulus="2e7")
RUNS = [*LARGE, *SMALL, *PEER, *STIFFER]


def rise(run):
    """Times [s], positions [m] of all spheres in each frame, the large one first, and the share of the beads below it."""
    frames = spheres_of(run)
    positions = numpy.array([spheres.positions for spheres in frames])
    heights = positions[:, :, 2]
    return (numpy.array([spheres.time for spheres in frames]), positions,
            numpy.mean(heights[:, 1:] < heights[:, :1], axis=1))


def rise_time(time, share):
    """Until it has risen, from when the box is shaken; infinite where it has not."""
    risen = numpy.flatnonzero((share >= RISEN) & (time > SHAKEN))
    return float(time[risen[0]] - SHAKEN) if len(risen) else math.inf


def speeds(time, positions):
    """Of the large sphere and of the beads near the axis [m/s], between a fifth and three fifths of the height."""
    heights = positions[:, :, 2]
    top = numpy.quantile(heights[0 if time[0] > SHAKEN else numpy.searchsorted(time, SHAKEN) - 1], 0.98)
    ball = heights[:, 0]
    end = int(numpy.argmax(ball > 0.6 * top))
    begin = end - int(numpy.argmax(ball[:end][::-1] < 0.2 * top))
    moved = []
    for k in range(begin, end):
        near = numpy.hypot(*positions[k, 1:, :2].T) < AXIS
        there = near & (heights[k, 1:] > 0.2 * top) & (heights[k, 1:] < 0.6 * top)
        moved.append(numpy.mean(heights[k + 1, 1:][there] - heights[k, 1:][there]) / (time[k + 1] - time[k]))
    return float((ball[end] - ball[begin]) / (time[end] - time[begin])), float(numpy.mean(moved))


def rise_at_axis(time, positions):
    """How fast beads near the axis rise in the first two seconds of shaking [m/s]."""
    begin, end = (int(numpy.argmin(abs(time - SHAKEN - second))) for second in (0, 2))
    moved = []
    for before, after in zip(positions[begin:end], positions[begin + 1:end + 1]):
        near = numpy.hypot(*before[1:, :2].T) < AXIS
        moved.append(numpy.mean(after[1:, 2][near] - before[1:, 2][near]))
    return numpy.sum(moved) / (time[end] - time[begin])


def judge(runs):
    large, small, peer, stiffer = ([rise(runs[run.name]) for run in nuts] for nuts in (LARGE, SMALL, PEER, STIFFER))
    yield Row("share of the beads below the large sphere in the end", "on top (Rosato et al. 1987)", "0.8 to 1", 0.8, 1.0,
              tuple(float(numpy.mean(share[time > time[-1] - 1])) for time, _, share in large))
    yield Row("speed of its rise / that of the beads around", "1 (Knight et al. 1993, from memory)", "0.5 to 1.5", 0.5,
              1.5, tuple(ball / beads for ball, beads in (speeds(time, positions) for time, positions, _ in large)))
    times, small_times, their_times = ([rise_time(time, share) for time, _, share in rises]
                                       for rises in (large, small, peer))
    yield Row("time of its rise / that of a smaller one", "1 (Knight et al. 1993, from memory)", "0.5 to 2", 0.5, 2.0,
              tuple(time / small for time, small in zip(times, small_times)))
    yield Row("time of its rise / that in LIGGGHTS (one run)", "1", "0.6 to 1.6", 0.6, 1.6,
              tuple(time / their_times[0] for time in times))
    for name, rises in (("Talus", large), ("LIGGGHTS, 5e6 Pa (one run)", peer), ("LIGGGHTS, 2e7 Pa (one run)", stiffer)):
        yield told(f"{name}: rise of the beads at the axis in the first two seconds [mm/s]",
                   (1000 * rise_at_axis(time, positions) for time, positions, _ in rises))


def draw(figure, runs):
    axes = figure.subplots()
    for nuts, colour, label in ((LARGE, "C3", "3 beads wide"), (SMALL, "C0", "2 beads wide"),
                                (PEER, "k", "3 beads wide, LIGGGHTS")):
        for n, run in enumerate(nuts):
            time, _, share = rise(runs[run.name])
            axes.plot(time - SHAKEN, share, colour, linewidth=1, label=label if n == 0 else None)
    axes.axhline(RISEN, color="0.7", linewidth=1, zorder=0)
    axes.set(xlabel="time of shaking [s]", ylabel="share of the beads below the large sphere", xlim=(0, None), ylim=(0, 1))
    axes.legend()
