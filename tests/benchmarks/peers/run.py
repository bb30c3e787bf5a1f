#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the same silos and the same pile with Talus, LAMMPS and LIGGGHTS in turn, and writes what they took and found.

    tests/benchmarks/peers/run.py --talus build/talus --folder build/benchmarks/peers --json peers.json

peers.md describes the set-ups. A code that is not installed is skipped, with a word; there has to be none but Talus.
All run on one thread. The runs of a set-up are repeated in turn, code after code, each time from another lattice, so
that a load of the machine that comes and goes falls on all.

Exit codes: 0 done; 2 the call is wrong; 5 a code failed.
"""
import argparse
import itertools
import json
import os
import shutil
import statistics
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import numpy

from spheres import LARGEST, SMALLEST, angle_of_repose, jittered_lattice, overlaps, write_csv, write_data, write_stl

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[2] / "postprocess"))
from read_run import Run, read_frame  # noqa: E402  after its folder was named

MEAN = 0.5 * (SMALLEST + LARGEST)


class PeerError(Exception):
    """A code that fails; the text is one sentence for the user."""


class Setup(NamedTuple):
    """A workload: where spheres begin, what walls are as STL, and the times of a run [s]."""
    name: str
    count: int
    radius: float  # of the lattice's tube [m]
    base: float  # its lower end [m]
    half_width: float  # of the room of LAMMPS and LIGGGHTS [m] …
    top: float  # … and where it ends, a little above the spheres, with the walls [m]
    opened: float  # when the gate is taken away; 0 without one
    end: float
    flow: tuple  # times after the opening between which the flow is measured
    frames: float  # between two frames
    repetitions: int


SETUPS = [
    Setup("silo_2000", 2000, 0.1, 0.001, 0.12, 0.15, 0.8, 1.3, (0.1, 0.4), 0.02, 3),
    Setup("pile_3000", 3000, 0.12, 0.25, 0.18, 0.4, 0.0, 4.0, (), 0.1, 1),
    Setup("silo_10000", 10000, 0.1, 0.001, 0.12, 0.6, 0.8, 2.0, (0.4, 1.2), 0.05, 1),
]


class Setting(NamedTuple):
    """A code with what it trades accuracy for."""
    code: str
    name: str
    modulus: float = 0.0  # Pa, of smooth contacts
    step: float = 0.0  # s; of Talus in automatic steps, 0 for that itself
    changes: tuple = ()  # to the scene of Talus
    only: str = ""  # set-ups whose name begins so


# The automatic step of Talus comes first: others are multiples of what that run took.
SETTINGS = [
    Setting("Talus", "auto"),
    Setting("LAMMPS", "5e6 Pa", 5e6, 1.2e-4),
    Setting("LIGGGHTS", "5e6 Pa", 5e6, 1.2e-4),
    *(Setting("Talus", f"{factor:g} × auto", step=factor, only="silo") for factor in (0.5, 1.5, 2, 3)),
    Setting("LAMMPS", "5e7 Pa", 5e7, 3.8e-5, only="silo"),
    Setting("LIGGGHTS", "5e7 Pa", 5e7, 3.8e-5, only="silo"),
    Setting("LAMMPS", "7e8 Pa", 7e8, 1.0e-5, only="silo_2000"),
    Setting("Talus", "converged", step=0.5, changes=('solver.tolerance="fine"',)),
]
PROGRAMS = {"LAMMPS": ("lmp", "lammps"), "LIGGGHTS": ("liggghts",)}


class Frame(NamedTuple):
    time: float  # s
    centers: numpy.ndarray
    radii: numpy.ndarray


def profiles(setup):
    """Its walls, to be turned round the axis: radii and heights [m]."""
    if setup.name.startswith("silo"):
        return [[(0.1, setup.top), (0.1, 0.0), (0.035, 0.0)]]
    return [[(0.12, setup.top), (0.12, 0.24), (0.03, 0.15)], [(0.15, 0.01), (0.15, 0.0), (0.0, 0.0)]]


def program_of(code, talus):
    return talus if code == "Talus" else next(filter(None, map(shutil.which, PROGRAMS[code])), None)


def call(command, folder, name):
    """Runs a command on one thread; what it says goes to a file."""
    with (folder / "said.txt").open("a", encoding="utf-8") as output:
        done = subprocess.run(list(map(str, command)), cwd=folder, stdout=output, stderr=output, check=False,
                              env={**os.environ, "OMP_NUM_THREADS": "1"})
    if done.returncode:
        last = (folder / "said.txt").read_text(encoding="utf-8", errors="replace").strip().splitlines()[-1:]
        raise PeerError(f"{name} failed, see {folder / 'said.txt'}: {' '.join(last)}")


def cpu_at(folder, moment):
    """CPU seconds of a code when it came to this line of its input: its own line of proc(5)."""
    fields = (folder / f"{moment}.stat").read_text(encoding="ascii").rpartition(")")[2].split()
    return sum(map(int, fields[11:13])) / os.sysconf("SC_CLK_TCK")


def run_smooth(program, setting, setup, folder):
    """CPU seconds of settling and of what comes then, the frames, and the step [s]."""
    kind = setup.name.partition("_")[0]
    step = setting.step
    every = round(setup.frames / step)
    settling = every * round(setup.opened / (every * step))
    variables = {"modulus": setting.modulus, "step": step, "every": every, "settling": settling,
                 "flowing": every * round((setup.end - setup.opened) / (every * step))}
    command = [program, "-in", HERE / f"{kind}.{setting.code.lower()}", "-log", "none"]
    for name, value in variables.items():
        command += ["-var", name, f"{value:.9g}"]
    call(command, folder, setting.code)
    frames = []
    for path in folder.glob("frame.*.txt"):
        table = numpy.loadtxt(path, skiprows=9, ndmin=2)
        frames.append(Frame(int(path.name.split(".")[1]) * step, table[:, 1:4], table[:, 4]))
    opened = cpu_at(folder, "opened") if setup.opened else cpu_at(folder, "start")
    return opened - cpu_at(folder, "start"), cpu_at(folder, "end") - opened, frames, step


def run_talus(program, setting, setup, folder, automatic):
    """The same of Talus: its clock, which begins when the scene is built. @param automatic its step [s]"""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    kind = setup.name.partition("_")[0]
    shutil.copy(HERE / f"{kind}.toml", folder / "scene.toml")
    step = (f"time.step={setting.step * automatic:.6g}",) if setting.step else ()
    changes = [argument for change in (*step, *setting.changes, f"time.duration={setup.end}",
                                       f"time.frame_interval={setup.frames}", "time.metrics_interval=0.02")
               for argument in ("--set", change)]
    common = ["--threads", "1", "--quiet"]
    until = setup.opened or setup.end
    call([program, "run", "scene.toml", *changes, "--until", until, "-o", "run", *common], folder, "Talus")
    run = Run(folder / "run")
    first = run.summary()["timing"]["cpu"]
    if setup.opened:
        call([program, "resume", "run", "--until", setup.end, *common], folder, "Talus")
    whole = run.summary()["timing"]["cpu"]
    frames = []
    for frame in run.frames():
        data = read_frame(frame)
        frames.append(Frame(frame.time, vtk_to_numpy(data.GetPoints().GetData()).astype(float),
                            vtk_to_numpy(data.GetPointData().GetArray("radius")).astype(float)))
    taken = run.summary()["time"]["step"]
    return (first, whole - first, frames, taken) if setup.opened else (0.0, first, frames, taken)


def mean_and_worst(frames):
    """Overlaps of all contacts in these frames [mean diameters]."""
    found = numpy.concatenate([overlaps(frame.centers, frame.radii) for frame in frames]) / MEAN
    return float(found.mean()), float(found.max())


def flow_of(window):
    """Spheres a second that leave the silo, and the standard error: from the slopes in four parts of the time."""
    def slope(frames):
        above = [numpy.count_nonzero(frame.centers[:, 2] > 0.0) for frame in frames]
        return -float(numpy.polyfit([frame.time for frame in frames], above, 1)[0])

    ends = numpy.linspace(0, len(window) - 1, 5).round().astype(int)
    parts = [slope(window[begin:end + 1]) for begin, end in itertools.pairwise(ends)]
    return slope(window), statistics.stdev(parts) / len(parts) ** 0.5


def measure(program, setting, setup, seed, folder, automatic):
    """One run; the same seed gives all codes the same spheres. @param automatic step of Talus [s]"""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    centers, radii = jittered_lattice(setup.count, setup.radius, setup.base, seed)
    write_csv(folder / "spheres.csv", centers, radii)
    write_data(folder / "spheres.data", centers, radii, setup.half_width, setup.top)
    write_stl(folder / "walls.stl", profiles(setup))
    if setting.code == "Talus":
        settling, flowing, frames, step = run_talus(program, setting, setup, folder, automatic)
    else:
        settling, flowing, frames, step = run_smooth(program, setting, setup, folder)
    frames.sort(key=lambda frame: frame.time)
    figures = {"flowing_cpu": flowing / (setup.end - setup.opened), "step": step}
    if setup.opened:
        figures["settling_cpu"] = settling / setup.opened
        early, late = (setup.opened + time for time in setup.flow)
        slack = 0.1 * setup.frames
        before = [frame for frame in frames if frame.time <= setup.opened + slack][-1]
        if len(before.radii) < setup.count:
            raise PeerError(f"{setting.code} lost {setup.count - len(before.radii)} spheres before the silo opened.")
        window = [frame for frame in frames if early - slack <= frame.time <= late + slack]
        figures["flow"], figures["flow_error"] = flow_of(window)
        figures["rest_mean"], figures["rest_worst"] = mean_and_worst([before])
        inside = [Frame(f.time, f.centers[f.centers[:, 2] > 0], f.radii[f.centers[:, 2] > 0]) for f in window]
        figures["flow_mean"], figures["flow_worst"] = mean_and_worst(inside)
    else:
        last = frames[-1]
        figures["angle"] = angle_of_repose(last.centers, last.radii)
        figures["rest_mean"], figures["rest_worst"] = mean_and_worst([last])
        figures["lost"] = int(setup.count - numpy.count_nonzero(last.centers[:, 2] > 0.0))
    shutil.rmtree(folder)
    return figures


def run_all(setups, talus, folder, keep):
    """For each set-up the medians of each setting, of the flow its mean, and which codes were skipped; what there is by
    then is kept after each set-up, so that little is lost when this is broken off."""
    skipped = [code for code in PROGRAMS if not program_of(code, talus)]
    for code in skipped:
        print(f"{code}: skipped, it is not installed (Debian: apt-get install --no-install-recommends {code.lower()})")
    rows = []
    for setup in setups:
        settings = [one for one in SETTINGS if one.code not in skipped and setup.name.startswith(one.only)]
        found = {setting: [] for setting in settings}
        automatic = None
        for repetition in range(setup.repetitions):
            for setting in settings:
                figures = measure(program_of(setting.code, talus), setting, setup, repetition + 1, folder / setup.name,
                                  automatic)
                automatic = automatic or figures["step"]
                found[setting].append(figures)
                told = ", ".join(f"{name} {value:.4g}" for name, value in figures.items())
                print(f"{setup.name}, {setting.code}, {setting.name}: {told}", flush=True)
        for setting, runs in found.items():
            middle = {name: statistics.median(run[name] for run in runs) for name in runs[0]}
            if "flow" in middle:
                middle["flow"] = statistics.mean(run["flow"] for run in runs)
                middle["flow_error"] = sum(run["flow_error"] ** 2 for run in runs) ** 0.5 / len(runs)
            rows.append({"setup": setup.name, "code": setting.code, "setting": setting.name, "runs": len(runs),
                         **middle})
        keep({"rows": rows, "skipped": skipped})


def main():
    parser = argparse.ArgumentParser(description="Runs silos and a pile with Talus, LAMMPS and LIGGGHTS.")
    parser.add_argument("words", nargs="*", metavar="WORD", help="only set-ups with one of these words in their name")
    parser.add_argument("--talus", type=Path, required=True, metavar="PROGRAM")
    parser.add_argument("--folder", type=Path, required=True, help="for the runs; each is removed when it was measured")
    parser.add_argument("--json", type=Path, required=True, metavar="FILE", help="where the figures go")
    arguments = parser.parse_args()
    setups = [one for one in SETUPS if not arguments.words or any(word in one.name for word in arguments.words)]
    if not setups:
        parser.error("no set-up has one of these words in its name")

    def keep(found):
        arguments.json.write_text(json.dumps(found, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")

    try:
        run_all(setups, arguments.talus.resolve(), arguments.folder.resolve(), keep)
    except PeerError as error:
        print(f"run.py: {error}", file=sys.stderr)
        return 5
    return 0


if __name__ == "__main__":
    sys.exit(main())
