#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The gate: what is run before a change of the program's results lands. Writes tests/results/gate.md and gate.json.

    tests/gate/run.py            all
    tests/gate/run.py --before   all, and keeps what it finds as *before*, too
    tests/gate/run.py --list     names of jobs, with the CPU seconds that they took the last time

As many jobs at a time as there are processors, each on one thread. What is there from the same program is not run
again, so that what was broken off goes on where it was.

Exit codes: 0 nothing fails that did not fail before; 1 something does, or a job has failed; 2 the call is wrong.
"""
import argparse
import concurrent.futures
import datetime
import json
import os
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / folder) for folder in (
    "tests/gate", "tests/hard", "tests/validation", "tests/support", "postprocess")]
from jobs import RESULTS, all_jobs  # noqa: E402  found by the line above
from making import RunFailed  # noqa: E402
from gate_page import judged, page  # noqa: E402
from gate_rows import all_rows  # noqa: E402
from source import commit, processor, source_of  # noqa: E402

STORE = ROOT / "tests/results/gate.json"


def run_jobs(jobs, seconds, at_once):
    """What jobs found by their names, their CPU seconds, and how many failed; those that took longest begin first."""
    found, took, failed = {}, {}, 0
    with concurrent.futures.ThreadPoolExecutor(at_once) as pool:
        order = sorted(jobs, key=lambda name: -seconds.get(name, 1e9))
        pending = {pool.submit(*jobs[name]): name for name in order}
        for future in concurrent.futures.as_completed(pending):
            name = pending[future]
            try:
                found[name], took[name] = future.result()
                print(f"[{len(found)}/{len(jobs)}] {name}: {took[name]:.1f} s", flush=True)
            except RunFailed as error:
                failed += 1
                print(error, file=sys.stderr)
    return found, took, failed


class Clock:
    """Wall minutes that the gate took with one program, however often it was broken off."""

    def __init__(self, program):
        self.path, self.program, self.began = RESULTS / "minutes.json", program, time.monotonic()

    def minutes(self):
        kept = json.loads(self.path.read_text()) if self.path.is_file() else {}
        earlier = kept["minutes"] if kept.get("program") == self.program else 0.0
        return earlier + (time.monotonic() - self.began) / 60

    def keep(self):
        """Adds what has gone by since it was made, or kept the last time."""
        minutes, self.began = self.minutes(), time.monotonic()
        RESULTS.mkdir(parents=True, exist_ok=True)
        self.path.write_text(json.dumps({"program": self.program, "minutes": minutes}))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--before", action="store_true", help="keep what is found as what later runs are held against")
    parser.add_argument("--list", action="store_true", help="names of jobs and their seconds")
    parser.add_argument("--build", type=Path, default=ROOT / "build", help="the build whose programs are run")
    parser.add_argument("--commit", help="that this build is of, where the folder that it was made from is at another by now")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    arguments = parser.parse_args()
    build = arguments.build.resolve()
    store = json.loads(STORE.read_text()) if STORE.is_file() else {}
    seconds = store.get("took", {})
    jobs = all_jobs(build)
    if arguments.list:
        print("\n".join(f"{seconds.get(name, 0):7.1f}  {name}" for name in jobs))
        return 0

    os.environ["GOMP_SPINCOUNT"] = "2000"  # idle threads leave the processor to others
    clock = Clock(f"{(build / 'talus').stat().st_mtime}")
    try:
        found, took, failed = run_jobs(jobs, seconds, arguments.jobs)
    finally:
        clock.keep()
    rows, missing = all_rows(build, found)
    now = {"commit": arguments.commit or commit(source_of(build)), "processor": processor(),
           "date": datetime.date.today().isoformat(), "minutes": clock.minutes(), "seconds": sum(took.values()), "missing": missing,
           "rows": [row._asdict() for row in rows]}
    before = now if arguments.before else store.get("before")
    store = {**({"before": before} if before else {}), "now": now}
    STORE.write_text(json.dumps({**store, "took": took}, indent=1, ensure_ascii=False) + "\n")
    STORE.with_suffix(".md").write_text(page(store), encoding="utf-8")
    new = [row.key for row, _, said in judged(now, before or {}) if said == "fails"]
    for key in new:
        print(f"fails: {key}")
    print(f"{STORE.with_suffix('.md')} is written; {len(new)} rows fail that did not before")
    return int(bool(new or missing or failed))


if __name__ == "__main__":
    sys.exit(main())
