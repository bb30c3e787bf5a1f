#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the benchmarks and writes tests/results/benchmarks.md from what they gave.

    tests/benchmarks/report.py            sweeps, steps, search and files on beds of up to 250 000 spheres
    tests/benchmarks/report.py large      the same and beds of a million
    tests/benchmarks/report.py peers      the silos and the pile of peers/ in Talus, LAMMPS and LIGGGHTS
    tests/benchmarks/report.py page       only writes the page again

tests/run benchmarks builds what is missing first, and passes its words on. Figures are kept in
tests/results/benchmarks.json, those of steps and those of peers apart, each with the commit and the machine.

Exit codes: 0 done; 1 a benchmark failed; 2 the call is wrong.
"""
import datetime
import json
import os
import re
import subprocess
import sys
from pathlib import Path

from page import page

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/results"))
from rows import ResultsError  # noqa: E402  after its folder was named
from write import commit_of, machine  # noqa: E402

BUILD = ROOT / "build"
STORE = ROOT / "tests/results/benchmarks.json"
PAGE = ROOT / "tests/results/benchmarks.md"
GOOGLE_BENCHMARKS_OWN = {"repetitions", "repetition_index", "threads", "iterations", "real_time", "cpu_time",
                         "family_index", "per_family_instance_index"}


def instruction_sets():
    text = Path("/proc/cpuinfo").read_text(encoding="utf-8")
    flags = set(re.search(r"^flags\s*:(.*)$", text, re.MULTILINE)[1].split())
    return [name for name, flag in (("AVX-512", "avx512f"), ("AVX2", "avx2")) if flag in flags]


def run(command, what):
    """Idle threads leave the processor to others, as those of the program do."""
    environment = {**os.environ, "GOMP_SPINCOUNT": "2000", "GLIBC_TUNABLES": "glibc.malloc.hugetlb=1"}
    environment.pop("OMP_NUM_THREADS", None)
    if subprocess.run(list(map(str, command)), cwd=ROOT, env=environment, check=False).returncode:
        raise ResultsError(f"{what} failed.")


def run_steps(large):
    """The counters of each benchmark by its name."""
    told = BUILD / "benchmarks/steps.json"
    told.parent.mkdir(parents=True, exist_ok=True)
    which = [] if large else ["--benchmark_filter=-_1M"]
    run([BUILD / "benchmark_step", f"--benchmark_out={told}", *which], "benchmark_step")
    figures = {}
    for one in json.loads(told.read_text(encoding="utf-8"))["benchmarks"]:
        name = re.sub(r"/(iterations:\d+|manual_time)", "", one["name"])
        figures[name] = {key: float(f"{value:.5g}") for key, value in one.items()
                         if isinstance(value, (int, float)) and key not in GOOGLE_BENCHMARKS_OWN}
    return {"figures": figures}


def run_peers():
    told = BUILD / "benchmarks/peers.json"
    told.parent.mkdir(parents=True, exist_ok=True)
    run([sys.executable, ROOT / "tests/benchmarks/peers/run.py", "--talus", BUILD / "talus", "--folder",
         BUILD / "benchmarks/peers", "--json", told], "peers/run.py")
    return json.loads(told.read_text(encoding="utf-8"))


def main():
    words = sys.argv[1:]
    if words not in ([], ["large"], ["peers"], ["page"]):
        print(__doc__, file=sys.stderr)
        return 2
    store = json.loads(STORE.read_text(encoding="utf-8")) if STORE.exists() else {}
    if words != ["page"]:
        part = "peers" if words == ["peers"] else "steps"
        try:
            commit = commit_of(BUILD / "talus")
            found = run_peers() if part == "peers" else run_steps(words == ["large"])
        except ResultsError as error:
            print(f"report.py: {error}", file=sys.stderr)
            return 1
        store[part] = {"commit": commit, "machine": machine(), "instruction_sets": instruction_sets(),
                       "date": datetime.date.today().isoformat(), **found}
        STORE.write_text(json.dumps(store, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    PAGE.write_text(page(store), encoding="utf-8")
    if words in (["peers"], ["page"]) and "peers" in store:
        from front import draw_front  # needs Matplotlib, which figures of steps do not
        draw_front(store["peers"]["rows"], PAGE.with_name("front.svg"))
    return 0


if __name__ == "__main__":
    sys.exit(main())
