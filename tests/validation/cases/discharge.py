# SPDX-License-Identifier: GPL-3.0-or-later
"""1, second part. What the discharge of Beverloo's silo does not depend on, or little: fill height, sizes, friction.

Law: W has neither the fill height nor the friction in it (Beverloo, Leniger & van de Velde 1961, Chem. Eng. Sci. 15, 260).

Parameters: the silo of beverloo.py with an outlet of 8 d; with two thirds of the beads, with beads of one size, and with
friction 0, 0.1, 0.3 and 0.8 between the beads.

Tolerances, fixed before the runs: fill height 1 ± 0.03; one size 1 ± 0.05; friction 0.3 and 0.8 within 15 % of 0.5,
"weakly dependent" where friction is high; without friction faster, which has no number.
"""
import math

from case import Row

from .beverloo import DIAMETER, PLAIN, flows, silo

TITLE = "fill height, sizes and friction in Beverloo's silo"
FINDINGS = """Two thirds of the beads flow 3.0 ± 1.0 % faster than all, at the edge of the tolerance: chance, or a
little of the height."""
FRICTIONS = (0.0, 0.1, 0.3, 0.8)
LOWER = silo(8, "_lower", **{"fill.0.count": 5500})
ONE_SIZE = silo(8, "_one_size", **{"fill.0.diameter": DIAMETER})
RUBBED = {friction: silo(8, f"_friction_{friction}", **{"contact.0.friction": friction}) for friction in FRICTIONS}
RUNS = [run for simulations in (PLAIN[8], LOWER, ONE_SIZE, *RUBBED.values()) for run in simulations]


def judge(runs):
    plain = flows(runs, PLAIN[8])
    yield Row("flow with two thirds of the beads / with all", "1 (Beverloo et al. 1961)", "± 3 %", 0.97, 1.03,
              tuple(flows(runs, LOWER) / plain))
    yield Row("flow of equal beads / of beads ± 5 %", "1", "± 5 %", 0.95, 1.05, tuple(flows(runs, ONE_SIZE) / plain))
    for friction in (0.3, 0.8):
        yield Row(f"flow with friction {friction} / with 0.5", "1, weakly dependent", "± 15 %", 0.85, 1.15,
                  tuple(flows(runs, RUBBED[friction]) / plain))
    yield Row("flow without friction / with 0.5", "above 1", "above 1", 1.0, math.inf,
              tuple(flows(runs, RUBBED[0.0]) / plain))


def draw(figure, runs):
    axes = figure.subplots()
    plain = flows(runs, PLAIN[8])
    for friction, simulations in {**RUBBED, 0.5: PLAIN[8]}.items():
        axes.plot([friction] * len(simulations), flows(runs, simulations) / plain.mean(), "C3.")
    axes.axhline(1, color="k", linewidth=1)
    axes.set(xlabel="friction", ylabel="flow / that with friction 0.5")
