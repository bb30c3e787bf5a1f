#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the figures of scenarios/SCALING.md: what threads bring, and what sweeps cost beside their runs.

    tests/results/scaling.py --talus build/talus [--page]       --page: only what tests/results/benchmarks.json holds

Seconds are of the processor, so that others on the machine do not count; each is the median of three, in turn. What two
threads bring by the clock comes from benchmarks.json, which was measured on a quiet machine.
"""
import argparse
import datetime
import json
import os
import re
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "scenarios/SCALING.md"
BENCHMARKS = ROOT / "tests/results/benchmarks.json"
BEDS = ("flow_4k", "flow_32k", "flow_250k", "flow_1M")
REPEATS = 3
SWEEP = """
scene = "hopper"
seeds = {seeds}
reports = false
[set]
fill.0.count = 20
fill.0.region.height = 0.02
wall.gate.remove_at = 0.01
time.duration = 0.02
time.frame_interval = 0.02
[vary]
contact.glass-glass.friction = [0.3]
"""


def cpu_of(*words):
    """Processor time of a command with all that it starts [s]."""
    process = subprocess.Popen([str(word) for word in words], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if status:
        sys.exit(f"scaling.py: {' '.join(map(str, words))} failed")
    return usage.ru_utime + usage.ru_stime


def threads_table():
    stored = json.loads(BENCHMARKS.read_text())["steps"]
    rows = []
    for bed in BEDS:
        one = stored["figures"][f"steps/{bed}"]
        cells = [f"{one['spheres']:,.0f}", *(f"{one[key]:,.0f}" if one[key] >= 100 else f"{one[key]:.3g}" for key in ("step_ms", "step_ms_two_threads")),
                 f"{one['gain_of_two_threads']:.2f}"]
        rows.append("| " + " | ".join(cells).replace(",", "\u202f") + " |")
    head = "| spheres in flow | ms a step, one thread | two threads, by the clock | gain |\n| ---: | ---: | ---: | ---: |\n"
    return f"{head}{chr(10).join(rows)}\n\n(commit {stored['commit']}, {stored['date']}, {stored['machine']}; from [benchmarks](../tests/results/benchmarks.md))"


def hopper_cpu(talus, folder, beads, threads):
    return cpu_of(talus, "run", "hopper", "--force", "--quiet", "--threads", threads, "--until", 0.3, "--set", f"fill.0.count={beads}", "-o", folder / "hopper")


def threads_cost(talus, folder):
    rows = []
    for beads in (300, 3000):
        seconds = {1: [], 2: []}
        for _ in range(REPEATS):
            for threads, found in seconds.items():
                found.append(hopper_cpu(talus, folder, beads, threads))
        one, two = (statistics.median(found) for found in seconds.values())
        rows.append(f"| {beads} | {one:.2g} | {two:.2g} | {two / one:.2f} |")
    return "| beads of a hopper, 0.3 s | CPU s, one thread | CPU s, two threads | ratio |\n| ---: | ---: | ---: | ---: |\n" + "\n".join(rows)


def sweep_cost(talus, folder):
    """What stands beside the runs themselves: a case that is settled, and the tables and page of many."""
    lines = []
    for seeds in (8, 64):
        file = folder / f"cases{seeds}.toml"
        file.write_text(SWEEP.format(seeds=seeds))
        out = folder / f"cases{seeds}"
        first = cpu_of(talus, "sweep", file, "--out", out, "--quiet")
        cpu_of(talus, "sweep", file, "--out", out, "--quiet", "--jobs", 2)
        again = statistics.median(cpu_of(talus, "run", out, "--case", 1, "--quiet") for _ in range(REPEATS))
        tables = statistics.median(cpu_of(talus, "gather", out) for _ in range(REPEATS))
        lines.append(f"| {seeds} | {first:.2g} | {again:.2g} | {tables:.2g} |")
    return "| cases | making them, CPU s | asking a case that is settled | tables and page |\n| ---: | ---: | ---: | ---: |\n" + "\n".join(lines)


def replace_block(text, name, block):
    begin, end = f"<!-- {name}: tests/results/scaling.py -->", f"<!-- end of {name} -->"
    if begin not in text:
        sys.exit(f"scaling.py: {PAGE} has no place for {name}")
    return re.sub(re.escape(begin) + ".*?" + re.escape(end), lambda _: f"{begin}\n{block}\n{end}", text, flags=re.S)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--talus", type=Path, required=True)
    parser.add_argument("--page", action="store_true")
    arguments = parser.parse_args()
    talus = arguments.talus.resolve()
    text = replace_block(PAGE.read_text(encoding="utf-8"), "threads", threads_table())
    if not arguments.page:
        commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.strip()
        stamp = f"(commit {commit}, {datetime.date.today()}; with others on the machine {os.getloadavg()[1]:.0f} processes wanted its {os.cpu_count()} cores)"
        with tempfile.TemporaryDirectory() as name:
            text = replace_block(text, "cost of threads", f"{threads_cost(talus, Path(name))}\n\n{stamp}")
            text = replace_block(text, "cost of sweeps", f"{sweep_cost(talus, Path(name))}\n\n{stamp}")
    PAGE.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
