# SPDX-License-Identifier: GPL-3.0-or-later
"""6. Column collapse: run-out, height and duration against the aspect ratio, round and in a slot.

Laws, for the aspect ratio a = h/l of a column of height h and radius or half-width l:
- round: run-out (r_∞ − l)/l = 1.24 a below a = 1.7 and 1.6 √a above, height h_∞/l = a for low ones and 0.88 a^{1/6}
  above 1.7, at rest after 3 √(h/g) (Lube, Huppert, Sparks & Hallworth 2004, J. Fluid Mech. 508, 175).
- slot: run-out λ1 a, then λ2 a^{2/3}: λ1 = 1.2, λ2 = 1.9 for sand, rice and sugar (Lube et al. 2005, Phys. Rev. E 72,
  041301); 1.8 and 2.3, from a = 3 on, for glass beads (Lajeunesse, Monnier & Homsy 2005, Phys. Fluids 17, 103302), as
  quoted from Lagrée, Staron & Popinet 2011, J. Fluid Mech. 686, 378; 1.67 and 2.5 for simulated discs (Kumar 2015,
  thesis, Cambridge). Those slots had side walls; a continuum with μ(I) and none has 2.2 a up to a = 7 and 3.9 a^{0.7}
  beyond (Lagrée et al.). Height a^{0.4} (Lube) or a^{1/3} (Lajeunesse). At rest after 3.3 √(h/g) (Lube; Kumar has 3).
Lube's run-outs are as quoted from Staron & Hinch 2005, arXiv physics/0501022, and what he has for round ones besides from
a DEM module of MOOSE (github.com/rochi00/moose, modules/dem/examples/column_collapse_3d/run.py). The height in a slot and
its duration but Kumar's were quoted from memory.

Parameters: l = 32 d, but 16 d of round columns from a = 2 on; beads ± 5 %, friction 0.5, on a bed of the same beads.
Half of the column stands in a slot 4.4 d deep, periodic, or a quarter of a round one between smooth walls. a is that of
the column as it stands. What is poured is held by a smooth gate or tube that vanishes at once. Slots are poured into
little more room than they take: from a looser one a = 4 and 8 fell far, still heaved with 0.5 and 0.7 % of M g h when
they were released, and a = 8 burst in its middle; a first set of their runs was that. The front is where the deposit is
half a diameter thick (beside it, for information, where a strip two diameters wide has no bead), the heights are means
of the tops of the beads, the time is that when 98 % of the run-out is made (and that from which on the front is slower
than 0.02 √(g h), for information). From the release runs last 6 √(h/g), of a = 4 only 4.2, and of a = 8, which stop
sooner, 3.4: from there to 4.2 fronts swung by 1.3 % at most, and rows change by less than 1 % (a first set of runs);
with half the step they last 5, from where fronts stood to 0.1 % (an earlier set). The run-out depends on l/d, too
(Warnett et al. 2014, Granular Matter 16, 115), hence the prefactors only ± 20 %. The automatic step follows from what
might fall from the top of the column, 0.1 d in a step.

Tolerances, fixed before the runs: prefactors ± 20 %, of the slot those of glass beads; exponents ± 0.07; durations,
mean of all that are higher than a = 1.5, ± 15 %; of the lowest the height of the middle 0.9 to 1.05 of that before,
which was the mean height of the column at first, but the middle of a round one stands lower; kinetic energy 6 √(h/g)
after the release, a up to 2, round up to 1, up to 1e-4 M g h. For a time a = 8 in the slot, 4 and 8 round, were left
out, and l was 16 d; in the slot and for low round columns it was made 32 d when runs with 16 d had been judged, which
are shown beside. Half the step, a = 2 in the slot: 1 ± 0.05, added when steps 1.9 times as long had shortened the
run-out of a = 8 there by 8 %. No tolerance was touched.
"""
import math
from typing import NamedTuple

import numpy

from case import Row, over_seeds, told
from deck import spheres_of
from measures import mean_of_highest, volumes

