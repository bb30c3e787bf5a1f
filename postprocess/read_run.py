# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads what a run of Talus left in its folder; a run still going on, or killed, reads as far as it came.

The scripts beside this file share it, and the Python package has it as talus.run.

Frames are read with VTK (Debian: python3-vtk9), which is loaded only then.
"""
import csv
import fcntl
import json
import os
import tomllib
import xml.etree.ElementTree as xml
from pathlib import Path
from typing import NamedTuple

import numpy


END_OF_FRAME = 32  # bytes, among which a whole frame has its last tag


class RunError(Exception):
    """A run, or a part of it, that is not there; the text is one sentence for the user."""

    exit_code = 2


class DamagedRun(RunError):
    """A file of a run that is not as the run wrote it."""

    exit_code = 4


class Frame(NamedTuple):
    time: float  # s
    path: Path


class Measurement(NamedTuple):
    """What a sensor found of a quantity; the spread is the standard error of the mean unless the sensor says other."""

    value: float
    spread: float
    unit: str


class Spheres:
    """The spheres of a frame, in the order of their ids: time [s], positions (n, 3) [m], ids and radii (n,), and of
    velocities, angular_velocities, materials, forces (contacts', [N]) and coordination those that the run wrote.
    """

    NAMES = {"id": "ids", "radius": "radii", "velocity": "velocities", "angular_velocity": "angular_velocities",
             "material": "materials", "force": "forces"}

    def __init__(self, frame):
        from vtkmodules.util.numpy_support import vtk_to_numpy

        geometry = read_frame(frame)
        points = geometry.GetPoints()
        self.time = frame.time
        self.positions = vtk_to_numpy(points.GetData()) if points else numpy.zeros((0, 3))
        data = geometry.GetPointData()
        for index in range(data.GetNumberOfArrays()):
            array = data.GetArray(index)
            setattr(self, self.NAMES.get(array.GetName(), array.GetName()), vtk_to_numpy(array))


def is_locked(folder):
    """Whether a process of Talus writes into a folder: it holds it locked, and talus.lock in it, until it ends."""
    return any(is_held(one) for one in (folder, folder / "talus.lock"))


def is_held(path):
    try:
        descriptor = os.open(path, os.O_RDONLY)
    except OSError:
        return False
    try:
        fcntl.flock(descriptor, fcntl.LOCK_SH | fcntl.LOCK_NB)
        return False
    except BlockingIOError:
        return True
    except OSError:
        return False  # what cannot be locked is locked by nobody
    finally:
        os.close(descriptor)


class Run:
    """The folder of a run.

    Raises RunError where the folder holds none.
    """

    def __init__(self, folder):
        self.folder = Path(folder)
        if not (self.folder / "scene.resolved.toml").is_file():
            raise RunError(f"{self.folder} holds no run of Talus: it has no scene.resolved.toml.")

    def is_going_on(self):
        """Whether a process of Talus writes into the folder."""
        return is_locked(self.folder)

    def scene(self):
        """The scene with all its keys, as nested dictionaries."""
        path = self.folder / "scene.resolved.toml"
        try:
            return tomllib.loads(path.read_text(encoding="utf-8"))
        except tomllib.TOMLDecodeError as error:
            raise DamagedRun(f"{path} is damaged: {error}.") from error

    def title(self):
        """The title of the scene, or the folder's name where it has none."""
        return self.scene().get("title") or self.folder.resolve().name

    def summary(self):
        """summary.json as nested dictionaries; empty until the run has ended."""
        path = self.folder / "summary.json"
        if not path.is_file():
            return {}
        try:
            return json.loads(path.read_text(encoding="utf-8"))
        except json.JSONDecodeError as error:
            raise DamagedRun(f"{path} is damaged: {error}.") from error

    def frames(self, series="particles"):
        """The frames of particles, contacts, walls or moving_walls in order of time; empty where the run wrote none."""
        path = self.folder / f"{series}.pvd"
        if not path.is_file():
            return []
        try:
            entries = xml.parse(path).iter("DataSet")
        except xml.ParseError as error:
            raise DamagedRun(f"{path} is damaged: {error}.") from error
        frames = [Frame(float(entry.get("timestep")), self.folder / entry.get("file")) for entry in entries]
        return sorted(frames, key=lambda frame: frame.time)

    def frame(self, time=None):
        """The spheres of the frame nearest to a time [s], or of the last.

        Raises RunError where there is none.
        """
        frames = self.frames()
        if not frames:
            raise RunError(f"{self.folder} has no frames.")
        return Spheres(frames[-1] if time is None else min(frames, key=lambda frame: abs(frame.time - time)))

    def sensors(self):
        """The results of the sensors: sensor → quantity → (value, spread, unit); empty until the run has ended."""
        return {name: {quantity: Measurement(*(numpy.nan if found[key] is None else found[key]
                                               for key in Measurement._fields))
                       for quantity, found in quantities.items()}
                for name, quantities in self.summary().get("sensors", {}).items()}

    def metrics(self):
        """metrics.csv: the name of each column, with its unit, and its values; a last row half written is left out."""
        path = self.folder / "metrics.csv"
        if not path.is_file():
            raise RunError(f"{path} is not there.")
        with path.open(newline="", encoding="utf-8") as file:
            header, *rows = list(csv.reader(file)) or [[]]
        rows = [row for row in rows if len(row) == len(header)]
        if not rows:
            raise RunError(f"{path} has no rows yet.")
        return dict(zip(header, numpy.array(rows, dtype=float).T))


def read_frame(frame):
    """The vtkPolyData of a frame.

    Raises DamagedRun where the file is missing or damaged.
    """
    from vtkmodules.vtkCommonCore import vtkObject
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

    if not frame.path.is_file():
        raise DamagedRun(f"{frame.path} is not there, though the run lists it.")
    with frame.path.open("rb") as file:
        file.seek(-min(END_OF_FRAME, frame.path.stat().st_size), os.SEEK_END)
        if b"</VTKFile>" not in file.read():
            raise DamagedRun(f"{frame.path} is damaged: it is cut short.")
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(frame.path))
    errors = []
    reader.AddObserver("ErrorEvent", lambda *_: errors.append(1))
    shows = vtkObject.GetGlobalWarningDisplay()
    vtkObject.GlobalWarningDisplayOff()  # it has lines of its own for each
    reader.Update()
    vtkObject.SetGlobalWarningDisplay(shows)
    geometry = reader.GetOutput()
    if reader.GetErrorCode() or errors or not has_whole_arrays(geometry):
        raise DamagedRun(f"{frame.path} is damaged.")
    return geometry


def has_whole_arrays(geometry):
    """Whether each array of a frame has as many entries as it has points or cells, and a name."""
    parts = ((geometry.GetPointData(), geometry.GetNumberOfPoints()), (geometry.GetCellData(), geometry.GetNumberOfCells()))
    arrays = [(data.GetArray(k), count) for data, count in parts for k in range(data.GetNumberOfArrays())]
    return all(array is not None and array.GetName() and array.GetNumberOfTuples() == count for array, count in arrays)
