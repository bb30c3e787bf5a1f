#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs a scene under many settings from the same state, measures the error of each against a reference and its cost, and
writes rows.jsonl (a line as soon as a run is done), study.csv and study.html: what `talus study` calls. A study that was
stopped goes on where it was when it is asked for again.

Exit codes: 0 done; 2 wrong arguments, a wrong scene or study or something missing; 4 a file could not be written;
128 + N: signal N stopped it.
"""
import argparse
import hashlib
import json
import math
import os
import signal
import sys
import tempfile
import tomllib
import warnings
from pathlib import Path

try:
    import numpy  # noqa: F401  whether it is there
except ImportError:
    print("talus study: NumPy is not there: apt install python3-numpy, and use /usr/bin/python3.", file=sys.stderr)
    sys.exit(2)

from own_module import find_module
from read_run import RunError
from studies.request import REFERENCE, keys_told, read_study, resolved_study, settings_of
from studies.statistics import MeanAndError
from sweeps.pool import Process, Stopped, run_processes, signals_stop


def parse_arguments():
    parser = argparse.ArgumentParser(prog="talus study", description="Runs a scene under many settings: error against cost, and advice.")
    parser.add_argument("scene", metavar="SCENE", nargs="?", help="a scene file, or the name of a scene")
    parser.add_argument("--talus", default="talus", metavar="PROGRAM", help="the program, whose Python module is used")
    parser.add_argument("--settings", metavar="FILE", help="what to try and from when on, in TOML")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="changes a key of the scene")
    parser.add_argument("--seed", type=int, metavar="N", help="of the scene")
    parser.add_argument("--out", type=Path, metavar="DIR", help="where to (out/study-NAME)")
    parser.add_argument("--threads", type=int, default=0, metavar="N", help="runs at a time, each on one thread (all cores)")
    parser.add_argument("--force", action="store_true", help="begin anew where the folder holds a study")
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")
    parser.add_argument("--keys", action="store_true", help="print the keys of a study file")
    parser.add_argument("--work", metavar="JOB", help=argparse.SUPPRESS)  # a process of a study: what to do, as JSON
    return parser.parse_args()


class Worker(Process):
    """A run of a study, in a process of its own on one thread: one that crashes takes nothing with it."""

    def __init__(self, program, job):
        self.job = job
        self.words = tempfile.TemporaryFile("w+", encoding="utf-8")  # noqa: SIM115  closed in result()
        super().__init__(self.command(program), stdout=self.words, env={**os.environ, "OMP_NUM_THREADS": "1"})

    def command(self, program):
        return [sys.executable, __file__, "--talus", program, "--work", json.dumps(self.job)]

    def result(self):
        """What it found, and how it ended where it found nothing."""
        code, said = self.end()
        with self.words as file:
            file.seek(0)
            words = file.read()
        if code < 0:
            return None, f"crashed: {signal.strsignal(-code)}"
        return (json.loads(words), "") if code == 0 else (None, f"ended without a result: {said}")


def work(job):
    """What a worker does."""
    from run_page.writing import strict
    from studies.measuring import make_start, run_setting
    frame, seed = job["frame"], job["seed"]
    found = run_setting(frame, job["setting"], job["overrides"], seed) if "setting" in job else make_start(frame, seed)
    print(json.dumps(strict(found)))


def automatic_start(scene):
    """When the first sensor begins to look, or half of the duration."""
    first, duration = min((sensor["from"] for sensor in scene.get("sensor", [])), default=math.inf), scene["time"]["duration"]
    return first if 0 < first < duration else 0.5 * duration


class Study:
    """What is to be run, where, and when."""

    def __init__(self, talus, arguments):
        self.keys = read_study(arguments.settings)
        self.keys["set"] = [*self.keys["set"], *arguments.set]
        changes = self.keys["set"] + ([f"seed={arguments.seed}"] if arguments.seed is not None else [])
        warnings.simplefilter("ignore", talus.StepWarning)
        opened = talus.Simulation(arguments.scene, set=changes, threads=1)
        scene = tomllib.loads(opened.resolved)
        self.name, self.title = opened.name, scene.get("title") or opened.name
        self.scene_title = scene.get("title", "")
        self.folder = arguments.out or Path("out") / f"study-{self.name}"
        start, end = self.keys["start"], self.keys["end"]
        start = float(automatic_start(scene) if start == "auto" else start)
        end = float(scene["time"]["duration"] if end == "auto" else end)
        measured_from = start + self.keys["settle"]
        if not measured_from < end:
            raise RunError(f"the study must end after {measured_from:.6g} s, when its settings have settled, not at {end:.6g} s")
        self.frame = {"scene": arguments.scene, "set": self.keys["set"], "folder": str(self.folder), "start": start, "end": end,
                      "measured_from": measured_from, "longest": self.keys["longest"]}
        # The reference does not become coarser with the accuracy that a scene asks for.
        usual = talus.Simulation(arguments.scene, set=[*changes, "accuracy=''"], threads=1) if scene.get("accuracy") else opened
        self.settings = settings_of(self.keys, usual.step_length)
        self.seeds = [scene["seed"] + k for k in range(self.keys["seeds"])]
        self.what = self.described(opened, talus._core._study_units(opened))
        self.identity = identity(talus.__version__, self.name, opened.resolved, self.keys)

    def described(self, opened, units):
        frame, count = self.frame, len(self.seeds)
        what = (f"{opened.count} spheres, from {frame['start']:.4g} s on, measured from {frame['measured_from']:.4g} to {frame['end']:.4g} s, {count} "
                f"{'seeds' if count > 1 else 'seed'}; time step of the default {1e3 * opened.step_length:.3g} ms. Units: d = {1e3 * units['diameter']:.3g} mm "
                f"the mean diameter, g = {units['acceleration']:.3g} m/s², M the mass of all spheres, m of one, h the time step.")
        return what + (f" The scene with {', '.join(self.keys['set'])}." if self.keys["set"] else "")

    def missing(self, rows):
        """Jobs of which there is no row yet, the reference of each seed first: it takes longest."""
        return [{"frame": self.frame, "setting": setting.name, "overrides": setting.overrides, "seed": seed}
                for setting in self.settings for seed in self.seeds if not rows.has(setting.name, seed)]


def identity(version, name, resolved, keys):
    """The whole study with its scene and the files that it names: rows of another are not to be mixed with it."""
    from sweeps.folder import named_files
    content = hashlib.sha256(resolved.encode())
    for file in named_files(tomllib.loads(resolved)):
        content.update(Path(file).read_bytes())
    return f"# Talus {version}, scene {content.hexdigest()[:16]}: {name}\n{resolved_study(keys)}"


class Progress:
    """Tells what is done, and guesses from its CPU time how long the rest takes."""

    def __init__(self, jobs, at_once, window, quiet):
        self.left = [(job["setting"], job["seed"]) for job in jobs]
        self.total, self.at_once, self.window, self.quiet = len(jobs), at_once, window, quiet
        self.references, self.others = MeanAndError(), MeanAndError()

    def like(self, setting):
        return self.references if setting == REFERENCE else self.others

    def tell(self, row):
        self.left.remove((row["setting"], row["seed"]))
        done = row["status"] == "done"
        if done:
            self.like(row["setting"]).add(row["cpu_s_per_s"] * self.window)
        if not self.quiet:
            became = f"{row['cpu_s_per_s']:.3g} s CPU for a simulated second" if done else row["status"]
            print(f"{self.total - len(self.left)}/{self.total}  {self.eta()}  {row['setting']} (seed {row['seed']}): {became}", file=sys.stderr)

    def eta(self):
        seconds = sum(self.like(setting).mean() for setting, _ in self.left) / self.at_once
        return f"ETA {math.ceil(seconds / 60)} min" if math.isfinite(seconds) else "ETA –"


def make_starts(study, program, jobs, at_once, quiet):
    """The states that runs start from, one for each seed, where they are not there yet. Raises RunError where one cannot be
    made: there is nothing to compare then."""
    from studies.measuring import start_path
    seeds = [seed for seed in dict.fromkeys(job["seed"] for job in jobs) if not start_path(study.folder, seed).exists()]
    if seeds and not quiet:
        print(f"to the start at {study.frame['start']:.4g} s, {len(seeds)} {'seeds' if len(seeds) > 1 else 'seed'}", file=sys.stderr)
    failures = []

    def ended(worker):
        failure, ending = worker.result()
        failures.extend(one for one in (failure, ending) if one)

    run_processes([{"frame": study.frame, "seed": seed} for seed in seeds], at_once, lambda job: Worker(program, job), ended)
    if failures:
        raise RunError(f"{study.frame['scene']}: the scene itself does not come to the start of the study: {failures[-1]}")


def run_study(talus, study, arguments):
    """Runs what is missing, and writes what there is. Returns the result."""
    from studies.folder import Rows, read_row, row_text
    from studies.page import study_page
    from studies.result import compare, study_csv
    from run_page.writing import write_whole
    rows, quiet = Rows(study.folder), arguments.quiet
    jobs, at_once = study.missing(rows), arguments.threads or os.cpu_count()
    progress = Progress(jobs, at_once, study.frame["end"] - study.frame["start"], quiet)
    if not quiet:
        print(f"{study.name}: {study.scene_title}\n{len(jobs)} of {len(study.settings) * len(study.seeds)} runs to make, {at_once} at a time\n"
              f"output: {study.folder}", flush=True)

    def write_result():
        result = compare([setting.name for setting in study.settings], rows.all)
        write_whole(study.folder / "study.csv", study_csv(result))
        write_whole(study.folder / "study.html", study_page(result, study.title, study.what))
        return result

    def ended(worker):
        row, ending = worker.result()
        row = row or {"setting": worker.job["setting"], "seed": worker.job["seed"], "status": ending, "cpu_s_per_s": 0.0, "contact_updates_per_s": 0.0,
                      "memory_B": 0.0, "findings": [], "profile": []}
        rows.add(read_row(row_text(row)))
        write_result()
        progress.tell(row)

    try:
        make_starts(study, arguments.talus, jobs, at_once, quiet)
        run_processes(jobs, at_once, lambda job: Worker(arguments.talus, job), ended)
    finally:
        result = write_result()
    return result


def main():
    arguments = parse_arguments()
    if arguments.keys:
        print(keys_told(), end="")
        return 0
    talus = find_module(arguments.talus, "talus study")
    if arguments.work:
        work(json.loads(arguments.work))
        return 0
    from studies.folder import make_folder, take_folder
    from studies.result import advice
    try:
        with signals_stop():
            study = Study(talus, arguments)
            make_folder(study.folder)
            with talus._core._LockedFolder(study.folder):
                take_folder(study.folder, study.identity, arguments.force)
                result = run_study(talus, study, arguments)
    except RunError as error:
        print(f"talus study: {error}", file=sys.stderr)
        return 2
    except talus.SceneError as error:
        print(error, file=sys.stderr)
        return 2
    except Stopped as stopped:
        print("stopped; to go on: the same command again", file=sys.stderr)
        return 128 + stopped.args[0]
    except OSError as error:
        print(f"talus study: {f'{error.filename}: {error.strerror}' if error.filename else error}", file=sys.stderr)
        return 4
    if not arguments.quiet:
        for sentence in advice(result):
            print(sentence)
        print(f"all of it: {study.folder / 'study.html'}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
