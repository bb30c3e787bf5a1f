# SPDX-License-Identifier: GPL-3.0-or-later
"""The runs of validation cases that the gate makes, and their rows.

They are those of the cases themselves where these are short, so that both share them, and smaller ones where not: a
drum half as long, columns of beads twice as coarse.
"""
import math
from typing import NamedTuple

from cases import beverloo, column_collapse, conical_hopper, drum, granular_gas, incline, packings, plane_shear, repose
from cases.column_collapse import collapse, measure, power, prefactor
from verdicts import at_most, from_case, same, within


class Bulk(NamedTuple):
    """Runs of a case, and what makes rows of them."""
    name: str
    runs: list
    rows: object  # a function of the runs by their names


CONE = 30  # half-angle, °
FLAT, HOPPER = beverloo.PLAIN[8], conical_hopper.hopper(CONE)


def hopper_rows(runs):
    flat, cone = (beverloo.flows(runs, simulations) for simulations in (FLAT, HOPPER))
    low, high = conical_hopper.RANGES[CONE]
    yield same("hopper", "flat bottom, outlet of 8 d: flow / (6/π φ m √(g/d))", flat)
    yield same("hopper", f"cone of {CONE}°: the same", cone)
    yield within("hopper", f"cone of {CONE}°: flow / that of the flat bottom", cone / flat, low, high, f"{low} to {high}")


HEAPS = [repose.heap(0.3, 0.0), repose.heap(0.5, 0.0), repose.heap(0.5, 0.1), repose.heap(0.5, 0.2)]


def repose_rows(runs):
    for sliding in (0.3, 0.5):
        angle = repose.SHEARED[sliding]
        yield within("repose", f"friction {sliding:g}, no rolling friction: angle [°]",
                     repose.angles(runs, repose.heap(sliding, 0.0)), angle - 2, angle + 4,
                     f"{angle - 2:.1f} to {angle + 4:.1f}")
    yield same("repose", "friction 0.5, rolling friction 0.1: angle [°]", repose.angles(runs, HEAPS[2]))
    yield within("repose", "rolling friction 0.2 less none, friction 0.5 [°]",
                 repose.angles(runs, HEAPS[3]) - repose.angles(runs, HEAPS[1]), 3, math.inf, "at least 3")


FROUDE = 1e-2
SHORT = {"world.max": "[inf, 0.0275, inf]", "fill.0.count": 3850, "fill.0.region.height": 0.0275,
         "wall.drum.height": 0.0275}
DRUMS = [run._replace(name=f"short_{run.name}", settings={**run.settings, **SHORT}) for run in drum.turned_at(FROUDE)]


def drum_rows(runs):
    found = [drum.steady(runs[run.name], FROUDE) for run in DRUMS]
    scene = "drum, Froude number 0.01, half as long"
    yield within(scene, "angle [°]", [one.angle.mean() for one in found], 22, 30, "22 to 30")
    yield same(scene, "angle beside before [°]", [one.angle.mean() for one in found])
    yield within(scene, "torque / (weight × offset of the centre of mass)", [one.balance for one in found], 0.99, 1.01,
                 "± 1 %")
    yield within(scene, "torque × rate / work of the drum", [one.work for one in found], 0.995, 1.005, "± 0.5 %")
    yield within(scene, "dissipation / (torque × rate)", [one.dissipation for one in found], 0.98, 1.02, "± 2 %")


SLOT, ROUND = column_collapse.COARSE_SLOT, column_collapse.ROUND
ASPECTS = (0.5, 1, 2)
COLUMNS = {shape.name: [collapse(shape, aspect) for aspect in ASPECTS] for shape in (SLOT, ROUND)}


def column_rows(runs):
    slots, rounds = ([[measure(runs[run.name], shape) for run in of_seed]
                      for of_seed in zip(*COLUMNS[shape.name])] for shape in (SLOT, ROUND))
    scene = "column collapse, l = 16 d"
    yield same(scene, "slot, a up to 2: exponent of the run-out", [power(seed, "run_out") for seed in slots])
    yield same(scene, "slot, a up to 2: run-out / a", [prefactor(seed, "run_out", 1) for seed in slots])
    yield same(scene, "round, a = 0.5 and 1: run-out / a",
               [prefactor(seed[:2], "run_out", 1) for seed in rounds])
    yield within(scene, "round, a = 2: run-out / √a", [prefactor(seed[2:], "run_out", 0.5) for seed in rounds],
                 1.28, 1.92, "± 20 %")
    yield same(scene, "round, a = 2: height / a^(1/6)", [prefactor(seed[2:], "height", 1 / 6) for seed in rounds])
    yield same(scene, "round, a = 2: duration / √(h/g)", [seed[2].duration for seed in rounds])
    for name, found in (("slot", slots), ("round", rounds)):
        yield within(scene, f"{name}, a = 0.5: height of the middle / before", [seed[0].kept for seed in found],
                     0.9, 1.05, "0.9 to 1.05")
        yield at_most(scene, f"{name}, a = 0.5 and 1: kinetic energy after 6 √(h/g) / (M g h)",
                      [max(one.rest for one in seed[:2]) for seed in found], 1.5, 3, 1e-4)


