#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds the values of keys that give what was measured: what `talus calibrate` calls.

    postprocess/calibrate.py --talus build/talus glass.toml --jobs 2

Exit codes: as sweep.py; 1 where runs are missing.
"""
import json
import sys

from calibration.emulator import require_gaussian_processes
from calibration.findings import find
from calibration.page import calibration_page
from calibration.target import read_target
from read_run import RunError
from sweep import explained, parse_arguments, tell_ways
from run_page.writing import write_whole
from sweeps.folder import make_folder
from sweeps.gathering import gather
from sweeps.pool import run_all
from sweeps.results import read_cases

MARK = "target.toml"


def make_place(path, file):
    """The folder of a calibration, with a copy of what was asked for. Raises RunError where it holds something else."""
    if path.is_dir() and any(path.iterdir()) and not (path / MARK).is_file():
        raise RunError(f"{path}: the folder is not empty and holds no calibration; choose another with --out.")
    path.mkdir(parents=True, exist_ok=True)
    write_whole(path / MARK, file.read_text(encoding="utf-8"))


def tell(found, out):
    for key, one in found.as_dictionary()["unknown"].items():
        print(f"  {key:<40} {one['median']:.4g}, 95 % in {one['interval_95'][0]:.4g} to {one['interval_95'][1]:.4g}")
    print(f"{out / 'calibration.html'}, {out / 'calibration.json'}")


def main():
    arguments = parse_arguments("talus calibrate", "Finds the values of keys that give what was measured.")
    target = read_target(arguments.file)
    require_gaussian_processes()
    make_place(arguments.out, arguments.file)
    folders = {name: make_folder(sweep, arguments.out / name, arguments.talus, arguments.force) for name, sweep in target.sweeps.items()}
    complaints = run_all(arguments.talus, arguments.jobs, list(folders.values()), arguments.quiet) if arguments.jobs > 0 else []
    for complaint in complaints[:5]:
        print(f"calibrate.py: {complaint}", file=sys.stderr)
    cases = {name: read_cases(folder) for name, folder in folders.items()}
    missing = [name for name, some in cases.items() if any(case.state == "unfinished" for case in some)]
    if missing:
        if not arguments.quiet:
            print(f"{sum(case.state == 'unfinished' for some in cases.values() for case in some)} of {sum(map(len, cases.values()))} runs are missing; to run them:")
            for name in missing:
                tell_ways(folders[name], arguments)
            print(f"and then {arguments.again}")
        return 4 if complaints else 1
    for folder in folders.values():
        gather(folder)
    found = find(target, cases)
    write_whole(arguments.out / "calibration.json", json.dumps(found.as_dictionary(), indent=2, ensure_ascii=False) + "\n")
    write_whole(arguments.out / "calibration.html", calibration_page(found, {name: name for name in folders}))
    if not arguments.quiet:
        tell(found, arguments.out)
    return 4 if complaints else 0


if __name__ == "__main__":
    explained(main)
