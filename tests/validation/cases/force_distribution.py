# SPDX-License-Identifier: GPL-3.0-or-later
"""10. Force distribution of a bed at rest.

Law: the normal forces f, over their mean, of a static packing are distributed as P(f) = a (1 − b exp(−f²)) exp(−βf)
with a = 3.0, b = 0.75, β = 1.5 ± 0.1 (Mueth, Jaeger & Nagel 1998, Phys. Rev. E 57, 3164; glass beads pressed in a
cylinder, forces on its walls). By that formula 59 % of the forces are below their mean.

Parameters: the packings of case 9 with friction 0.3, between two plates: contacts of beads with their points more than
three layers from the plates, of all seeds together some seven thousand.

Tolerances, fixed before the runs: slope of ln P between 1.5 and 5 mean forces −1.2 to −2.0, since the references for
the bulk differ by as much (Løvoll, Måløy & Flekkøy 1999, Phys. Rev. E 60, 5872, have 1.8 at the bottom of a bed);
share of forces below the mean 55 to 65 %. Contacts that slide, or are about to, are said to be few among the strong
ones, those above the mean (Radjai, Jean, Moreau & Roux 1996, Phys. Rev. Lett. 77, 274, discs; from memory).
"""
import numpy

from case import Row, told
from read_run import read_frame

from . import packings

TITLE = "force distribution"
FINDINGS = ""
FRICTION = 0.3
RUNS = packings.runs_with(FRICTION)
FITTED = (1.5, 5.0)  # mean forces
LAYER = (0.03, 0.10)  # m, heights of the contacts, as of the sensor "middle" of the scene
MUETH = (3.0, 0.75, 1.5)  # a, b, β


def mueth(f, a, b, beta):
    return a * (1 - b * numpy.exp(-f * f)) * numpy.exp(-beta * f)


def tail_slope(forces, low, high):
    """d ln P/df of forces [mean force] between low and high: the likeliest of an exponential cut at both ends."""
    excess = numpy.mean(forces[(forces > low) & (forces < high)]) - low
    width = high - low
    rates = numpy.linspace(0.01, 20, 200001)
    means = 1 / rates - width / numpy.expm1(rates * width)  # of such an exponential; they fall as the rate rises
    return -float(numpy.interp(-excess, -means, rates))


def contacts_of(run):
    """Normal forces, over their mean, and mobilised friction of the contacts of beads in the middle layer of the last
    frame."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    frame = read_frame(run.frames("contacts")[-1])
    data = frame.GetCellData()
    # A contact is a line between the centres, or from a centre to a wall.
    ends = vtk_to_numpy(frame.GetPoints().GetData()).reshape(-1, 2, 3)
    whole, normal, walls = (vtk_to_numpy(data.GetArray(name)) for name in ("force", "normal_force", "wall"))
    height = ends[:, :, 2].mean(axis=1)
    chosen = (walls < 0) & (normal > 0) & (height > LAYER[0]) & (height < LAYER[1])
    whole, normal = numpy.linalg.norm(whole[chosen], axis=1), normal[chosen]
    return normal / normal.mean(), numpy.sqrt(numpy.maximum(0, whole**2 - normal**2)) / (FRICTION * normal)


def judge(runs):
    seeds = [contacts_of(run) for run in runs.values()]
    yield Row("slope of ln P(f) for f = 1.5 to 5", "−1.5 ± 0.1 (Mueth et al. 1998)", "−2.0 to −1.2", -2.0, -1.2,
              tuple(tail_slope(forces, *FITTED) for forces, _ in seeds))
    yield Row("share of the forces below the mean", "0.59 (Mueth et al. 1998)", "0.55 to 0.65", 0.55, 0.65,
              tuple(float(numpy.mean(forces < 1)) for forces, _ in seeds))
    for what, chosen in (("weak", lambda forces: forces < 1), ("strong", lambda forces: forces > 1)):
        yield told(f"share of the {what} contacts that have 0.99 of their friction or more",
                   (numpy.mean(friction[chosen(forces)] > 0.99) for forces, friction in seeds),
                   "few" if what == "strong" else "")


def draw(figure, runs):
    axes = figure.subplots()
    edges = numpy.linspace(0, 6, 25)
    middles = 0.5 * (edges[1:] + edges[:-1])
    for k, run in enumerate(runs.values()):
        forces, _ = contacts_of(run)
        counts = numpy.histogram(forces, edges)[0]
        axes.plot(middles[counts > 0], counts[counts > 0] / len(forces) / (edges[1] - edges[0]), "C3.",
                  label="runs" if k == 0 else None)
    f = numpy.linspace(0, 6, 200)
    axes.plot(f, mueth(f, *MUETH), "k", linewidth=1, label="Mueth et al. 1998")
    axes.axvspan(*FITTED, color="0.93", zorder=0, label="slope is fitted here")
    axes.set(yscale="log", xlabel="normal force / mean", ylabel="probability density", xlim=(0, 6), ylim=(1e-4, 2))
    axes.legend()
