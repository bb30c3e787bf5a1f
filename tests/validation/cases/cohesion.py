# SPDX-License-Identifier: GPL-3.0-or-later
"""17. Grains that stick: heaps, a column that stands by itself, and what adhesion adds to strength.

Laws: heaps get steeper with the Bond number, the force between two grains over the weight of one. Rumpf (1958): grains
with Z contacts each and the solid fraction φ, which draw each other with F, hold a tension σ = φ Z F/(π d²), d of equal
spheres. In shear that acts as a pressure more: τ = μ (P + σ) (Richefeu, El Youssoufi & Radjai 2006, Phys. Rev. E 73,
051304; Khamseh, Roux & Chevoir 2015, Phys. Rev. E 92, 022201, find it within some tens of per cent when F is below
about P d²). A column without walls stands up to the height f/(ρ φ g), with the unconfined strength f =
2 μ σ tan(45° + ½ atan μ) of Mohr and Coulomb.

Parameters: the ledge of repose.py with `dmt`, whose work of adhesion gives the Bond number, and one heap of LAMMPS with
its dmt, whose surface energy is half the work (the deck that `talus export` writes). A column of 12 × 12 × 24 diameters
(scenes/wet_column.toml) with `bond_number`, whose walls go after 0.15 s: it stands if the mean height of its upper half
has fallen by less than a diameter 0.3 s later. Plane shear of plane_shear.py, friction 0.5, I = 0.04, with `constant`, of
which half and all of P d².

Tolerances, fixed before the runs:
- heaps: from a Bond number to the next in the table the angle rises by more than −0.5°; of Bond number 2 less none: 2° or
  more; LAMMPS's ± 4°, since one run of it scatters by two and its force ends where spheres part.
- strength that adhesion adds, of what Rumpf's tension gives with the Z and φ of the run: ± 0.3.
- the Bond number at which the column begins to stand, of that by Rumpf, Mohr and Coulomb with Z = 5.5, φ = 0.6 and
  μ = 0.5: a factor of 2.5, the sum of a factor of 1.4 by the steps of the table and what the strength of a small column
  scatters.
"""
import math

import numpy

from case import SEEDS, Row, Simulation, over_seeds, told
from read_run import read_frame
from survey import points_of

from . import plane_shear, repose

TITLE = "grains that stick"
FINDINGS = """What adhesion adds to the strength is half of what Rumpf's tension gives, at both forces and in all seeds. It goes
with the range: 0.31 of Rumpf's with a thousandth of a diameter, 0.54 with the usual hundredth, 0.89 with a tenth, which
the bridges of the laws quoted have (half of P d², one seed, by hand). In shear contacts open along one direction, and
with a short range they let go before they have pulled much. Nothing was changed after the runs, but that a first set, of
a program that laid the attraction along the contact's normal, had the same verdicts."""
BONDS = (0.0, 1.0, 2.0, 4.0)
BESIDE = 2.0  # Bond number of LAMMPS's heap
DIAMETER, DENSITY, GRAVITY, FRICTION = 0.01, 2500.0, 9.81, 0.5
WEIGHT = DENSITY * math.pi / 6 * DIAMETER**3 * GRAVITY  # N
SHARES = (0.5, 1.0)  # of P d²
COLUMN_BONDS = (2.0, 4.0, 8.0, 16.0, 32.0, 64.0)
COLUMN_HEIGHT, UPPER = 24.0, 12.0  # diameters


def dmt(bond):
    work = bond * WEIGHT / (2 * math.pi * DIAMETER / 4)
    return {"contact.0.cohesion.law": "dmt", "contact.0.cohesion.work_of_adhesion": f"{work:.6g}"}


def heap(bond, name="", **others):
    return over_seeds(f"sticky_heap_{bond:g}{name}", "ledge", dmt(bond), **others)


def sheared(share):
    force = share * plane_shear.PRESSURE * DIAMETER**2
    return plane_shear.sheared(FRICTION, 0.04, f"sticky_{share:g}", {
        "contact.0.cohesion.law": "constant", "contact.0.cohesion.force": f"{force:.6g}"})


DRY = plane_shear.sheared(FRICTION, 0.04)
LAMMPS = heap(BESIDE, "_lammps", seeds=(1,), program="lammps")
COLUMNS = {bond: Simulation(f"wet_column_{bond:g}", "wet_column", {"contact.0.cohesion.bond_number": bond})
           for bond in COLUMN_BONDS}
RUNS = [*(run for bond in BONDS for run in heap(bond)), *LAMMPS, *DRY,
        *(run for share in SHARES for run in sheared(share)), *COLUMNS.values()]


