# SPDX-License-Identifier: GPL-3.0-or-later
"""What the gate runs, each on one thread: hard cases, runs of validation cases, and measurements with the Python module.
What is there from the same program is not run again."""
import json
import re
import subprocess
from pathlib import Path
from typing import NamedTuple

from hard_cases import case_names, checksum_of, run_case
from making import ROOT, RunFailed, make
from source import digest_of

from beds import FLOWS
from bulk import BULKS

RESULTS = ROOT / "build/gate"
BEDS = Path(__file__).parent / "beds.py"
HARD = ("5 ", "8 ", "9 ", "15 ", "32 ", "33 a load on a bed of 20 layers", "33 a lid", "36 ", "37 ")  # how names begin
SEEDS = (1, 2, 3)
MORE_SEEDS = (1, 2, 3, 4, 5)  # where a bed in which a grain slips moves a thousand times as much as others
LAWS = ("matched", "projected")


class Bed(NamedTuple):
    """A measurement of beds.py."""
    kind: str
    scene: str
    law: str
    seed: int

    @property
    def name(self):
        return "_".join(map(str, self))


MEASURED = [*(Bed("flow", scene, "matched", seed) for scene in FLOWS for seed in SEEDS),
            *(Bed("rest", "box", law, seed) for law in LAWS for seed in MORE_SEEDS),
            *(Bed("rest", "pile", "matched", seed) for seed in MORE_SEEDS),
            *(Bed("rest", f"column_{count}", law, 1) for count in (20, 100) for law in LAWS)]


def hard_cases(build):
    """Of this build, in the order of their numbers."""
    names = [name for name in case_names(build / "test_hard") if name.startswith(HARD)]
    return sorted(names, key=lambda name: (int(re.match(r"\d+", name)[0]), name))


def run_hard(build, name):
    """The rows of a hard case, and its CPU seconds."""
    folder = RESULTS / "hard"
    folder.mkdir(parents=True, exist_ok=True)
    rows, _ = run_case(str(build / "test_hard"), folder, name, checksum_of(build / "test_hard"))
    return rows, float(rows[0][4])


def run_bulk(build, run):
    """A run of a validation case, and its CPU seconds. Raises RunFailed."""
    made = make(build / "talus", run)
    return made, made.summary()["timing"]["cpu"]


def module_checksum(build):
    return digest_of([BEDS, *sorted((build / "python/talus").glob("_core.*.so")),
                      *sorted((ROOT / "scenarios").glob("*.[ts]*l"))])


def measure_bed(build, bed):
    """What beds.py found, and its CPU seconds. Raises RunFailed."""
    path, made_of = RESULTS / f"{bed.name}.json", module_checksum(build)
    if path.is_file():
        stored = json.loads(path.read_text())
        if stored["made_of"] == made_of:
            return stored["found"], stored["found"]["seconds"]
    done = subprocess.run(["/usr/bin/python3", BEDS, build / "python", *map(str, bed)], capture_output=True, text=True)
    if done.returncode:
        raise RunFailed(f"{bed.name} ended with {done.returncode}: {done.stderr[-500:]}")
    found = json.loads(done.stdout)
    RESULTS.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps({"made_of": made_of, "found": found}))
    return found, found["seconds"]


def all_jobs(build):
    """By a name, a function that runs it and returns what it found and CPU seconds."""
    runs = {run.name: run for bulk in BULKS for run in bulk.runs}
    return {**{f"hard case {name}": (run_hard, build, name) for name in hard_cases(build)},
            **{name: (run_bulk, build, run) for name, run in runs.items()},
            **{bed.name: (measure_bed, build, bed) for bed in MEASURED}}
