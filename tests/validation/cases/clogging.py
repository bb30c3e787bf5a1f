# SPDX-License-Identifier: GPL-3.0-or-later
"""3. Clogging: how many beads leave a silo before an arch closes its outlet.

Law: the mean number grows as s = A (R_c − R)^{−γ} with the outlet R = D/d, and from R_c on nothing clogs, whatever
spheres are made of (Zuriguel, Garcimartín, Maza, Pugnaloni & Pastor 2005, Phys. Rev. E 71, 051303; R_c = 4.94 ± 0.03,
γ = 6.9 ± 0.2 and A = 9900 from memory). Others see no divergence, but a growth with the exponential of (D/d)³ (Thomas &
Durian 2015, Phys. Rev. Lett. 114, 178001); for such outlets the two look alike.

Parameters: beads ± 1 %, friction 0.5, restitution 0.5, in a tube 12 d wide, 15 d for the outlet of 6 d. A run is one
discharge from a settled bed, and ends before that is used up. It has clogged where nothing passes in its last second;
the mean of an exponential distribution is all beads that passed over the number of clogs, and its error that of such a
ratio. Four to six seeds up to 3 d, three beyond, but eight at 3.5 d: nine were added when the first three had clogged
after 18, 121 and 17 beads, and four given up later, for time. Of other frictions there were three, too, until one of
those with 0.3 had not clogged.

Tolerances, fixed before the runs:
- D/d = 2: at most 100 beads, which is "at once".
- 2.5, 3, 3.5: within a factor of 4 of the law, for its numbers are from memory, a mean of four has an error of 50 %,
  and a first discharge may differ from those between two clogs.
- 4: half of three runs of some thousand beads clog at most; they became runs of 800 to 900, by the law one in eighteen.
- 6: none in three runs of more than a thousand beads.
- D/d = 3, friction 0.3 and 0.8 / 0.5: a factor of 3, "whatever the beads are made of"; the error is that of the first.
  Without friction none clogs.
"""
import math

import numpy

from case import Row, over_seeds, told

TITLE = "clogging"
FINDINGS = """The runs are few and short, and a wait for a clog scatters as much as it lasts. Means lie below the law.
At 2.5 d they do by a factor of nine, and so outside; with twenty more seeds there (6 to 25, by hand, 6.1 ± 1.2) it is
one of four, the edge of the tolerance, and five seeds fall on either side of it by chance. At 4 d one run of three has
clogged, after 31 beads, which by the law one in five hundred does. These are first discharges; those of the law lie
between two clogs, and begin when a jet of air breaks an arch. A bottom that is shaken for a moment after the opening
was not tried. At 3.5 d two of eight runs clog before the 25th bead. Of the twelve of an earlier set none did, and their
mean was 1330 ± 640; of those of another five, and 356; twelve more seeds by each of these programs (by hand) had means
of 896 and 829, the law's."""
STILL = 1.0  # s without a bead at the end of a run that has clogged
A, CRITICAL, EXPONENT = 9900, 4.94, 6.9  # of Zuriguel et al. 2005


def silo(size, count, until, seeds, radius=0.06, friction=0.5):
    return over_seeds(f"clogging_{size}_{friction}", "clogging", {
        "fill.0.count": count, "fill.0.region.radius": radius, "wall.tube.radius": radius, "wall.bottom.radius": radius,
        "wall.bottom.hole_radius": 0.005 * size, "wall.gate.radius": 0.007 * size, "contact.0.friction": friction,
        "time.duration": until}, range(1, seeds + 1))


CLOGGING = {2: silo(2, 1500, 2.0, 4), 2.5: silo(2.5, 1500, 3.0, 5), 3: silo(3, 1500, 4.5, 6),
            3.5: silo(3.5, 2000, 7.0, 8)}
FLOWING = {4: silo(4, 2000, 5.0, 3), 6: silo(6, 3000, 2.5, 3, radius=0.075)}
RUBBED = {friction: silo(3, 1500, 4.5, 6, friction=friction) for friction in (0.3, 0.8)}
SMOOTH = silo(3, 1500, 3.0, 3, friction=0.0)
ALL = (*CLOGGING.values(), *FLOWING.values(), *RUBBED.values(), SMOOTH)
RUNS = [run for simulations in ALL for run in simulations]


