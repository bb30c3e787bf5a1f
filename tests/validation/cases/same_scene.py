# SPDX-License-Identifier: GPL-3.0-or-later
"""16. The same hopper, pile and drum in LAMMPS and LIGGGHTS.

Law: none; two codes of soft spheres (Hertz and Mindlin contacts, damping from the restitution), which many have
compared with experiments, begin with the same beads and walls: decks that `talus export` writes of the scenes.

Parameters: Debian's LAMMPS (29 Sep 2021) and LIGGGHTS 3.8, a step of a fifth of Rayleigh's time, E as `talus export`
chooses it: 500 times the pressure of the bed, or 5e6 Pa. Beads of 10 mm ± 5 %, friction and restitution 0.5.
- hopper: the supplied scene with 4000 beads, open after 0.8 s; beads a second from 1.0 to 1.8 s.
- pile: scenes/funnel_pile.toml, 3000 beads, at 4 s; the line through ring means of the highest tops.
- drum: the supplied scene with 1300 beads of 10 mm in a drum 24 of them wide and five deep, at a Froude number of 0.01;
  the line through the highest tops in the middle half of the surface, mean over 1.5 to 3 s.

Tolerances, fixed before the runs: flow ± 5 %, for the two differ by 2 % in a silo of 10 000 (tests/results/
benchmarks.md) and softer beads let a little more through; angles ± 2°, as the scatter of single piles of this size.
"""
import math

import numpy

from case import Row, mean_and_error, over_seeds
from deck import spheres_of
from measures import line_of_tops
from page import with_error

TITLE = "the same hopper, pile and drum in LIGGGHTS and LAMMPS"
FINDINGS = """Contacts are rigid in Talus and soft in the decks, 5e6 to 5.8e6 Pa; all differences are within their
tolerances. The largest are those of the pile, 0.9° steeper than in LAMMPS, which is one standard error, and of the
drum, 0.9 and 1.1° steeper than in LAMMPS and LIGGGHTS, which are two and a half to three: small, but hardly chance
alone."""
CODES = {"": "Talus", "lammps": "LAMMPS", "liggghts": "LIGGGHTS"}
FLOWING = (1.0, 1.8)  # s
TURNING = (1.5, 3.0)  # s
DRUM = 0.12  # radius, m
SCENES = {
    "hopper": ("hopper", {"fill.0.count": 4000, "time.duration": FLOWING[1]}),
    # A room no larger than it must be: LAMMPS and LIGGGHTS clear all its cells whenever they list neighbours anew.
    "pile": ("funnel_pile", {
        "time.duration": 4.0, "world.min": "[-0.25, -0.25, -0.2]", "world.max": "[0.25, 0.25, 0.6]",
        "world.on_escape": "remove", "outlet.0.region.min": "[-0.25, -0.25, -0.2]",
        "outlet.0.region.max": "[0.25, 0.25, -0.1]"}),
    "drum": ("drum", {
        "fill.0.count": 1300, "fill.0.arrangement": "dense", "fill.0.diameter.min": 0.0095,
        "fill.0.diameter.max": 0.0105, "fill.0.region.radius": DRUM, "fill.0.region.height": 0.05,
        "wall.drum.radius": DRUM, "wall.drum.height": 0.05,
        "world.max": "[inf, 0.05, inf]", "wall.drum.motion.0.rate": 0.904, "time.duration": TURNING[1],
        "time.frame_interval": 0.05}),
}


def simulations(what, code):
    scene, settings = SCENES[what]
    return over_seeds(f"same_{what}{code and '_' + code}", scene, settings, program=code)


RUNS = [run for what in SCENES for code in CODES for run in simulations(what, code)]


def frames(run, times=(0.0, math.inf)):
    """The spheres of each frame between two times [s]."""
    return [spheres for spheres in spheres_of(run) if times[0] - 1e-3 <= spheres.time <= times[1] + 1e-3]


def flow(run):
    """Spheres a second out of the hopper: the slope of their number above its hole."""
    window = frames(run, FLOWING)
    above = [numpy.count_nonzero(spheres.positions[:, 2] > 0) for spheres in window]
    return -float(numpy.polyfit([spheres.time for spheres in window], above, 1)[0])


def angle_of_pile(run):
    spheres = frames(run)[-1]
    x, y, z = spheres.positions.T
    heap = z < 0.14  # not what is still in the funnel
    sectors = numpy.floor((numpy.arctan2(y, x) / (2 * math.pi) + 0.5) * 24)
    return -line_of_tops(numpy.hypot(x, y)[heap], sectors[heap], (z + spheres.radii)[heap], numpy.linspace(0.04, 0.14, 11))


def angle_of_drum(run):
    """Mean over the frames; the drum turns right-handed about y, so that the surface falls along x or against it."""
    return abs(numpy.mean([
        line_of_tops(spheres.positions[:, 0], numpy.floor(numpy.mod(spheres.positions[:, 1], 0.05) / 0.01),
                     spheres.positions[:, 2] + spheres.radii, numpy.linspace(-0.5 * DRUM, 0.5 * DRUM, 13))
        for spheres in frames(run, TURNING)]))


MEASURES = {"hopper": ("spheres a second", flow), "pile": ("angle of repose [deg]", angle_of_pile),
            "drum": ("angle of the surface [deg]", angle_of_drum)}


def found(runs, what, code):
    return [MEASURES[what][1](runs[run.name]) for run in simulations(what, code)]


def judge(runs):
    for what, (quantity, _) in MEASURES.items():
        values = tuple(found(runs, what, ""))
        for code in ("lammps", "liggghts"):
            mean, error = mean_and_error(found(runs, what, code))
            margin = 0.05 * mean if what == "hopper" else 2.0
            yield Row(f"{what}: {quantity}", f"{with_error(mean, error)} ({CODES[code]})",
                      "± 5 %" if what == "hopper" else "± 2", mean - margin, mean + margin, values)


def draw(figure, runs):
    for axes, (what, (quantity, _)) in zip(figure.subplots(1, 3), MEASURES.items()):
        for k, code in enumerate(CODES):
            values = found(runs, what, code)
            axes.plot([k] * len(values), values, "C3o" if k == 0 else "ko", markersize=4,
                      markerfacecolor="none")
        axes.set(title=what, ylabel=quantity, xlim=(-0.5, 2.5))
        axes.set_xticks(range(3), CODES.values(), rotation=45)
        low, high = axes.get_ylim()
        axes.set_ylim(min(low, 0.9 * high), max(high, 1.1 * low))
