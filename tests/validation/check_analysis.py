#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks what the cases of the validation page find in made-up data whose answer is known, and the page's words.

    tests/validation/check_analysis.py

Exit codes: 0 all is found, 1 it is not.
"""
import sys
import unittest
from pathlib import Path

import numpy

sys.path[:0] = [str(Path(__file__).parent), str(Path(__file__).resolve().parents[2] / "postprocess")]
from case import Row  # noqa: E402  found by the line above
from cases import (  # noqa: E402
    beverloo, clogging, conical_hopper, force_distribution, granular_gas, janssen, packings, repose)
from page import with_error  # noqa: E402


class Analysis(unittest.TestCase):
    def test_rate_of_haff(self):
        time = 0.3 + numpy.linspace(0, 5, 1001)
        whole, first, second = granular_gas.haff_rates(time, 7 / (1 + 2.5 * (time - 0.3)) ** 2)
        for rate in (whole, first, second):
            self.assertAlmostEqual(rate, 2.5, places=9)
        # A gas that cools more slowly from where √(E(0)/E) is 4 = √16 on: its halves meet there.
        root = numpy.interp(time, [0.3, 1.5, 5.3], [1, 4, 16])
        _, first, second = granular_gas.haff_rates(time, 1 / root**2)
        self.assertAlmostEqual(first, 2.5, places=6)
        self.assertAlmostEqual(second, 12 / 3.8, places=6)

    def test_rate_of_kinetic_theory(self):
        # By hand: n = 2000/0.3741³ = 38200/m³, φ = 0.0200, g(d) = 1.0519, T/m = 1 m²/s²: ν = 28.49/s; e = 0.9:
        # a₂ = −0.01457, 1/τ = 0.19/6 · 28.49 · 0.99727.
        mass = 2000 * 2500 * numpy.pi / 6 * 1e-6
        self.assertAlmostEqual(granular_gas.kinetic_theory_rate(0.9, 1.5 * mass), 0.8997, delta=2e-4)
        self.assertEqual(granular_gas.kinetic_theory_rate(1.0, 1.5 * mass), 0.0)

    def test_tail_of_forces(self):
        random = numpy.random.default_rng(1)
        forces = random.exponential(1 / 1.7, 200000)
        self.assertAlmostEqual(force_distribution.tail_slope(forces, 1.5, 5.0), -1.7, delta=0.03)
        f = numpy.linspace(0, 60, 600001)
        self.assertAlmostEqual(numpy.trapz(force_distribution.mueth(f, *force_distribution.MUETH), f), 1, delta=0.02)

    def test_saturation_of_janssen(self):
        masses = numpy.array([1.0, 2.0, 3.0, 4.0])
        self.assertAlmostEqual(janssen.fitted_saturation(masses, janssen.carried(masses, 1.3)), 1.3, delta=1e-3)
        # The saturated mass on top is carried on as it is, whatever lies between.
        self.assertAlmostEqual(float(janssen.carried(0.7, 1.3, load=1.3)), 1.3, places=12)

    def test_beverloo(self):
        sizes = numpy.array([6, 8, 10, 14.0])
        exponent, c, k = beverloo.fit(sizes, 0.58 * (sizes - 1.4) ** 2.5)
        self.assertAlmostEqual(c, 0.58, delta=1e-6)
        self.assertAlmostEqual(k, 1.4, delta=1e-6)
        self.assertAlmostEqual(exponent, 2.5, delta=1e-6)
        exponent, _, _ = beverloo.fit(sizes, 0.4 * (sizes - 1.4) ** 2.7, k=1.4)
        self.assertAlmostEqual(exponent, 2.7, delta=1e-6)

    def test_conical_hopper(self):
        # Brown's are those of the books, Rose & Tanaka's is by hand.
        for angle, ratio in ((15, 1.49), (30, 1.10), (45, 0.96), (60, 0.93), (90, 1.0)):
            self.assertAlmostEqual(float(conical_hopper.brown(angle)), ratio, delta=0.006)
        self.assertAlmostEqual(float(conical_hopper.rose_tanaka(15, 55)), 1.40, delta=0.006)
        self.assertEqual(float(conical_hopper.rose_tanaka(60, 55)), 1.0)

    def test_mean_until_clog(self):
        # All beads over the number of clogs, some runs having ended before: exponential with mean 300, cut at 400.
        class Run:
            def __init__(self, beads):
                self.beads = min(beads, 400)
                self.last = self.beads if beads < 400 else 399

            def metrics(self):
                return {"time_s": numpy.array([0.0, 8.0, 10.0]),
                        "outlet_passed_count": numpy.array([0, self.last, self.beads])}

        simulations = clogging.silo(3, 1, 1, 4000)
        beads = numpy.random.default_rng(1).exponential(300, len(simulations)).astype(int)
        runs = {run.name: Run(count) for run, count in zip(simulations, beads)}
        self.assertAlmostEqual(clogging.until_clog(runs, simulations).mean(), 300, delta=15)

    def test_least_place(self):
        values = numpy.array([[[5, 6], [1, 4]], [[9, 8], [2, 1.0]]])  # by two places and seed
        self.assertEqual(repose.least(values), (2, 1))

    def test_fraction_of_coordination(self):
        self.assertAlmostEqual(packings.fraction_of(6), 0.634, places=3)
        self.assertAlmostEqual(packings.fraction_of(4), 0.536, places=3)


class Page(unittest.TestCase):
    def test_verdict_is_that_of_the_mean(self):
        row = Row("angle", "22", "± 1", 21.0, 23.0, (20.0, 22.0, 25.5))
        self.assertTrue(row.within)
        self.assertFalse(row._replace(high=22.4).within)
        self.assertAlmostEqual(row.standard_error, 1.607, places=3)

    def test_digits_follow_the_error(self):
        self.assertEqual(with_error(0.96663, 0.0051), "0.9666 ± 0.0051")
        self.assertEqual(with_error(-1284.3, 21.0), "−1284 ± 21")


if __name__ == "__main__":
    unittest.main()
