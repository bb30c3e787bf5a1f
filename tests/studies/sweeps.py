#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Counts the sweeps that a step of a bed at rest, of a column and of a flow takes: from the impulses of the step before
or from zero, with under- and overrelaxation, with other local solves.

    tests/studies/sweeps.py                 prints the table; a few minutes

Each problem is dumped by `talus dump` and solved by `talus solve`; a count with ">" stopped at the cap.

Exit codes: 0 done; 2 the call is wrong; 5 talus failed.
"""
import argparse
import re
import subprocess
import sys
import tempfile
from pathlib import Path

CAP = 20000
TOLERANCES = ("1e-2", "1e-4", "1e-6")
PROBLEMS = {
    "column of 20 layers at rest": ["tests/validation/scenes/tube.toml", "--set", "fill.0.count=320", "--at", "1.5"],
    "2500 beads at rest in a hopper": ["hopper", "--set", "fill.0.count=2500", "--at", "0.7"],
    "2500 beads flowing": ["hopper", "--set", "fill.0.count=2500", "--set", "wall.gate.remove_at=0.4", "--at", "0.8"],
}
WARM = ["--guess", "1"]
WAYS = {
    "as Talus does: normal first, from the last step's impulses": WARM,
    "from zero": [],
    "relaxation 0.8": [*WARM, "--omega", "0.8"],
    "relaxation 1.2": [*WARM, "--omega", "1.2"],
    "relaxation 1.4": [*WARM, "--omega", "1.4"],
    "relaxation 1.5": [*WARM, "--omega", "1.5"],
    "relaxation 1.7": [*WARM, "--omega", "1.7"],
    "relaxation 1.8": [*WARM, "--omega", "1.8"],
    "symmetric sweeps": [*WARM, "--order", "symmetric"],
    "block of three rows, the note's (18)-(19)": [*WARM, "--local", "block"],
    "sliding, the note's (20)-(21)": [*WARM, "--local", "sliding"],
    "scalar, the note's (22)": [*WARM, "--local", "scalar"],
}


def call(talus, *arguments):
    done = subprocess.run([talus, *arguments], capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1):  # 1: the tolerance was not met
        print(f"sweeps.py: {' '.join(map(str, arguments))}: {done.stderr.strip()}", file=sys.stderr)
        sys.exit(5)
    return done


def sweeps(talus, problem, tolerance, way):
    done = call(talus, "solve", problem, "--tolerance", tolerance, "--max-sweeps", str(CAP), *way)
    count = re.search(r"^sweeps: (\d+)", done.stdout, re.MULTILINE).group(1)
    return count if done.returncode == 0 else f"> {count}"


def main():
    parser = argparse.ArgumentParser(description="Counts the sweeps of single steps.")
    parser.add_argument("--talus", default="build/talus", metavar="PROGRAM", help="default: %(default)s")
    talus = parser.parse_args().talus
    with tempfile.TemporaryDirectory() as place:
        for title, what in PROBLEMS.items():
            problem = Path(place) / "problem.hdf5"
            call(talus, "dump", *what, "-o", problem, "--quiet")
            print(f"\n| {title} | " + " | ".join(f"ε = {t}" for t in TOLERANCES) + " |")
            print("| --- |" + " --- |" * len(TOLERANCES))
            for name, way in WAYS.items():
                counts = (sweeps(talus, problem, tolerance, way) for tolerance in TOLERANCES)
                print(f"| {name} | " + " | ".join(counts) + " |", flush=True)
            problem.unlink()


if __name__ == "__main__":
    main()
