#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of tests/results/local_solves.md: how far each local solve gets on the problems of tests/data/fclib.

    tests/benchmarks/local_solves.py [--sweeps 2500] [--talus build/talus]

A cell has the sweeps after which the residual is first at most 1e-2, 1e-4, 1e-6 and 1e-8, by `talus solve --history`
from zero in natural order; where the last of them is not reached, what is left after all sweeps stands in brackets.
"""
import argparse
import csv
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
LOCAL_SOLVES = ["block", "sliding", "scalar", "sequential"]
RESIDUALS = [1e-2, 1e-4, 1e-6, 1e-8]


def residuals(talus, problem, local, sweeps):
    """The residual after each sweep, up to the smallest that is asked for."""
    with tempfile.TemporaryDirectory() as folder:
        history = pathlib.Path(folder) / "history.csv"
        command = [talus, "solve", problem, "--local", local, "--max-sweeps", str(sweeps),
                   "--tolerance", str(RESIDUALS[-1] / 2), "--history", history, "--quiet"]
        subprocess.run(command, stderr=subprocess.DEVNULL, check=False)  # 1: not met, which is what the table is about
        with open(history, newline="", encoding="utf-8") as file:
            return [float(row["residual"]) for row in csv.DictReader(file)]


def cell(history):
    reached = []
    for wanted in RESIDUALS:
        sweep = next((k for k, residual in enumerate(history, 1) if residual <= wanted), None)
        if sweep is None:
            return " / ".join(reached + [f"– ({history[-1]:.0e})"])
        reached.append(str(sweep))
    return " / ".join(reached)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sweeps", type=int, default=2500)
    parser.add_argument("--talus", type=pathlib.Path, default=ROOT / "build/talus")
    arguments = parser.parse_args()
    print("| problem | " + " | ".join(f"`{local}`" for local in LOCAL_SOLVES) + " |")
    print("| --- |" + " --- |" * len(LOCAL_SOLVES))
    for problem in sorted((ROOT / "tests/data/fclib").glob("*.hdf5")):
        cells = [cell(residuals(arguments.talus, problem, local, arguments.sweeps)) for local in LOCAL_SOLVES]
        print(f"| {problem.stem} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
