#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the pictures of core/METHOD.md from runs: κ of a bead that is pressed and let go, and an impact that is handed
on along a row.

    tests/results/law.py [MODULE_FOLDER]     writes tests/results/law.svg
"""
import math
import sys
import tempfile
import warnings
from pathlib import Path

import matplotlib
import numpy

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "build" / "python"))
matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402
import talus  # noqa: E402

D = 0.01  # m
WEIGHT = 2500 * math.pi / 6 * D**3 * 9.81  # N
SCENE = """title = "Beads"
[time]
duration = 1.0
[world]
gravity = {gravity}
[materials.glass]
density = 2500.0
[[contact]]
between = ["glass", "glass"]
friction = 0.0
restitution = {restitution}
[[fill]]
arrangement = "file"
file = "beads.csv"
material = "glass"
[[wall]]
name = "floor"
shape = "plane"
material = "glass"
"""


def simulation(folder, beads, gravity, restitution):
    """Beads by rows of x, y, z, vx."""
    rows = "".join(f"{x!r},{y!r},{z!r},{D / 2},{vx!r},0,0\n" for x, y, z, vx in beads)
    Path(folder, "beads.csv").write_text("x,y,z,radius,vx,vy,vz\n" + rows, encoding="utf-8")
    scene = Path(folder, "beads.toml")
    scene.write_text(SCENE.format(gravity=gravity, restitution=restitution), encoding="utf-8")
    return talus.Simulation(str(scene), threads=1)


def loading_cycle(folder):
    """Time [s], overlap and κ [d] of a bead that begins inside a floor, and is then pressed, let go, and pressed again."""
    run = simulation(folder, [(0.0, 0.0, 0.496 * D, 0.0)], "[0, 0, -9.81]", 0.5)
    rows = []
    while run.time < 0.08:
        load = 200 * max(0.0, -math.sin(2 * math.pi * run.time / 0.04))
        run.set_force(0, [0, 0, -load * WEIGHT])
        run.step()
        contact = run.contacts()
        kappa = contact["compression"][0] if len(contact) else 0.0
        overlap = D / 2 - run.positions()[0][2]
        rows.append((run.time, overlap / D, max(0.0, kappa) / D))
    return numpy.array(rows).T


def cradle(folder):
    """Speeds of five beads by step, of which the first comes with 1 m/s and meets the others at rest."""
    beads = [(-1.3 * D, 0.0, 3 * D, 1.0)] + [(k * D, 0.0, 3 * D, 0.0) for k in range(4)]
    run = simulation(folder, beads, "[0, 0, 0]", 1.0)
    speeds = []
    for _ in range(24):
        run.step()
        speeds.append(run.velocities()[:, 0].copy())
    speeds = numpy.array(speeds)
    first = next(k for k, row in enumerate(speeds) if row[0] < 0.5)
    return speeds[max(0, first - 2):first + 6]


def main():
    warnings.simplefilter("ignore")
    with tempfile.TemporaryDirectory() as folder:
        time, overlap, kappa = loading_cycle(folder)
        speeds = cradle(folder)
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 3.4), layout="constrained")
    left.plot(1e3 * time, 1e3 * overlap, label="overlap −g")
    left.plot(1e3 * time, 1e3 * kappa, "--", label="compression κ")
    left.set(xlabel="time [ms]", ylabel="thousandths of d", title="A bead inside a floor, then pressed twice")
    left.legend(loc="upper left", bbox_to_anchor=(0.3, 1.0))
    for k, row in enumerate(speeds.T):
        right.step(range(len(row)), row, where="mid", label=f"bead {k + 1}")
    right.set(xlabel="step", ylabel="speed [m/s]", title="An impact, e = 1, on a row that touches")
    right.legend(loc="center right")
    figure.savefig(ROOT / "tests" / "results" / "law.svg", metadata={"Date": None})


if __name__ == "__main__":
    main()