TITLE = "column collapse"
FINDINGS = """The slots of the experiments had side walls, these have none. Run-outs of a = 4 and 8 lie between those of
the experiments and those of a continuum without such walls, which are in proportion to a up to a = 7; so does their
exponent, 0.82. With twice as many beads across, low columns run out further: in the slot nearer to the glass beads of
Lajeunesse et al., round ones nearer to Lube's law. The exponent of low ones in the slot stays too large; taken as far
as there are beads it is a little smaller, 1.13, still outside. From a = 0.5 to 1 it falls with the size of the beads,
1.29, 1.24 and 1.16 with l = 16, 32 and 64 d (by hand, from these runs and one of each a for 64 d, settings as of
collapse() for d = 1.25 mm); from 1 to 2 it is 1.16 with 32 d. Round columns from a = 2 on were run with l = 16 d only:
a = 2 falls short of the law, a = 8 goes beyond it; with 32 d they take up to a quarter of a million beads. LAMMPS has
the same of the same columns (decks of `talus export`, 5e6 Pa, one run of each, by hand): in the slot run-outs of 0.71,
1.65, 3.70 and 6.98 at a = 0.48, 0.95, 1.91 and 3.75, an exponent of 1.20 up to a = 2, and 2.9 a^(2/3) at the last;
round, 1.95 and 3.50 at a = 1.99 and 4.20, an exponent of 0.78, heights of 0.67 l, and 98 % of the way made after 2.44
and 2.33 √(h/g). So what is outside up to a = 4 is hardly the method's; a = 8 was not run there. Another code of soft
spheres has an exponent of round ones between a = 2 and 3, with l = 12 d, that is too large, too, 0.85 (run-outs of 2.42
and 3.42), and heights of 0.63 to 0.71 l from a = 1 on, below Lube's (the DEM module of MOOSE,
modules/dem/doc/content/validation.md). Spheres that roll freely leave a shallow cone: with rolling friction 0.2 the
height / a^(1/6) at a = 2 (one run) is 0.80, within 20 % of the law; higher columns were not run with it. Round ones
stop sooner than Lube's by the time when 98 % of the way is made. How the end is defined changes that by a seventh, in
the slot by a fifth: by the time from which on the front is slower than a fiftieth of √(g h) round ones are within the
tolerance, and those in the slot, which by 98 % are, just beyond it. How Lube defined it could not be read again."""
LENGTH, GRAVITY, DENSITY = 0.08, 9.81, 2500.0  # as in the scenes
RELEASE = 0.3  # s
LASTING = {4: 4.2, 8: 3.4}  # from there on, by the aspect ratio; of lower ones 6 [√(h/g)]
THICKNESS, FRACTION = 0.5, 0.58  # of the front [d]; of solid, to tell the thickness
NONE = 0.05  # thickness where there is less than a bead in two diameters of a slot [d]
STILL = 0.02  # √(g h), the speed below which a front stands still


class Shape(NamedTuple):
    """Of columns."""
    name: str
    scene: str
    diameter: float  # of the beads [m]
    count: int  # of the beads, for an aspect ratio of 1
    aspects: tuple[float, ...]
    settings: dict[str, object] = {}  # where beads are not those of the scene


def of_beads(diameter, **settings):
    """Settings for such beads and a bed of them."""
    return {"fill.0.diameter.min": 0.95 * diameter, "fill.0.diameter.max": 1.05 * diameter, "wall.bed.diameter": diameter,
            "wall.ground.point": f"[0, 0, {-diameter}]", **settings}


SLOT = Shape("slot", "slot_collapse", 0.0025, 4960, (0.5, 1, 2, 4, 8))
ROUND = Shape("round", "quarter_collapse", 0.005, 3550, (0.5, 1, 2, 4, 8))
COARSE_SLOT = Shape("coarse_slot", "slot_collapse", 0.005, 1240, (0.5, 1, 2), of_beads(0.005, **{
    "world.max": "[inf, 0.022, inf]", "wall.bed.min": "[-0.005, 0, -0.0025]", "wall.bed.max": "[1.2, 0.022, -0.0025]"}))
FINE_ROUND = Shape("fine_round", "quarter_collapse", 0.0025, 28400, (0.5, 1), of_beads(0.0025, **{
    "wall.bed.min": "[-0.005, -0.005, -0.00125]", "wall.bed.max": "[0.4, 0.4, -0.00125]"}))


