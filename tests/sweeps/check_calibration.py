#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks calibration on results that are made up, whose posterior is known, and once from runs to the page.

    tests/sweeps/check_calibration.py TALUS

What it finds from real runs: tests/results/calibration_trials.py.
Skipped where scikit-learn is not installed.
Exit codes: 0 all is well or skipped, 1 it is not.
"""
import dataclasses
import importlib.util
import json
import sys
import tempfile
from pathlib import Path
from types import SimpleNamespace

import numpy
from small_sweep import call, skip

from calibration.findings import find
from calibration.target import read_target
from sweeps.design import unit_points

TARGET = """
title = "Two numbers"
[unknown]
a.x = { from = 0, to = 10 }
a.y = { from = 1, to = 100, scale = "log" }
[design]
samples = 40
[[measured]]
scene = "hopper"
quantity = "s.sum"
value = 0
error = 0.3
unit = "m"
[[measured]]
scene = "hopper"
quantity = "s.difference"
value = 0
error = 0.2
"""
REAL = """
seeds = 1
[set]
fill.0.count = 60
fill.0.region.height = 0.05
wall.gate.remove_at = 0.1
time.duration = 0.4
time.frame_interval = 0.4
sensor.outlet.from = 0.2
sensor.outlet.to = 0.35
[unknown]
contact.glass-glass.friction = { from = 0.1, to = 0.9 }
[design]
samples = 8
[[measured]]
scene = "hopper"
quantity = "outlet.mass_flow"
value = 0.2
error = 0.1
unit = "kg/s"
"""
SCATTER = 0.2


def made_up(x, y, chance):
    """What a run finds: x + l and x − l of l = 5 log10 y, with scatter."""
    l = 5 * numpy.log10(y)
    return {("s", "sum"): {"value": x + l + chance.normal(0, SCATTER), "unit": "m"}, ("s", "difference"): {"value": x - l + chance.normal(0, SCATTER), "unit": "m"}}


def check_known(folder):
    """The intervals are those of the normal distribution that can be written down."""
    path = folder / "two.toml"
    path.write_text(TARGET)
    target = read_target(path)
    chance = numpy.random.default_rng(1)
    cases = []
    for first, second in unit_points("sobol", 2, 40, 1):
        x, y = 10 * first, 100**second
        cases.append(SimpleNamespace(settings={"a.x": repr(float(x)), "a.y": repr(float(y))}, found=made_up(x, y, chance)))
    for case in cases:
        case.quantities = lambda case=case: case.found
    x, y = 4.0, 20.0
    l = 5 * numpy.log10(y)
    measured = [dataclasses.replace(one, value=value) for one, value in zip(target.measured, (x + l, x - l))]
    found = find(dataclasses.replace(target, measured=measured), {"hopper": cases})
    for emulator in found.emulators:
        assert 0.6 * SCATTER < emulator.scatter < 1.6 * SCATTER, f"the scatter of runs is {emulator.scatter}, not {SCATTER}"
    # The sum and the difference of two normal numbers, each with the measurement's error and a run's scatter.
    deviation = 0.5 * numpy.sqrt(0.3**2 + 0.2**2 + 2 * SCATTER**2)
    for k, (truth, half) in enumerate(((x / 10, 1.96 * deviation / 10), (numpy.log10(y) / 2, 1.96 * deviation / 10))):
        median, low, high = found.posterior.interval(k)
        assert abs(median - truth) < half and 0.8 * half < 0.5 * (high - low) < 1.7 * half, f"key {k}: {median} from {low} to {high}, not {truth} ± {half}"
    assert found.chance() > 0.05, "measurements that agree are said not to"
    apart = [dataclasses.replace(measured[0], value=60.0), measured[1]]
    assert find(dataclasses.replace(target, measured=apart), {"hopper": cases}).chance() < 0.01, "measurements that cannot be met are told to be"


def check_complaints(talus, folder):
    for text, sentence in ((TARGET.replace("s.sum", "sum"), "a sensor and what it finds"), (TARGET.replace("error = 0.3", "error = 0"), "a standard deviation above 0"),
                           (TARGET.replace("a.x = { from = 0, to = 10 }", "a.x = [1]"), "must be a range"), (TARGET.split("[[measured]]")[0], "[[measured]]"),
                           (TARGET.replace("scene =", "szene ="), "unknown key 'szene'")):
        path = folder / "wrong.toml"
        path.write_text(text)
        told = call(talus, "calibrate", path, code=2, cwd=folder)
        assert sentence in told and told.count("\n") == 1, f"instead of '{sentence}': {told}"
    assert not (folder / "out").exists()


def check_whole(talus, folder):
    """From a file to a page; given again with another measurement it runs nothing again."""
    path = folder / "real.toml"
    path.write_text(REAL)
    assert "8 of 8 runs are missing" in call(talus, "calibrate", path, "--out", folder / "real", code=1)
    call(talus, "calibrate", path, "--out", folder / "real", "--jobs", 2, "--quiet")
    told = json.loads((folder / "real/calibration.json").read_text())
    one = told["unknown"]["contact.glass-glass.friction"]
    assert 0.1 <= one["interval_95"][0] < one["median"] < one["interval_95"][1] <= 0.9, told
    assert "contact.glass-glass.friction" in (folder / "real/calibration.html").read_text(encoding="utf-8")
    times = [summary.stat().st_mtime_ns for summary in sorted(folder.rglob("summary.json"))]
    first = (folder / "real/calibration.json").read_bytes()
    call(talus, "calibrate", path, "--out", folder / "real", "--quiet")
    assert (folder / "real/calibration.json").read_bytes() == first, "the same runs give another calibration"
    path.write_text(REAL.replace("error = 0.1", "error = 0.05"))
    call(talus, "calibrate", path, "--out", folder / "real", "--quiet")
    assert (folder / "real/calibration.json").read_bytes() != first
    assert times == [summary.stat().st_mtime_ns for summary in sorted(folder.rglob("summary.json"))]
    path.write_text(REAL.replace("outlet.mass_flow", "outlet.mass_flaw"))
    assert "it finds outlet.mass_flow" in call(talus, "calibrate", path, "--out", folder / "real", code=2)


def main():
    if not importlib.util.find_spec("sklearn"):
        skip("there is no python3-sklearn")
    talus = Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as name:
        check_known(Path(name))
        check_complaints(talus, Path(name))
        check_whole(talus, Path(name))


if __name__ == "__main__":
    main()
