# SPDX-License-Identifier: GPL-3.0-or-later
"""Decks run by LAMMPS and LIGGGHTS, those that `talus export` writes of scenes and their own, and what they leave."""
import functools
import os
import re
import shutil
import subprocess
from pathlib import Path
from typing import NamedTuple

import numpy

from read_run import Spheres

PROGRAMS = {"lammps": ("lmp", "lammps"), "liggghts": ("liggghts",)}


class DeckSpheres(NamedTuple):
    """Of a frame, in the order of their ids."""
    time: float  # s
    positions: numpy.ndarray  # m
    radii: numpy.ndarray  # m
    ids: numpy.ndarray  # as Talus counts them


def program_of(format):
    """The path of LAMMPS or LIGGGHTS, or None where it is not installed."""
    return next(filter(None, map(shutil.which, PROGRAMS[format])), None)


def run_deck(format, folder, variables):
    """Runs the deck in its folder, on one thread; keeps its CPU seconds there. Returns its exit code."""
    command = [program_of(format), "-in", f"in.{format}",
               *(word for name, value in variables.items() for word in ("-var", name, str(value)))]
    with (folder / "said.txt").open("w") as said, subprocess.Popen(
            command, cwd=folder, stdout=said, stderr=subprocess.STDOUT, env=dict(os.environ, OMP_NUM_THREADS="1")) as child:
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
    (folder / "cpu_s").write_text(str(usage.ru_utime + usage.ru_stime))
    return child.returncode


class DeckRun:
    """What there is of read_run's Run where LAMMPS or LIGGGHTS has made a run."""

    def __init__(self, folder):
        self.folder = Path(folder)
        log = next(self.folder.glob("log.*")).read_text()
        self.step = float(re.search(r"^timestep ([\d.e-]+)$", log, re.MULTILINE)[1])

    def summary(self):
        return {"timing": {"cpu": float((self.folder / "cpu_s").read_text())},
                "ledger": {"inserted": len(self.spheres[0].radii)}}

    @functools.cached_property
    def spheres(self):
        """Of each frame; a file is read once."""
        found = []
        with (self.folder / "frames.lammpstrj").open() as file:
            while file.readline():  # ITEM: TIMESTEP
                time = int(file.readline()) * self.step
                file.readline()
                count = int(file.readline())
                for _ in range(4):  # the room
                    file.readline()
                names = file.readline().split()[2:]
                table = numpy.array([file.readline().split() for _ in range(count)], float).reshape(count, len(names))
                of = dict(zip(names, table.T))
                found.append(DeckSpheres(time, numpy.column_stack([of["x"], of["y"], of["z"]]), of["radius"],
                                         of["id"].astype(int) - 1))
        return found


def spheres_of(run):
    """Of each frame of a run, whichever program made it, in order of time."""
    return run.spheres if isinstance(run, DeckRun) else [Spheres(frame) for frame in run.frames()]