class Collapse(NamedTuple):
    aspect: float
    run_out: float  # (l_∞ − l)/l
    reach: float  # the same, to where there is no bead
    height: float  # h_∞/l
    kept: float  # height of the middle / before
    duration: float  # until 98 % of the run-out is made [√(h/g)]
    moving: float  # until the front stands still [√(h/g)]
    unrest: float  # kinetic energy when it is released / (M g h)
    rest: float  # kinetic energy at the end / (M g h)


def depth(shape):
    """Of the slot [m]."""
    return 4.4 * shape.diameter


def is_round(shape):
    return shape.scene == ROUND.scene


def collapse(shape, aspect, name="", **settings):
    key, top = (("height", 0.13 * aspect + 0.01) if is_round(shape) else
                ("max", f"[{LENGTH}, {depth(shape):g}, {0.0825 * aspect + 0.02:g}]"))
    return over_seeds(f"collapse_{shape.name}_{aspect:g}{name}", shape.scene, {
        "fill.0.count": round(shape.count * aspect), f"fill.0.region.{key}": top,
        "time.duration": RELEASE + LASTING.get(aspect, 6) * math.sqrt(aspect * LENGTH / GRAVITY), **shape.settings,
        **settings})


COLUMNS = {shape.name: [collapse(shape, aspect) for aspect in shape.aspects]
           for shape in (SLOT, COARSE_SLOT, ROUND, FINE_ROUND)}
ROLLING = collapse(ROUND, 2, "_rolling", **{"contact.0.rolling_friction": 0.2})[:1]
FINER = collapse(SLOT, 2, "_finer", **{
    "time.step": 5.6e-5, "time.duration": RELEASE + 5 * math.sqrt(2 * LENGTH / GRAVITY)})
RUNS = [*(run for columns in COLUMNS.values() for simulations in columns for run in simulations), *ROLLING, *FINER]


def distances(spheres, shape):
    """From the middle [m]."""
    return numpy.hypot(*spheres.positions[:, :2].T) if is_round(shape) else spheres.positions[:, 0]


def area(distance, shape):
    """Of the floor within a distance from the middle [m²]."""
    return math.pi / 4 * distance**2 if is_round(shape) else depth(shape) * distance


def front(distance, radii, shape, thin=THICKNESS):
    """Where the deposit becomes thinner than so many diameters, going outwards [m]."""
    diameter = shape.diameter
    edges = numpy.arange(0, distance.max() + 4 * diameter, 2 * diameter)  # the last is empty
    solid = numpy.histogram(distance, edges, weights=volumes(radii))[0]
    thickness = solid / (FRACTION * numpy.diff(area(edges, shape))) / diameter
    middles = 0.5 * (edges[1:] + edges[:-1])
    k = int(numpy.argmax(thickness < thin))
    return float(numpy.interp(thin, thickness[[k, k - 1]], middles[[k, k - 1]]))


def top(spheres, distance, up_to, diameter):
    """Mean, over cells of the floor one diameter wide, of the highest top [m]."""
    inside = distance < up_to
    return mean_of_highest((spheres.positions[:, 2] + spheres.radii)[inside],
                           numpy.floor(spheres.positions[inside, :2] / diameter))


def measure(run, shape):
    frames = [spheres for spheres in spheres_of(run) if spheres.time >= RELEASE - 0.011]
    before, after = frames[0], frames[-1]
    fronts = numpy.array([front(distances(spheres, shape), spheres.radii, shape) for spheres in frames])
    diameter = shape.diameter
    height = top(before, distances(before, shape), LENGTH - 2 * diameter, diameter)
    reach = front(distances(after, shape), after.radii, shape, NONE)
    times = numpy.array([spheres.time for spheres in frames]) - RELEASE
    speeds = numpy.gradient(fronts, times) / math.sqrt(GRAVITY * height)
    made = LENGTH + 0.98 * (fronts[-1] - LENGTH)
    arrival = times[int(numpy.argmax(fronts >= made))]
    stop = times[numpy.flatnonzero(speeds > STILL)[-1]]
    metrics = run.metrics()
    energies = metrics["kinetic_energy_J"] / (DENSITY * volumes(after.radii).sum() * GRAVITY * height)
    middles = [top(one, distances(one, shape), 3 * diameter, diameter) for one in (before, after)]
    return Collapse(height / LENGTH, fronts[-1] / LENGTH - 1, reach / LENGTH - 1, middles[1] / LENGTH,
                    middles[1] / middles[0], arrival / math.sqrt(height / GRAVITY), stop / math.sqrt(height / GRAVITY),
                    float(numpy.interp(before.time, metrics["time_s"], energies)), energies[-1])


