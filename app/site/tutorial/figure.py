#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the mass that has left the bin over time, a line for each run: figure.py RUN…"""
import csv
import json
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot

figure, axes = pyplot.subplots(figsize=(6, 4), layout="constrained")
for run in map(Path, sys.argv[1:]):
    rows = list(csv.DictReader((run / "metrics.csv").open()))
    flow = json.loads((run / "summary.json").read_text())["sensors"]["outlet"]["mass_flow"]
    label = f"friction {run.name}: {flow['value']:.2f} ± {flow['spread']:.2f} kg/s"
    times = [float(row["time_s"]) for row in rows]
    axes.plot(times, [float(row["outlet_passed_mass_kg"]) for row in rows], label=label)
axes.set(xlabel="time [s]", ylabel="mass that has left [kg]")
axes.legend()
figure.savefig("figure.png", dpi=150)