def law(size):
    return A * (CRITICAL - numpy.asarray(size)) ** -EXPONENT


def passed(run):
    """How many beads, and whether the outlet has clogged."""
    metrics = run.metrics()
    time, count = metrics["time_s"], metrics["outlet_passed_count"]
    return int(count[-1]), bool(count[-1] == count[time <= time[-1] - STILL][-1])


def until_clog(runs, simulations):
    """Their mean is all beads that passed over the number of clogs, and their scatter that of such a ratio."""
    counts, clogs = numpy.array([passed(runs[run.name]) for run in simulations], float).T
    if not clogs.any():
        return numpy.full(len(counts), numpy.inf)
    mean = counts.sum() / clogs.sum()
    return mean + (counts - mean * clogs) / clogs.mean()


def clogs(runs, simulations):
    return tuple(float(passed(runs[run.name])[1]) for run in simulations)


def judge(runs):
    for size, simulations in CLOGGING.items():
        expected = float(law(size))
        low, high = (0.0, 100.0) if size == 2 else (expected / 4, expected * 4)
        yield Row(f"D/d = {size}: beads until the first clog", f"{expected:.3g} (Zuriguel et al. 2005, from memory)",
                  "up to 100" if size == 2 else f"{low:.3g} to {high:.3g}", low, high,
                  tuple(until_clog(runs, simulations)))
    for size, highest in ((4, 0.5), (6, 0.0)):
        found = [passed(runs[run.name]) for run in FLOWING[size]]
        beads = min((count for count, has_clogged in found if not has_clogged), default=0)
        expected = 1 - math.exp(-beads / law(size)) if size < CRITICAL else 0
        yield Row(f"D/d = {size}: share of runs that clog; the others are of {beads} beads or more",
                  f"{expected:.2g} (Zuriguel et al. 2005, from memory)", f"up to {highest}", 0.0, highest,
                  clogs(runs, FLOWING[size]))
    yield told("D/d = 3.5: share of runs that clog before the 25th bead",
               (passed(runs[run.name])[0] < 25 for run in CLOGGING[3.5]))
    plain = until_clog(runs, CLOGGING[3]).mean()
    for friction, simulations in RUBBED.items():
        yield Row(f"D/d = 3, friction {friction} / 0.5: beads until the first clog", "1 (Zuriguel et al. 2005)",
                  "1/3 to 3", 1 / 3, 3.0, tuple(until_clog(runs, simulations) / plain))
    yield Row("D/d = 3, no friction: share of runs that clog", "0", "0", 0.0, 0.0, clogs(runs, SMOOTH))


def draw(figure, runs):
    axes = figure.subplots()
    sizes = numpy.linspace(1.8, 4.4, 100)
    axes.plot(sizes, law(sizes), "k", linewidth=1, label="Zuriguel et al. 2005")
    axes.fill_between(sizes, law(sizes) / 4, law(sizes) * 4, color="0.9", label="a factor of 4")
    axes.axvline(CRITICAL, color="k", linestyle=":", linewidth=1, label="R_c")
    for size, simulations in {**CLOGGING, **FLOWING}.items():
        for run in simulations:
            count, has_clogged = passed(runs[run.name])
            axes.plot(size, max(count, 0.5), "C3." if has_clogged else "C0^", markersize=4)
        if size in CLOGGING:
            axes.plot(size, until_clog(runs, simulations).mean(), "C3_", markersize=16)
    axes.plot([], [], "C3.", label="runs that clogged")
    axes.plot([], [], "C3_", label="their mean")
    axes.plot([], [], "C0^", markersize=4, label="runs that did not")
    axes.set(yscale="log", xlabel="outlet / d", ylabel="beads", xlim=(1.7, 6.3), ylim=(0.4, 1e5))
    axes.legend(loc="upper left", fontsize="small")