def by_seed(runs, shape):
    """For each seed, the collapses by rising aspect ratio."""
    return [[measure(runs[run.name], shape) for run in of_seed] for of_seed in zip(*COLUMNS[shape.name])]


def power(collapses, field):
    """The exponent of a field in the aspect ratio."""
    return float(numpy.polyfit(numpy.log([one.aspect for one in collapses]),
                               numpy.log([getattr(one, field) for one in collapses]), 1)[0])


def prefactor(collapses, field, exponent):
    return float(numpy.mean([getattr(one, field) / one.aspect**exponent for one in collapses]))


def within(what, reference, value, margin, values):
    """A row with a margin in percent."""
    return Row(what, reference, f"± {margin} %", value * (1 - margin / 100), value * (1 + margin / 100), tuple(values))


def judge(runs):
    slots, coarse, rounds, fine = (by_seed(runs, shape) for shape in (SLOT, COARSE_SLOT, ROUND, FINE_ROUND))
    yield Row("slot, a up to 2: exponent of the run-out", "1 (Lube et al. 2005)", "± 0.07", 0.93, 1.07,
              tuple(power(seed[:3], "run_out") for seed in slots))
    yield told("the same with l = 16 d", (power(seed, "run_out") for seed in coarse))
    yield told("the same as far as there are beads", (power(seed[:3], "reach") for seed in slots))
    yield within("slot, a up to 2: run-out / a", "1.8 (glass beads, Lajeunesse et al. 2005)", 1.8, 20,
                 (prefactor(seed[:3], "run_out", 1) for seed in slots))
    yield told("the same with l = 16 d", (prefactor(seed, "run_out", 1) for seed in coarse))
    yield Row("slot, a = 4 and 8: exponent of the run-out", "2/3 (Lube et al. 2005; Lajeunesse et al. 2005)", "± 0.07",
              0.597, 0.737, tuple(power(seed[3:], "run_out") for seed in slots))
    yield within("slot, a = 4 and 8: run-out / a^(2/3)", "2.3 (glass beads, Lajeunesse et al. 2005)", 2.3, 20,
                 (prefactor(seed[3:], "run_out", 2 / 3) for seed in slots))
    yield told("slot, a = 4 and 8: run-out / a", (prefactor(seed[3:], "run_out", 1) for seed in slots),
               "2.2 up to a = 7 (continuum without side walls, Lagrée et al. 2011)")
    yield Row("slot, a = 2: run-out with half the step / as is", "1", "± 5 %", 0.95, 1.05, tuple(
        measure(runs[run.name], SLOT).run_out / seed[2].run_out for run, seed in zip(FINER, slots)))
    yield Row("slot, a from 1: exponent of the height", "1/3 to 0.4 (Lajeunesse; Lube et al. 2005; from memory)",
              "0.26 to 0.47", 0.26, 0.47, tuple(power(seed[1:], "height") for seed in slots))
    yield within("round, a = 0.5 and 1: run-out / a", "1.24 (Lube et al. 2004)", 1.24, 20,
                 (prefactor(seed, "run_out", 1) for seed in fine))
    yield told("the same with l = 16 d", (prefactor(seed[:2], "run_out", 1) for seed in rounds))
    yield Row("round, a from 2: exponent of the run-out", "1/2 (Lube et al. 2004)", "± 0.07", 0.43, 0.57,
              tuple(power(seed[2:], "run_out") for seed in rounds))
    yield within("round, a from 2: run-out / √a", "1.6 (Lube et al. 2004)", 1.6, 20,
                 (prefactor(seed[2:], "run_out", 0.5) for seed in rounds))
    yield within("round, a from 2: height / a^(1/6)", "0.88 (Lube et al. 2004)", 0.88, 20,
                 (prefactor(seed[2:], "height", 1 / 6) for seed in rounds))
    yield told("round, a = 1: height / l", (seed[1].height for seed in fine), "1 (Lube et al. 2004)")
    yield told("round, a = 2: height / a^(1/6)", (prefactor(seed[2:3], "height", 1 / 6) for seed in rounds),
               "0.88 (Lube et al. 2004)")
    yield told("the same with rolling friction 0.2 (one run)",
               (prefactor([measure(runs[run.name], ROUND)], "height", 1 / 6) for run in ROLLING),
               "0.88 (Lube et al. 2004)")
    for name, high, low, value, source, highest in (("slot", slots, slots, 3.3, "2005, from memory", 2),
                                                    ("round", rounds, fine, 3.0, "2004", 1)):
        yield within(f"{name}, a from 2: duration / √(h/g)", f"{value:g} (Lube et al. {source})", value, 15,
                     (numpy.mean([one.duration for one in seed[2:]]) for seed in high))
        yield told(f"{name}, a from 2: time until the front is slower than {STILL:g} √(g h) / √(h/g)",
                   (numpy.mean([one.moving for one in seed[2:]]) for seed in high), f"{value:g} (Lube et al. {source})")
        yield told(f"{name}, all: largest kinetic energy when released / (M g h)",
                   (max(one.unrest for one in seed) for seed in high))
        yield Row(f"{name}, a = 0.5: height of the middle / before", "1 (Lube et al.)", "0.9 to 1.05", 0.9, 1.05,
                  tuple(seed[0].kept for seed in low))
        yield Row(f"{name}, a up to {highest}: kinetic energy after 6 √(h/g) / (M g h)", "0, at rest", "up to 1e-4", 0.0,
                  1e-4, tuple(max(one.rest for one in seed[:3]) for seed in low))


