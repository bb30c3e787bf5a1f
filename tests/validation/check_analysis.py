#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks what the cases of the validation page find in made-up data whose answer is known, and the page's words.

    tests/validation/check_analysis.py

Exit codes: 0 all is found, 1 it is not.
"""
import math
import sys
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace

import numpy

sys.path[:0] = [str(Path(__file__).parent), str(Path(__file__).resolve().parents[2] / "postprocess")]
from case import Row, mean_and_error, told  # noqa: E402  found by the line above
from cases import (beverloo, chung_ooi, clogging, cohesion, column_collapse, conical_hopper, crater, drum,  # noqa: E402
                   force_distribution, granular_gas, incline, janssen, packings, plane_shear, repose, segregation)
from deck import DeckRun  # noqa: E402
from measures import line_of_tops  # noqa: E402
from page import verdict_of, with_error  # noqa: E402


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

    def test_column_that_stands(self):
        # By hand: 24 · 6/(5.5 · 2 · 0.5 · tan(45° + 13.283°)), with atan 0.5 = 26.565°.
        self.assertAlmostEqual(cohesion.column_bond_by_rumpf(), 16.18, delta=0.01)
        fallen = {2.0: -9.0, 4.0: -8.0, 8.0: -6.0, 16.0: -1.5, 32.0: -0.3, 64.0: -0.1}
        found = cohesion.column_bond({f"wet_column_{bond:g}": rise for bond, rise in fallen.items()}, lambda rise: rise)
        self.assertAlmostEqual(found, math.sqrt(16 * 32))

    def test_strength_that_adhesion_adds(self):
        # Of a pressure more of φ Z F/(π d²) = 0.6 · 5/π · 0.5 · 1000 Pa, which is 477.5 Pa.
        value = lambda number: SimpleNamespace(value=number)
        run = SimpleNamespace(sensors=lambda: {"middle": {"packing_fraction": value(0.6), "coordination": value(5.0),
                                                          "stress_zz": value(1000.0)}})
        loose, sticky = (SimpleNamespace(mu=mu) for mu in (0.4, 0.4 * (1 + 0.4775)))
        states = {id(run): sticky, 0: loose}
        found = cohesion.added_strength(run, 0, 0.5, lambda one: states[id(one) if one is run else 0])
        self.assertAlmostEqual(found, 1.0, delta=1e-3)

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
        mean, error = mean_and_error(clogging.until_clog(runs, simulations))
        self.assertAlmostEqual(mean, 300, delta=15)
        clogs = sum(beads < 400)
        self.assertAlmostEqual(error, 300 / math.sqrt(clogs), delta=0.05 * error)

    def test_least_place(self):
        values = numpy.array([[[5, 6], [1, 4]], [[9, 8], [2, 1.0]]])  # by two places and seed
        self.assertEqual(repose.least(values), (2, 1))

    def test_fraction_of_coordination(self):
        self.assertAlmostEqual(packings.fraction_of(6), 0.634, places=3)
        self.assertAlmostEqual(packings.fraction_of(4), 0.536, places=3)

    def test_moment_of_a_drum(self):
        # Two beads on the side that rises, one of eight times their mass opposite at a quarter of the distance.
        spheres = SimpleNamespace(radii=numpy.array([1, 1, 2.0]),
                                  positions=numpy.array([[-1, 0, 0], [-1, 0, 5], [0.25, 0, 0]]))
        self.assertAlmostEqual(drum.offset_moment(spheres), 0.0, places=9)
        spheres.positions[2, 0] = 0.0
        self.assertAlmostEqual(drum.offset_moment(spheres), 2 * 9.81 * 2500 * 4 / 3 * math.pi, places=6)

    def test_bagnold(self):
        z = numpy.linspace(0.01, 0.16, 16)
        a, slip, fitted = incline.bagnold(z, 0.1 + 7 * (0.18**1.5 - (0.18 - z) ** 1.5), 0.18)
        self.assertAlmostEqual(a, 7, places=9)
        self.assertAlmostEqual(slip, 0.1, places=9)
        self.assertAlmostEqual(fitted[0], 0.1 + 7 * (0.18**1.5 - 0.17**1.5), places=9)
        # A slope and the inertial number of a layer that flows so are bound by the stresses at any depth.
        self.assertAlmostEqual(incline.mu_of(incline.I0), 0.5 * (incline.MU_S + incline.MU_2), places=12)
        self.assertAlmostEqual(incline.h_stop(24), 5.6, delta=0.1)

    def test_limit_of_slow_shear(self):
        numbers = numpy.array([0.005, 0.02, 0.08])
        self.assertAlmostEqual(plane_shear.limit(numbers, 0.38 + 0.9 * numbers, 0.5), 0.38, places=9)
        self.assertAlmostEqual(plane_shear.limit(numbers, 0.1 + 0.4 * numbers**0.38, 0.0), 0.1, places=9)

    def test_front_and_top_of_a_deposit(self):
        # Layers of beads, two diameters thick up to 0.2 m and three tenths of a diameter beyond.
        random = numpy.random.default_rng(1)
        for shape in (column_collapse.SLOT, column_collapse.ROUND):
            diameter = shape.diameter
            radius = 0.5 * diameter
            bead = 4 / 3 * math.pi * radius**3
            floor = column_collapse.area(numpy.array([0.2, 0.3]), shape)
            thick, thin = (numpy.array([2, 0.3]) * diameter * column_collapse.FRACTION
                           * numpy.diff(floor, prepend=0) / bead).astype(int)
            share = numpy.concatenate([random.random(thick) * floor[0],
                                       numpy.linspace(*floor, thin, endpoint=False)])
            distance = (numpy.sqrt(share / math.pi * 4) if column_collapse.is_round(shape)
                        else share / column_collapse.depth(shape))
            found = column_collapse.front(distance, numpy.full(len(distance), radius), shape)
            self.assertAlmostEqual(found, 0.2, delta=1.1 * diameter)
            found = column_collapse.front(distance, numpy.full(len(distance), radius), shape, 0.05)
            self.assertAlmostEqual(found, 0.3, delta=2 * diameter)
        spheres = SimpleNamespace(radii=numpy.full(3, 0.0025), positions=numpy.array(
            [[0.001, 0.001, 0.0025], [0.002, 0.001, 0.0075], [0.006, 0.001, 0.0025]]))
        self.assertAlmostEqual(column_collapse.top(spheres, spheres.positions[:, 0], 0.1, 0.005), 0.0075, places=9)
        self.assertAlmostEqual(column_collapse.top(spheres, spheres.positions[:, 0], 0.005, 0.005), 0.01, places=9)

    def test_angle_of_tops(self):
        # Beads in a lattice below a plane that falls by 0.5, with one in flight and one that has fallen off.
        x, y = (axis.ravel() for axis in numpy.meshgrid(numpy.arange(0.005, 0.2, 0.01), numpy.arange(0.005, 0.06, 0.01)))
        positions = numpy.vstack([numpy.column_stack([x, y, 0.15 - 0.5 * x - depth]) for depth in (0, 0.01)]
                                 + [[[0.30, 0.02, 0.1], [0.1, 0.02, -0.1]]])
        run = DeckRun.__new__(DeckRun)
        run.spheres = [SimpleNamespace(positions=positions, radii=numpy.full(len(positions), 0.005))]
        self.assertAlmostEqual(repose.angle_of_tops(run), math.degrees(math.atan(0.5)), places=9)

    def test_exponent_of_collapses(self):
        collapses = [column_collapse.Collapse(a, 1.6 * a**0.5, a, a, 1, 3, 3, 0, 0) for a in (2, 4, 8)]
        self.assertAlmostEqual(column_collapse.power(collapses, "run_out"), 0.5, places=9)
        self.assertAlmostEqual(column_collapse.prefactor(collapses, "run_out", 0.5), 1.6, places=9)

    def test_rigid_impact(self):
        # By hand: 3.9 m/s at 35°, e = 0.98, μ = 0.092: v_n = 3.1947, v_t = 2.2369, J_t/m = 0.58195.
        restitution, spin, angle = chung_ooi.rigid_4(35)
        self.assertAlmostEqual(restitution, 0.73984, places=4)
        self.assertAlmostEqual(spin, 581.95, places=1)
        self.assertAlmostEqual(angle, numpy.degrees(numpy.arctan(0.20008 / 3.13081)), places=2)
        restitution, _, angle = chung_ooi.rigid_4(10)  # sticks
        self.assertAlmostEqual(restitution, 5 / 7, places=12)
        self.assertEqual(angle, 0)

    def test_line_of_tops(self):
        random = numpy.random.default_rng(1)
        along, across = random.uniform(0, 1, 20000), random.integers(0, 5, 20000)
        below = random.uniform(0, 1, 20000)  # of each place, tops from the floor up to a slope of 20°
        tops = (1 - along * numpy.tan(numpy.radians(20))) * below
        angle = line_of_tops(along, across, tops, numpy.linspace(0, 1, 21))
        self.assertAlmostEqual(angle, -20, delta=0.5)

    def test_crater(self):
        values = numpy.array([1.0, 2, 5])
        self.assertAlmostEqual(crater.power(values, (3 * values**0.4)[:, None])[0], 0.4, places=9)
        # By hand: 0.14/0.40403 · √(6000/1500) · 0.04^{2/3} · 0.216^{1/3}
        self.assertAlmostEqual(crater.uehara((0.15, 6000, 0.04), 0.216), 0.048632, places=5)

    def test_rise(self):
        time = numpy.arange(0, 8, 0.5)
        self.assertEqual(segregation.rise_time(time, numpy.where(time < 4, 0.3, 0.9)), 4 - segregation.SHAKEN)
        self.assertEqual(segregation.rise_time(time, numpy.full(16, 0.3)), numpy.inf)
        # A large sphere rises 10 mm/s among beads that rise 5 mm/s at the axis and stand elsewhere, in a bed 0.1 m high.
        beads = numpy.array([(x, 0.0, z) for x in (0.0, 0.02) for z in numpy.linspace(0, 0.1, 401)])
        positions = numpy.array([[(0, 0, 0.005 + 0.01 * t), *(beads + (beads[:, :1] == 0) * [0, 0, 0.005 * t])]
                                 for t in time])
        ball, around = segregation.speeds(time, positions)
        self.assertAlmostEqual(ball, 0.01, places=9)
        self.assertAlmostEqual(around, 0.005, places=9)


class Deck(unittest.TestCase):
    def test_frames_of_a_dump(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "log.lammps").write_text("timestep ${step}\ntimestep 0.0001\n")
            (folder / "frames.lammpstrj").write_text("".join(
                f"ITEM: TIMESTEP\n{step}\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\n"
                f"ITEM: ATOMS id type radius x y z\n1 1 0.005 0.1 0.2 {step}\n2 1 0.004 0.3 0.4 0.5\n"
                for step in (0, 50)))
            first, last = DeckRun(folder).spheres
        self.assertEqual((first.time, last.time), (0.0, 0.005))
        self.assertEqual(last.positions.tolist(), [[0.1, 0.2, 50], [0.3, 0.4, 0.5]])
        self.assertEqual(last.radii.tolist(), [0.005, 0.004])


class Page(unittest.TestCase):
    def test_verdict_is_that_of_the_mean(self):
        row = Row("angle", "22", "± 1", 21.0, 23.0, (20.0, 22.0, 25.5))
        self.assertTrue(row.within)
        self.assertFalse(row._replace(high=22.4).within)
        self.assertAlmostEqual(row.standard_error, 1.607, places=3)

    def test_a_row_that_is_only_told_is_not_counted(self):
        rows = [Row("angle", "22", "± 1", 21.0, 23.0, (25.5,)), told("speed", (numpy.float64(1.5), 2))]
        self.assertIsNone(rows[1].within)
        self.assertEqual(verdict_of({"drum": {"rows": [{"within": row.within} for row in rows]}}),
                         "Of 1 quantities 0 are within their tolerance; 1 are **outside**.")

    def test_digits_follow_the_error(self):
        self.assertEqual(with_error(0.96663, 0.0051), "0.9666 ± 0.0051")
        self.assertEqual(with_error(-1284.3, 21.0), "−1284 ± 21")


if __name__ == "__main__":
    unittest.main()
