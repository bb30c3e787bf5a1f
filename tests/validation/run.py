#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the cases of bulk physics and writes tests/results/validation.md, with a figure for each.

    tests/validation/run.py                 all cases
    tests/validation/run.py gas packings    those with one of these words in the name of their file

A case is a file of cases/. Runs go to build/validation, two at a time on one thread each; cases may share them. A run
that is there, of the same scene with the same program, is not made again, so that what was broken off goes on where it
was. Cases that are not asked for, or that want LAMMPS or LIGGGHTS where these are not installed
(tests/benchmarks/peers/install), keep what tests/results/validation.json has of them.

Exit codes: 0 done, whatever the verdicts; 1 a run failed; 2 the call is wrong.
"""
import argparse
import concurrent.futures
import datetime
import importlib
import json
import os
import sys
from pathlib import Path

import matplotlib

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(Path(__file__).parent), str(ROOT / "postprocess"), str(ROOT / "tests/support")]
from cases import CASES  # noqa: E402  found by the line above
from deck import program_of  # noqa: E402
from making import RunFailed, make  # noqa: E402
from page import VERDICTS, write_page  # noqa: E402
from source import commit  # noqa: E402

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402  after the choice of a backend without a screen

STORE = ROOT / "tests/results/validation.json"


def judge(name, case, runs):
    """The rows of a case and what its runs took, as they are kept; its figure is drawn beside the page."""
    figure = pyplot.figure(figsize=(6.4, 4.0), layout="constrained")
    case.draw(figure, runs)
    path = STORE.parent / "validation" / f"{name}.png"
    path.parent.mkdir(exist_ok=True)
    figure.savefig(path, dpi=100)
    pyplot.close(figure)
    rows = [dict(row._asdict(), mean=row.mean, standard_error=row.standard_error, within=row.within)
            for row in case.judge(runs)]
    for row in rows:
        print(f"{name}: {row['what']}: {row['mean']:.4g} ± {row['standard_error']:.2g}, "
              f"[{row['low']:.4g}, {row['high']:.4g}]: {VERDICTS[row['within']]}", flush=True)
    summaries = {run: runs[run].summary() for run in runs}
    return {"rows": rows, "seconds": {run: summary["timing"]["cpu"] for run, summary in summaries.items()},
            "spheres": max(summary["ledger"]["inserted"] for summary in summaries.values()), "commit": commit(),
            "date": datetime.date.today().isoformat()}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("words", nargs="*")
    parser.add_argument("--talus", type=Path, default=ROOT / "build/talus")
    parser.add_argument("--jobs", type=int, default=2)
    arguments = parser.parse_args()
    names = [name for name in CASES if not arguments.words or any(word in name for word in arguments.words)]
    if not names:
        parser.error(f"no case has {' or '.join(arguments.words)} in its name; there are {', '.join(CASES)}")
    cases = {name: importlib.import_module(f"cases.{name}") for name in names}
    for name, case in list(cases.items()):
        missing = {run.program for run in case.RUNS if run.program and not program_of(run.program)}
        if missing:
            print(f"{name}: skipped, there is no {' and no '.join(sorted(missing))} here")
            del cases[name]
    os.environ["GOMP_SPINCOUNT"] = "2000"  # idle threads leave the processor to others
    talus = arguments.talus.resolve()
    failures = []
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        pending = {}
        for run in (run for case in cases.values() for run in case.RUNS):
            if run.name not in pending:
                pending[run.name] = pool.submit(make, talus, run)
        for name, case in cases.items():
            try:
                found = judge(name, case, {run.name: pending[run.name].result() for run in case.RUNS})
                stored = dict(json.loads(STORE.read_text()) if STORE.is_file() else {}, **{name: found})
                STORE.write_text(json.dumps(stored, indent=1, ensure_ascii=False) + "\n")
                write_page(stored)
            except RunFailed as error:
                failures.append(str(error))
                print(error, file=sys.stderr)
    sys.exit(bool(failures))


if __name__ == "__main__":
    main()
