#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the gate measures step by step with the Python module: how deep contacts of flows are and how many sweeps they
take, and how quiet beds at rest are. Prints one measurement as JSON.

    tests/gate/beds.py MODULE_FOLDER flow SCENE LAW SEED
    tests/gate/beds.py MODULE_FOLDER rest box|pile|column_N LAW SEED
"""
import json
import math
import sys
import tempfile
import time
import warnings
from pathlib import Path

import numpy

ROOT = Path(__file__).resolve().parents[2]
GRAVITY = 9.81

USUAL_STEP = 0.0072  # √(d/g), to whose time sweeps are counted, whatever the step

# Overrides, and how long; what settles first, the first three tenths, counts for what lands alone.
FLOWS = {"hopper": ({"fill.0.count": 1500, "wall.gate.remove_at": 0.3}, 0.8), "drum": ({"fill.0.count": 800}, 0.6),
         "pile_plain": ({}, 1.5), "vibrated_bed": ({}, 0.6)}
SETTLING = 0.3

# Of beds at rest: scene, overrides, when they have settled, for how long they are watched.
SMALL_BOX = {"fill.0.count": 700, "fill.0.region.max": [0.085, 0.085, 0.40], "wall.box.max": [0.085, 0.085, 0.42]}
RESTS = {"box": ("packing", SMALL_BOX, 0.9, 0.3), "pile": ("pile_plain", {"pour.0.count": 1200}, 3.0, 0.3)}
LIVELIEST = 0.02  # the share of spheres whose energy does not count: rattlers
WATCHED = 0.3  # s, the end of what a column is run
COLUMNS = {20: 1.0, 100: 1.5}  # for how long [s]; spheres in a stack
COLUMN = """title = "A column of {count} spheres"
[time]
duration = 10.0
[solver]
stabilisation = "{law}"
[materials.glass]
density = 2500.0
[[contact]]
between = ["glass", "glass"]
friction = 0.3
restitution = 0.5
[[fill]]
arrangement = "file"
file = "column.csv"
material = "glass"
[[wall]]
name = "floor"
shape = "plane"
material = "glass"
"""


def mean_diameter(simulation):
    return float(2 * simulation.radii().mean())


def flow(talus, name, law, seed):
    """Mean overlap [d], the worst at all [d], sweeps in the time of a usual step, and how many steps were split."""
    overrides, duration = FLOWS[name]
    simulation = talus.Simulation(str(ROOT / f"scenarios/{name}.toml"),
                                  {**overrides, "solver.stabilisation": law, "seed": seed}, threads=1)
    rows = []
    while simulation.time < duration:
        report = simulation.step()
        rows.append((simulation.time, report.mean_overlap, report.worst_overlap, report.sweeps, report.sub_steps > 1))
    time, overlap, worst, sweeps, split = numpy.array(rows).T
    flowing = time > SETTLING * duration
    d = mean_diameter(simulation)
    steps = USUAL_STEP * math.sqrt(2 * simulation.radii().min() / GRAVITY) / simulation.step_length
    return {"overlap": overlap[flowing].mean() / d, "worst": worst.max() / d, "sweeps": sweeps[flowing].mean() * steps,
            "split": split.sum()}


def energy_without_rattlers(simulation):
    """Kinetic energy of a sphere, mean of all but the liveliest [J]."""
    mass, radius = simulation.masses(), simulation.radii()
    energies = (0.5 * mass * (simulation.velocities()**2).sum(axis=1)
                + 0.2 * mass * radius**2 * (simulation.angular_velocities()**2).sum(axis=1))
    return numpy.sort(energies)[:math.ceil((1 - LIVELIEST) * len(energies))].mean()


def watch(simulation, window):
    """Overlap mean and worst [d], creep of the median grain [d/s], kinetic energy [m g d a grain], sweeps."""
    d, mass, ids, begin = mean_diameter(simulation), simulation.masses().mean(), simulation.ids(), simulation.time
    start = simulation.positions()[numpy.argsort(ids)]
    rows = []
    while simulation.time < begin + window:
        report = simulation.step()
        rows.append((report.mean_overlap, report.worst_overlap, energy_without_rattlers(simulation), report.sweeps))
    overlap, worst, energy, sweeps = numpy.array(rows).T
    gone = numpy.linalg.norm(simulation.positions()[numpy.argsort(simulation.ids())] - start, axis=1)
    return {"overlap": overlap.mean() / d, "worst": worst.max() / d, "creep": float(numpy.median(gone)) / d / window,
            "kinetic": energy.mean() / (mass * GRAVITY * d), "sweeps": sweeps.mean()}


def column(talus, count, law):
    """A stack of spheres that touch, on a floor, from its beginning on."""
    d = 0.01
    with tempfile.TemporaryDirectory() as folder:
        rows = "".join(f"0,0,{(k + 0.5) * d:.17g},{d / 2}\n" for k in range(count))
        Path(folder, "column.csv").write_text("x,y,z,radius\n" + rows)
        scene = Path(folder, "column.toml")
        scene.write_text(COLUMN.format(count=count, law=law))
        simulation = talus.Simulation(str(scene), threads=1)
    simulation.run(until=COLUMNS[count] - WATCHED)
    return watch(simulation, WATCHED)


def rest(talus, name, law, seed):
    if name.startswith("column_"):
        return column(talus, int(name.removeprefix("column_")), law)
    scene, overrides, settled, window = RESTS[name]
    simulation = talus.Simulation(str(ROOT / f"scenarios/{scene}.toml"),
                                  {**overrides, "solver.stabilisation": law, "seed": seed}, threads=1)
    simulation.run(until=settled)
    return watch(simulation, window)


def main():
    folder, kind, name, law, seed = sys.argv[1:]
    sys.path.insert(0, folder)
    import talus  # of the build that is asked for
    warnings.simplefilter("ignore")
    measured = {"flow": flow, "rest": rest}[kind](talus, name, law, int(seed))
    print(json.dumps({**{key: float(value) for key, value in measured.items()}, "seconds": time.process_time()}))


if __name__ == "__main__":
    main()