SLOPES = (15, 24)  # °


def incline_rows(runs):
    still, flowing = SLOPES
    yield within("incline", f"{still}°: mean speed at the end / √(g d)",
                 [incline.numpy.linalg.norm(runs[run.name].frame().velocities, axis=1).mean()
                  / math.sqrt(incline.GRAVITY * incline.DIAMETER) for run in incline.tilted(still)],
                 0, 1e-3, "up to 0.001")
    names = [run.name for run in incline.tilted(flowing)]
    found = [incline.flow(runs[name], flowing) for name in names]
    yield within("incline", f"{flowing}°: acceleration / (g sin θ)",
                 [incline.acceleration(runs[name], flowing, incline.TIMES[flowing]) for name in names],
                 -0.02, 0.02, "± 0.02")
    yield within("incline", f"{flowing}°: R² of Bagnold's profile", [one.r2 for one in found], 0.98, 1, "above 0.98")
    yield within("incline", f"{flowing}°: tan θ less μ(I)",
                 [math.tan(math.radians(flowing)) - incline.mu_of(one.inertial_number) for one in found],
                 -0.04, 0.04, "± 0.04")
    yield same("incline", f"{flowing}°: mean velocity [m/s]", [one.mean_velocity for one in found])
    yield same("incline", f"{flowing}°: solid fraction of the core", [one.fraction for one in found])


PACKED = {"poured, friction 0": (0.0, packings.POURED), "friction 0": (0.0, packings.runs_with(0.0)),
          "friction 0.3": (0.3, packings.runs_with(0.3))}


def packing_rows(runs):
    for name, (friction, simulations) in PACKED.items():
        for what, quantity, references in (("solid fraction", "packing_fraction", packings.FRACTIONS),
                                           ("coordination", "coordination_without_rattlers", packings.COORDINATIONS)):
            value, margin, _ = references[friction]
            yield within("packings", f"{name}: {what}", packings.found(runs, simulations, quantity), value - margin,
                         value + margin, f"{value:g} ± {margin:g}")


def gas_rows(runs):
    return (from_case("gas", row) for row in granular_gas.judge(runs))


SHEARED, NUMBERS = 0.5, (*plane_shear.SLOW, 0.1)  # friction, inertial numbers


def shear_rows(runs):
    seeds = [[plane_shear.state(runs[run.name]) for run in of_seed]
             for of_seed in zip(*(plane_shear.sheared(SHEARED, number) for number in NUMBERS))]
    for what, field, references, margin in (("strength η", "eta", plane_shear.STRENGTHS, 0.02),
                                            ("solid fraction", "fraction", plane_shear.FRACTIONS, 0.015)):
        value = references[SHEARED]
        yield within("plane shear, friction 0.5", f"I → 0: {what}",
                     [plane_shear.limit([one.inertial_number for one in seed], [getattr(one, field) for one in seed],
                                        SHEARED) for seed in seeds], value - margin, value + margin, f"{value:g} ± {margin:g}")
    yield within("plane shear, friction 0.5", "I = 0.1: μ less μ(I)",
                 [seed[2].mu - incline.mu_of(seed[2].inertial_number) for seed in seeds], -0.04, 0.04, "± 0.04")
    for k, number in enumerate(NUMBERS):
        yield same("plane shear, friction 0.5", f"I = {number:g}: η", [seed[k].eta for seed in seeds])


BULKS = [Bulk("conical_hopper", [*FLAT, *HOPPER], hopper_rows),
         Bulk("repose", [run for heap in HEAPS for run in heap], repose_rows),
         Bulk("drum", DRUMS, drum_rows),
         Bulk("column_collapse", [run for columns in COLUMNS.values() for column in columns for run in column],
              column_rows),
         Bulk("incline", [run for angle in SLOPES for run in incline.tilted(angle)], incline_rows),
         Bulk("packings", [run for _, simulations in PACKED.values() for run in simulations], packing_rows),
         Bulk("granular_gas", granular_gas.RUNS, gas_rows),
         Bulk("plane_shear", [run for number in NUMBERS for run in plane_shear.sheared(SHEARED, number)], shear_rows)]
