#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the hopper of a study with LAMMPS and LIGGGHTS, and puts them on the study's axes: error of the mass flow
against CPU seconds.

    talus study hopper --settings tests/studies/hopper.toml
    tests/studies/peers/peers.py out/study-hopper                into out/study-hopper/peers.csv and peers.png

Every code begins, for each seed of the study, from the bed that Talus has when half of the time to the opening of the
gate is over, and settles for the rest of it with its own contacts. The mass flow is the slope of the mass that has
passed the outlet, and CPU seconds are taken, over the same times. Errors are against the study's reference, a run of
Talus.

LAMMPS and LIGGGHTS have springs (Hertz and Mindlin): what they trade is Young's modulus, with a time step of a fifth of
Rayleigh's. Restitution and friction are those of the scene. A code that is not installed is skipped, with a word.
Beads, of glass, would have 6e10 Pa.

What was run is kept in peers.csv; runs that are there are not made again.

Exit codes: 0 done, or skipped; 2 the call or a file is wrong; 5 a code failed.
"""
import argparse
import csv
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib
from pathlib import Path
from typing import NamedTuple

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[2] / "postprocess"))
try:
    import matplotlib
    import numpy
    from vtkmodules.util.numpy_support import vtk_to_numpy
except ImportError as error:
    print(f"peers.py: {error}: apt install python3-matplotlib python3-vtk9, and use /usr/bin/python3.", file=sys.stderr)
    sys.exit(2)
from read_run import Run, RunError, read_frame  # noqa: E402  after its folder was named

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402  after the choice of a backend without a screen

POISSON = 0.25
STEP_SHARE = 0.2  # of Rayleigh's time
SAMPLES = 200  # of the mass that has passed
LOOK = 0.02  # s between two looks at the CPU seconds
FLOW = "outlet mass_flow"
NAMED = ("default", "projected", "matched, step=x4", "matched, tolerance=draft", "projected, tolerance=fine")
COLUMNS = ["code", "setting", "seed", "cpu_s_per_s_in_window", "mass_flow_kg_per_s"]


class StudyError(Exception):
    """A study that is not there, or not of the hopper; the text is one sentence for the user."""


class PeerError(Exception):
    """A code that fails; the text is one sentence for the user."""


class Peer(NamedTuple):
    name: str
    programs: tuple  # what it may be called
    package: str
    script: str
    moduli: tuple  # Pa


PEERS = [
    Peer("LAMMPS", ("lmp", "lammps"), "lammps", "hopper.lammps", (5e5, 5e6, 5e7, 5e8)),
    Peer("LIGGGHTS", ("liggghts",), "liggghts", "hopper.liggghts", (5e6, 5e7, 5e8)),  # it takes no softer ones
]


class Window(NamedTuple):
    """Times of a run [s]."""

    handed_over: float  # the bed, by Talus
    opened: float
    measured_from: float
    end: float


class Measured(NamedTuple):
    """A run of any code."""

    code: str
    setting: str
    seed: int
    cpu: float  # s a simulated second
    flow: float  # kg/s


class Study:
    """The folder of a study of the hopper."""

    def __init__(self, folder):
        self.folder = Path(folder)
        mark, rows = self.folder / "study.resolved.toml", self.folder / "rows.jsonl"
        if not (mark.is_file() and rows.is_file()):
            raise StudyError(f"{folder} holds no study.")
        self.settings = tomllib.loads(mark.read_text(encoding="utf-8"))
        self.rows = [json.loads(line) for line in rows.read_text(encoding="utf-8").splitlines()]
        self.changes = self.settings["set"]

    def window(self):
        changed = dict(change.split("=", 1) for change in self.changes)
        if "wall.gate.remove_at" not in changed:
            raise StudyError(f"{self.folder} holds no study of the hopper that says when its gate opens.")
        opened = float(changed["wall.gate.remove_at"])
        measured_from = self.settings["start"] + self.settings["settle"]
        return Window(0.5 * opened, opened, measured_from, self.settings["end"])

    def measured(self):
        runs = []
        for row in self.rows:
            flow = [found["value"] for found in row["findings"] if found["name"] == FLOW]
            if row["status"] == "done" and flow:
                runs.append(Measured("Talus", row["setting"], row["seed"], row["cpu_s_per_s"], flow[0]))
        if not any(run.setting == "reference" for run in runs):
            raise StudyError(f"{self.folder} has no reference of the {FLOW} yet.")
        return runs


class Bed(NamedTuple):
    """Spheres, one a row."""

    position: numpy.ndarray  # m
    velocity: numpy.ndarray  # m/s
    spin: numpy.ndarray  # rad/s
    radius: numpy.ndarray  # m
    density: float  # kg/m3


def settled_bed(talus, study, seed, folder):
    """The bed that Talus hands over, and the scene with all its keys."""
    changes = [argument for change in study.changes for argument in ("--set", change)]
    until = study.window().handed_over
    command = [talus, "run", "hopper", *changes, "--seed", str(seed), "--until", str(until), "-o", folder, "--quiet"]
    if subprocess.run(command, stdout=subprocess.DEVNULL, check=False).returncode != 0:
        raise PeerError(f"{' '.join(map(str, command))} failed.")
    run = Run(folder)
    data = read_frame(run.frames()[-1])
    points = data.GetPointData()

    def array(name):
        return vtk_to_numpy(points.GetArray(name)).astype(float)

    scene = run.scene()
    bed = Bed(vtk_to_numpy(data.GetPoints().GetData()).astype(float), array("velocity"), array("angular_velocity"),
              array("radius"), scene["materials"]["glass"]["density"])
    return bed, scene


def write_start(bed, path, box):
    """The bed as LAMMPS and LIGGGHTS read it."""
    count = len(bed.radius)
    lines = ["The bed that Talus hands over", "", f"{count} atoms", "2 atom types", ""]
    lines += [f"{low} {high} {axis}lo {axis}hi" for axis, (low, high) in zip("xyz", box)]
    lines += ["", "Atoms", ""]
    for k in range(count):
        x, y, z = bed.position[k]
        lines.append(f"{k + 1} 1 {2 * bed.radius[k]:.12g} {bed.density} {x:.12g} {y:.12g} {z:.12g}")
    lines += ["", "Velocities", ""]
    for k in range(count):
        lines.append(f"{k + 1} " + " ".join(f"{value:.12g}" for value in (*bed.velocity[k], *bed.spin[k])))
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def rayleigh_time(bed, modulus):
    """Of the smallest sphere [s] (Thornton and Randall 1988)."""
    shear = modulus / (2 * (1 + POISSON))
    return math.pi * bed.radius.min() * math.sqrt(bed.density / shear) / (0.1631 * POISSON + 0.8766)


def hopper_sizes(path):
    """Radius, radius of the outlet, height of the shoulder and of the top [m], from the corners in an STL file."""
    corners = numpy.array([line.split()[1:] for line in path.read_text(encoding="ascii").splitlines()
                           if line.split()[0] == "vertex"], dtype=float)
    rings = {round(height, 6): numpy.hypot(*corners[corners[:, 2] == height, :2].T).max()
             for height in numpy.unique(corners[:, 2])}
    (_, outlet_radius), (shoulder, radius), (top, _) = sorted(rings.items())
    return {"radius": radius, "outlet_radius": outlet_radius, "shoulder": shoulder, "top": top}


def contact_between(scene, materials):
    for contact in scene["contact"]:
        if sorted(contact["between"]) == sorted(materials):
            return contact
    raise PeerError(f"The scene has no contact between {' and '.join(materials)}.")


def run_peer(peer, program, modulus, bed, scene, window):
    """CPU seconds a simulated second, and the mass flow, both in the window that the study measures."""
    step = STEP_SHARE * rayleigh_time(bed, modulus)
    mesh = HERE.parents[2] / "scenarios" / "hopper.stl"
    beads, wall = contact_between(scene, ["glass", "glass"]), contact_between(scene, ["glass", "steel"])
    variables = {
        "modulus": modulus, "restitution": beads["restitution"], "friction": beads["friction"],
        "wall_friction": wall["friction"], "step": step,
        "settling": round((window.opened - window.handed_over) / step),
        "flowing": math.ceil((window.end - window.opened) / step),
        "every": max(1, int((window.end - window.opened) / step / SAMPLES)), **hopper_sizes(mesh)}
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        shutil.copy(mesh, folder)
        write_start(bed, folder / "start.data", ((-0.3, 0.3), (-0.3, 0.3), (-0.15, 0.8)))
        command = [program, "-in", str(HERE / peer.script), "-log", "none"]
        for name, value in variables.items():
            command += ["-var", name, f"{value:.9g}"]
        cpu = cpu_while_running(peer, modulus, command, folder)
        passed, behind = numpy.loadtxt(folder / "flow.txt", comments="#").T
    whole = bed.density * (4 / 3 * math.pi * bed.radius**3).sum()
    if abs(behind[0] - whole) > 0.01 * whole:
        raise PeerError(f"Of {whole:.4g} kg of beads {behind[0]:.4g} are in the hopper when it opens.")
    return slope_in(window, *cpu), -slope_in(window, passed, behind)


def slope_in(window, times, values):
    """Of what grows with the time of the simulation, while the study measures [1/s]."""
    times = times + window.handed_over
    steady = (times >= window.measured_from) & (times <= window.end)
    return numpy.polyfit(times[steady], values[steady], 1)[0]


def cpu_while_running(peer, modulus, command, folder):
    """Runs a peer. Returns times that its simulation has come to, and CPU seconds that it has used by then."""
    flow, said = folder / "flow.txt", folder / "said.txt"
    times, cpu = [], []
    with said.open("w", encoding="utf-8") as output:
        process = subprocess.Popen(command, cwd=folder, stdout=output, stderr=subprocess.STDOUT,
                                   env={**os.environ, "OMP_NUM_THREADS": "1"})
        while process.poll() is None:
            time.sleep(LOOK)
            line = flow.read_text(encoding="utf-8").splitlines()[-1:] if flow.is_file() else []
            try:
                status = Path(f"/proc/{process.pid}/stat").read_text(encoding="ascii")
                user_and_system = status.rpartition(")")[2].split()[11:13]  # in clock ticks, see proc(5)
                now = float(line[0].split()[0])
            except (FileNotFoundError, ProcessLookupError, IndexError, ValueError):
                continue  # it has ended, or has written nothing yet, or half a line
            times.append(now)
            cpu.append(sum(map(int, user_and_system)) / os.sysconf("SC_CLK_TCK"))
    if process.returncode != 0:
        last = said.read_text(encoding="utf-8").strip().splitlines()[-1:]
        raise PeerError(f"{peer.name} failed with {modulus:.0e} Pa: {' '.join(last)}")
    return numpy.array(times), numpy.array(cpu)


def read_done(path):
    if not path.is_file():
        return []
    with path.open(newline="", encoding="utf-8") as file:
        return [Measured(row["code"], row["setting"], int(row["seed"]), float(row["cpu_s_per_s_in_window"]),
                         float(row["mass_flow_kg_per_s"])) for row in csv.DictReader(file) if row["code"] != "Talus"]


def write_rows(path, runs):
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(COLUMNS)
        writer.writerows([run.code, run.setting, run.seed, f"{run.cpu:.4g}", f"{run.flow:.6g}"] for run in runs)


def run_peers(talus, study, path):
    """Makes the runs that are not in the file yet, and keeps each; returns all."""
    done = read_done(path)
    seeds = sorted({run.seed for run in study.measured()})
    for peer in PEERS:
        program = next(filter(None, map(shutil.which, peer.programs)), None)
        if not program:
            print(f"{peer.name}: skipped, it is not installed (Debian: {peer.package})")
            continue
        for seed in seeds:
            missing = [modulus for modulus in peer.moduli
                       if not any((run.code, run.setting, run.seed) == (peer.name, f"{modulus:.0e} Pa", seed)
                                  for run in done)]
            if not missing:
                continue
            with tempfile.TemporaryDirectory() as place:
                bed, scene = settled_bed(talus, study, seed, Path(place) / "run")
            for modulus in missing:
                cpu, flow = run_peer(peer, program, modulus, bed, scene, study.window())
                done.append(Measured(peer.name, f"{modulus:.0e} Pa", seed, cpu, flow))
                write_rows(path, done)
                print(f"{peer.name} {modulus:.0e} Pa, seed {seed}: {flow:.4g} kg/s, {cpu:.3g} s CPU a second", flush=True)
    print("Siconos: skipped, siconos.io takes more than a second for a step of 200 spheres; its solver is compared on "
          "steps of Talus by tests/benchmarks/compare_siconos.py")
    return done


class Point(NamedTuple):
    """A setting over all seeds."""

    code: str
    setting: str
    cpu: float
    error: float  # signed, as a share of the reference
    spread: float  # its standard error


def points(runs):
    """The runs of each setting against the reference of the same seeds; the reference itself is left out. Settings that
    came to the same flows are one, by the name of the first."""
    reference = {run.seed: run.flow for run in runs if (run.code, run.setting) == ("Talus", "reference")}
    alike = {}
    for code, setting in dict.fromkeys((run.code, run.setting) for run in runs):
        if (code, setting) == ("Talus", "reference"):
            continue
        same = [run for run in runs if (run.code, run.setting) == (code, setting) and run.seed in reference]
        alike.setdefault((code, *((run.seed, run.flow) for run in same)), []).extend(same)
    found = []
    for same in alike.values():
        errors = list({run.seed: run.flow / reference[run.seed] - 1.0 for run in same}.values())
        spread = numpy.std(errors, ddof=1) / math.sqrt(len(errors)) if len(errors) > 1 else math.nan
        cpu = float(numpy.mean([run.cpu for run in same]))
        found.append(Point(same[0].code, same[0].setting, cpu, float(numpy.mean(errors)), spread))
    return found


def print_table(found):
    print("\n| code | setting | CPU s a simulated second | mass flow against the reference |\n| --- | --- | --- | --- |")
    for point in found:
        print(f"| {point.code} | {point.setting} | {point.cpu:.3g} | {100 * point.error:+.2f} ± {100 * point.spread:.2f} % |")


def draw(found, path):
    figure, axes = pyplot.subplots(figsize=(8, 5.5), layout="constrained")
    colours = {"Talus": "#b4451f", "LAMMPS": "#2f6fb0", "LIGGGHTS": "#2e8b57"}
    for code, colour in colours.items():
        of_code = sorted((point for point in found if point.code == code), key=lambda point: point.cpu)
        if not of_code:
            continue
        axes.errorbar([point.cpu for point in of_code], [100 * point.error for point in of_code],
                      yerr=[100 * point.spread for point in of_code], fmt="o-" if code != "Talus" else "o", ms=5, lw=1,
                      color=colour, label=code, elinewidth=0.7)
        for point in of_code:
            if code != "Talus" or point.setting in NAMED:
                axes.annotate(point.setting, (point.cpu, 100 * point.error), textcoords="offset points", xytext=(6, 6),
                              fontsize=8, color=colour)
    axes.axhline(0.0, color="grey", lw=0.8)
    axes.set_xscale("log")
    axes.set_xticks([5, 10, 20, 50], ["5", "10", "20", "50"])
    axes.set(xlabel="CPU seconds for a simulated second",
             ylabel="mass flow against the reference [%]", title="Hopper of 2500 beads: the mass flow; bars: one standard error")
    axes.grid(alpha=0.3)
    axes.legend()
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description="Runs the hopper of a study with LAMMPS and LIGGGHTS.")
    parser.add_argument("study", type=Path, help="the folder of the study")
    parser.add_argument("--talus", default="build/talus", metavar="PROGRAM", help="default: %(default)s")
    arguments = parser.parse_args()
    try:
        study = Study(arguments.study)
        peers = run_peers(arguments.talus, study, study.folder / "peers.csv")
        runs = [*study.measured(), *peers]
        write_rows(study.folder / "peers.csv", runs)
        found = points(runs)
        print_table(found)
        draw(found, study.folder / "peers.png")
    except (RunError, StudyError) as error:
        print(f"peers.py: {error}", file=sys.stderr)
        return 2
    except PeerError as error:
        print(f"peers.py: {error}", file=sys.stderr)
        return 5
    return 0


if __name__ == "__main__":
    sys.exit(main())