def draw(figure, runs):
    left, right, below = figure.subplot_mosaic([["run-out", "height"], ["legend", "legend"]],
                                               height_ratios=[3, 1]).values()
    for shape, mark, label in ((SLOT, "C0.", "slot, l = 32 d"), (COARSE_SLOT, "C0+", "slot, l = 16 d"),
                               (ROUND, "C3+", "round, l = 16 d"), (FINE_ROUND, "C3.", "round, l = 32 d")):
        collapses = [one for seed in by_seed(runs, shape) for one in seed]
        aspects = [one.aspect for one in collapses]
        left.plot(aspects, [one.run_out for one in collapses], mark, label=label, markersize=5)
        right.plot(aspects, [one.height for one in collapses], mark, markersize=5)
    low, high, both = numpy.array([0.4, 1.7]), numpy.array([1.7, 10]), numpy.array([0.4, 10])
    left.plot(numpy.append(low, high), numpy.append(1.24 * low, 1.6 * high**0.5), "C3", linewidth=1,
              label="round, Lube et al. 2004")
    low, high = numpy.array([0.4, 3]), numpy.array([3, 10])
    left.plot(low, 1.8 * low, "C0", high, 2.3 * high ** (2 / 3), "C0", linewidth=1)
    left.plot([], [], "C0", linewidth=1, label="slot, glass beads, Lajeunesse et al. 2005")
    low, high = numpy.array([0.4, 7]), numpy.array([7, 10])
    left.plot(numpy.append(low, high), numpy.append(2.2 * low, 3.9 * high**0.7), "C0:", linewidth=1,
              label="slot without side walls, μ(I), Lagrée et al. 2011")
    right.plot(both, 0.88 * both ** (1 / 6), "C3", linewidth=1)
    right.plot(both, both, "k:", linewidth=1, label="as it stood")
    for axes, label, limits in ((left, "run-out / l", (0.3, 30)), (right, "height / l", (0.3, 12))):
        axes.set(xscale="log", yscale="log", xlabel="aspect ratio", ylabel=label, ylim=limits)
    below.axis("off")
    below.legend(handles=[handle for axes in (left, right) for handle in axes.get_legend_handles_labels()[0]],
                 fontsize="x-small", loc="center", ncols=2)