def added_strength(run, dry, share, state=plane_shear.state):
    """What adhesion adds to shear stress over normal stress, of what Rumpf's tension would."""
    middle = run.sensors()["middle"]
    tension = (middle["packing_fraction"].value * middle["coordination"].value / math.pi
               * share * plane_shear.PRESSURE)
    sticky, loose = state(run), state(dry)
    return (sticky.mu - loose.mu) * middle["stress_zz"].value / (loose.mu * tension)


def judge(runs):
    found = numpy.array([repose.angles(runs, heap(bond)) for bond in BONDS])
    yield Row("heaps: least rise from a Bond number to the next [°]", "above 0", "at least −0.5", -0.5, math.inf,
              repose.least(numpy.diff(found, axis=0)))
    yield Row(f"heaps: Bond number {BESIDE:g} less none [°]", "above 0", "at least 2", 2.0, math.inf,
              tuple(found[BONDS.index(BESIDE)] - found[0]))
    theirs = repose.angle_of_tops(runs[LAMMPS[0].name])
    yield Row(f"heap of Bond number {BESIDE:g}: angle by the last frame [°]", f"{theirs:.1f} (LAMMPS, dmt, one run)", "± 4",
              theirs - 4, theirs + 4, tuple(repose.angle_of_tops(runs[run.name]) for run in heap(BESIDE)))
    for share in SHARES:
        yield Row(f"plane shear, F = {share:g} P d²: strength added, of Rumpf's", "1 (Rumpf 1958)", "± 0.3", 0.7, 1.3,
                  tuple(added_strength(runs[run.name], runs[dry.name], share)
                        for run, dry in zip(sheared(share), DRY)))
    expected, at = column_bond_by_rumpf(), column_bond(runs)
    yield Row("column of 24 d: Bond number from which it stands", f"{expected:.1f} (Rumpf, Mohr, Coulomb)", "factor 2.5",
              expected / 2.5, expected * 2.5, (at,))
    for bond, angles in zip(BONDS, found):
        yield told(f"heap of Bond number {bond:g}: angle [°]", angles)


def column_bond_by_rumpf(contacts=5.5, friction=FRICTION):
    """F over the weight of a grain at which f = ρ φ g H, with φ F Z/(π d²) = ρ φ g d Z Bo/6."""
    factor = 2 * friction * math.tan(math.pi / 4 + 0.5 * math.atan(friction))
    return COLUMN_HEIGHT * 6 / (contacts * factor)


def upper_height(run):
    """By how much the grains that stand higher than half the column when its walls go have come down by the end, less
    than 0 [d]."""
    before, after = (positions(run, which) for which in (0, -1))
    upper = before[:, 2] > UPPER * DIAMETER
    return float((after[upper, 2] - before[upper, 2]).mean() / DIAMETER)


def column_bond(runs, rise=upper_height):
    """Between the largest Bond number that falls and the next, which stands."""
    stands = [rise(runs[COLUMNS[bond].name]) > -1.0 for bond in COLUMN_BONDS]
    first = stands.index(True) if True in stands else len(stands)
    below = COLUMN_BONDS[first - 1] if first else COLUMN_BONDS[0] / 2
    above = COLUMN_BONDS[first] if first < len(stands) else 2 * COLUMN_BONDS[-1]
    return math.sqrt(below * above)


def positions(run, which):
    """By id, in the frame in which walls go (0) or the last (-1) [m]."""
    frames = run.frames()
    chosen = min(frames, key=lambda frame: abs(frame.time - 0.15)) if which == 0 else frames[-1]
    return points_of(read_frame(chosen)).astype(float)


def draw(figure, runs):
    heaps, columns = figure.subplots(1, 2)
    found = numpy.array([repose.angles(runs, heap(bond)) for bond in BONDS])
    heaps.plot(BONDS, found.mean(axis=1), "C0", linewidth=1)
    heaps.plot(numpy.repeat(BONDS, len(SEEDS)), found.ravel(), "C0.", label="ledge, each seed")
    heaps.plot([BESIDE], [repose.angle_of_tops(runs[LAMMPS[0].name])], "ks", markerfacecolor="none", label="LAMMPS, dmt")
    heaps.set(xlabel="Bond number", ylabel="angle of a heap [°]", ylim=(0, None))
    heaps.legend(fontsize="x-small")
    columns.plot(COLUMN_BONDS, [upper_height(runs[COLUMNS[bond].name]) for bond in COLUMN_BONDS], "C1o-", markersize=4)
    columns.axvline(column_bond_by_rumpf(), color="k", linestyle="--", linewidth=1, label="Rumpf, Mohr, Coulomb")
    columns.set(xscale="log", xlabel="Bond number", ylabel="upper half of a column of 24 d: rise [d]")
    columns.legend(fontsize="x-small")
