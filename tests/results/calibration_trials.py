#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Calibrates against synthetic truths, and writes tests/results/calibration.md.

    tests/results/calibration_trials.py --talus build/talus [--jobs 2]

Friction and rolling friction are drawn from their ranges; runs with them, and with seeds of their own, stand for
experiments, whose mean gets a random error of measurement. What the calibration makes of it is compared with what was
drawn. All trials learn from the same runs. Runs go to build/calibration_trials, and are made only once.

Exit codes: 0 both values were inside their 95 % intervals in nine of ten trials, 1 they were not.
"""
import argparse
import dataclasses
import datetime
import subprocess
import sys
from pathlib import Path

import numpy

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "postprocess"))
from calibration.findings import find, values_of  # noqa: E402  found by the line above
from calibration.target import read_target  # noqa: E402
from sweeps.folder import make_folder  # noqa: E402
from sweeps.pool import run_all  # noqa: E402
from sweeps.request import Sweep  # noqa: E402
from sweeps.results import read_cases, setting  # noqa: E402

PAGE = ROOT / "tests/results/calibration.md"
TARGET = ROOT / "tests/sweeps/synthetic_target.toml"
TRIALS, SEED, FIRST_SEED = 20, 8, 2001
ENOUGH = 0.9


def truths(target):
    """The values of the unknown keys in each trial: one in each of equal parts of their ranges."""
    from scipy.stats import qmc

    return [[one.at(share, 4) for one, share in zip(target.unknown.values(), row)] for row in qmc.LatinHypercube(len(target.unknown), seed=SEED).random(TRIALS)]


def make_runs(target, arguments):
    """Cases by scene: of the calibration, and of the experiments, in order of trials and their repeats."""
    keys, drawn = list(target.unknown), truths(target)
    folders, experiments = {}, {}
    for name, sweep in target.sweeps.items():
        repeats = max(one.repeats for one in target.measured if one.scene == name)
        truth = Sweep(name=f"truth-{name}", scene=sweep.scene, fixed=sweep.fixed, kind="list", reports=False,
                      vary={key: [values[k] for values in drawn] for k, key in enumerate(keys) if key in sweep.vary}, seeds=list(range(FIRST_SEED, FIRST_SEED + repeats)))
        folders[name] = make_folder(sweep, arguments.out / name, arguments.talus, False)
        experiments[name] = make_folder(truth, arguments.out / truth.name, arguments.talus, False)
    if complaints := run_all(str(arguments.talus), arguments.jobs, [*folders.values(), *experiments.values()]):
        sys.exit(f"calibration_trials.py: {complaints[0]}")
    return tuple({name: read_cases(folder) for name, folder in some.items()} for some in (folders, experiments))


def experiment(one, cases, truth, chance):
    """A measurement of a trial: the mean of its runs, with the error of an instrument. Raises SystemExit where a run has no result."""
    here = [case for case in cases[one.scene] if all(setting(case.settings.get(key, str(value))) == value for key, value in truth.items())]
    _, used, values = values_of(one, here)
    if len(used) < one.repeats:
        sys.exit(f"calibration_trials.py: an experiment with {truth} has no {one.title}")
    return dataclasses.replace(one, value=float(numpy.mean(values) + chance.normal(0, one.error)))


def trial_row(target, found, truth):
    """Cells for each key, and whether all are inside."""
    cells, inside = [], []
    for k, value in enumerate(truth):
        median, low, high = (float(found.value(k, share)) for share in found.posterior.interval(k))
        inside.append(low <= value <= high)
        cells += [f"{value:.4g}", f"{median:.3g}", f"{low:.3g} to {high:.3g}{'' if inside[-1] else ' **outside**'}"]
    return cells, inside


def commit():
    told = subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=ROOT, capture_output=True, text=True, check=False).stdout.strip()
    changed = subprocess.run(["git", "status", "--porcelain", "core", "scenarios", "io", "app", "postprocess"], cwd=ROOT, capture_output=True, text=True, check=False).stdout
    return told + (" with changes" if changed else "")


def page(target, rows, counts, cpu, runs, widths):
    keys = list(target.unknown)
    head = ["trial", *(f"{key}{what}" for key in keys for what in (", true", ", median", ", 95 % interval"))]
    lines = ["| " + " | ".join(head) + " |", "|" + " --- |" * len(head)] + ["| " + " | ".join(row) + " |" for row in rows]
    measured = "".join(f"- `{one.scene}`: {one.sensor}.{one.name}, error {one.error:g} {one.unit}, mean of {one.repeats} experiments\n" for one in target.measured)
    each = "".join(f"- `{key}`: {count} of {len(rows)}; the intervals are {width:.2g} of its range wide on average\n" for key, count, width in zip(keys, counts[:-1], widths))
    return f"""# Calibration against synthetic truths

Written by `tests/results/calibration_trials.py --talus build/talus`, commit {commit()}, {datetime.date.today()}; the target is
[`synthetic_target.toml`](../sweeps/synthetic_target.toml). In each trial both keys are drawn from their ranges, runs with
seeds of their own stand for experiments, and their means get errors of measurement:

{measured}
All trials learn from the same {runs[0]} runs; the experiments are {runs[1]} more. All runs together took {cpu:.0f} s of processor time.

True values inside their 95 % intervals, **both in {counts[-1]} of {len(rows)} trials**:

{each}
{chr(10).join(lines)}
"""


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--talus", type=Path, required=True)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--out", type=Path, default=ROOT / "build/calibration_trials")
    arguments = parser.parse_args()
    arguments.talus = arguments.talus.resolve()
    target = read_target(TARGET)
    learnt, made = make_runs(target, arguments)
    chance = numpy.random.default_rng(SEED)
    rows, insides, widths = [], [], []
    for trial, truth in enumerate(truths(target)):
        here = dataclasses.replace(target, measured=[experiment(one, made, dict(zip(target.unknown, truth)), chance) for one in target.measured])
        found = find(here, learnt)
        cells, inside = trial_row(target, found, truth)
        rows.append([str(trial + 1), *cells])
        insides.append(inside)
        widths.append([found.posterior.interval(k)[2] - found.posterior.interval(k)[1] for k in range(len(truth))])
        print(" ".join(rows[-1]), f"chance of the misfit {found.chance():.2g}", flush=True)
    counts = [sum(column) for column in zip(*insides)] + [sum(map(all, insides))]
    every = [case for some in (*learnt.values(), *made.values()) for case in some]
    cpu = sum(case.at(("timing", "cpu")) or 0 for case in every)
    PAGE.write_text(page(target, rows, counts, cpu, [sum(map(len, one.values())) for one in (learnt, made)], numpy.mean(widths, axis=0)), encoding="utf-8")
    sys.exit(0 if counts[-1] >= ENOUGH * TRIALS else 1)


if __name__ == "__main__":
    main()
