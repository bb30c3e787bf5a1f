#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that `talus export` writes the numbers of a run's frames, in every format.

    tests/support/check_export.py TALUS OUT        a run with grains and contacts in its last frames

The frames are read with postprocess/read_run.py, the exports as their readers would. Exit codes: 0 they are the same, 1
they are not.
"""
import csv
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "postprocess"))
from read_run import Frame, Run, read_frame  # noqa: E402  found by the line above

COLUMNS = {"radius": ["radius_m"], "velocity": [f"velocity_{axis}_m_per_s" for axis in "xyz"],
           "angular_velocity": [f"angular_velocity_{axis}_rad_per_s" for axis in "xyz"]}
DUMPED = {"radius": ["radius"], "velocity": ["vx", "vy", "vz"], "angular_velocity": ["omegax", "omegay", "omegaz"]}


def points(frame):
    return vtk_to_numpy(frame.GetPoints().GetData()) if frame.GetNumberOfPoints() else numpy.empty((0, 3))


def values(data, name):
    return vtk_to_numpy(data.GetArray(name))


def csv_rows(path):
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def column(rows, names):
    return numpy.squeeze(numpy.array([[float(row[name]) for name in names] for row in rows], dtype=numpy.float32), axis=1) \
        if len(names) == 1 else numpy.array([[float(row[name]) for name in names] for row in rows], dtype=numpy.float32)


def dump_frames(path):
    """For each frame of a LAMMPS dump its time and its rows as dictionaries."""
    frames, lines = [], iter(path.read_text(encoding="utf-8").splitlines())
    for line in lines:
        if line == "ITEM: TIME":
            frames.append((float(next(lines)), []))
        elif line.startswith("ITEM: NUMBER OF"):
            count = int(next(lines))
        elif line.startswith(("ITEM: ATOMS", "ITEM: ENTRIES")):
            names = line.split()[2:]
            frames[-1][1].extend(dict(zip(names, next(lines).split())) for _ in range(count))
    return frames


def check_csv(run, folder):
    materials = sorted(run.scene()["materials"])
    for number, listed in enumerate(run.frames()):
        frame, rows = read_frame(listed), csv_rows(folder / f"particles_{number:06d}.csv")
        data = frame.GetPointData()
        if len(rows) != frame.GetNumberOfPoints():
            yield f"CSV frame {number} has {len(rows)} rows for {frame.GetNumberOfPoints()} grains"
        elif rows:
            if any(float(row["time_s"]) != listed.time for row in rows):
                yield f"CSV frame {number} has another time"
            if not numpy.array_equal(column(rows, [f"position_{axis}_m" for axis in "xyz"]), points(frame)):
                yield f"CSV frame {number} has other positions"
            for name, names in COLUMNS.items():
                if not numpy.array_equal(column(rows, names), values(data, name)):
                    yield f"CSV frame {number} has another {name}"
            if [row["material"] for row in rows] != [materials[k] for k in values(data, "material")]:
                yield f"CSV frame {number} has other materials"
    walls = [wall["name"] for wall in run.scene()["wall"]]
    for number, listed in enumerate(run.frames("contacts")):
        data, rows = read_frame(listed).GetCellData(), csv_rows(folder / f"contacts_{number:06d}.csv")
        if rows:
            if not numpy.array_equal(column(rows, ["normal_force_N"]), values(data, "normal_force")):
                yield f"CSV contacts {number} have other forces"
            if [row["wall"] for row in rows] != [walls[k] if k >= 0 else "" for k in values(data, "wall")]:
                yield f"CSV contacts {number} have other walls"


def check_dump(run, folder):
    frames = dump_frames(folder / "particles.lammpstrj")
    if [time for time, _ in frames] != [frame.time for frame in run.frames()]:
        yield "the dump has other times"
    for number, ((_, rows), listed) in enumerate(zip(frames, run.frames())):
        frame = read_frame(listed)
        data = frame.GetPointData()
        if len(rows) != frame.GetNumberOfPoints():
            yield f"dump frame {number} has {len(rows)} rows for {frame.GetNumberOfPoints()} grains"
        elif rows:
            if [int(row["id"]) - 1 for row in rows] != list(values(data, "id")):
                yield f"dump frame {number} has other ids"
            if [int(row["type"]) - 1 for row in rows] != list(values(data, "material")):
                yield f"dump frame {number} has other types"
            if not numpy.array_equal(column(rows, ["x", "y", "z"]), points(frame)):
                yield f"dump frame {number} has other positions"
            for name, names in DUMPED.items():
                if not numpy.array_equal(column(rows, names), values(data, name)):
                    yield f"dump frame {number} has another {name}"
    between, at_walls = dump_frames(folder / "contacts.dump"), dump_frames(folder / "wall_contacts.dump")
    for number, listed in enumerate(run.frames("contacts")):
        data = read_frame(listed).GetCellData()
        wall, first, second = (values(data, name) for name in ("wall", "id_a", "id_b"))
        pairs = [(int(row["batom1"]) - 1, int(row["batom2"]) - 1) for row in between[number][1]]
        if pairs != list(zip(first[wall < 0], second[wall < 0])):
            yield f"dumped contacts {number} are between other grains"
        if [(int(row["atom"]) - 1, int(row["wall"])) for row in at_walls[number][1]] != list(zip(first[wall >= 0], wall[wall >= 0])):
            yield f"dumped contacts {number} are of other walls"


def check_vtp(run, folder):
    for series in ("particles", "contacts", "walls"):
        for number, listed in enumerate(run.frames(series)):
            path = folder / f"{series}_{number:06d}.vtp"
            if b"vtkLZ4DataCompressor" in path.read_bytes():
                yield f"{path.name} is compressed with LZ4"
            frame, exported = read_frame(listed), read_frame(Frame(listed.time, path))
            if series == "particles" and exported.GetNumberOfVerts() != frame.GetNumberOfPoints():
                yield f"{path.name} has {exported.GetNumberOfVerts()} cells for {frame.GetNumberOfPoints()} grains"
            if not numpy.array_equal(points(frame), points(exported)):
                yield f"{path.name} has other points"
            for data, copy in ((frame.GetPointData(), exported.GetPointData()), (frame.GetCellData(), exported.GetCellData())):
                for k in range(data.GetNumberOfArrays()):
                    if not numpy.array_equal(values(data, data.GetArrayName(k)), values(copy, data.GetArrayName(k))):
                        yield f"{path.name} has another {data.GetArrayName(k)}"
        if (folder / f"{series}.pvd").read_text().count("<DataSet") != len(run.frames(series)):
            yield f"{series}.pvd lists another number of frames"


def problems(talus, out):
    """What is wrong, a sentence each."""
    run = Run(out)
    if not any(read_frame(frame).GetNumberOfCells() for frame in run.frames("contacts")):
        yield "the run has no contacts to compare"
    with tempfile.TemporaryDirectory() as folder:
        for name, check in (("csv", check_csv), ("lammps-dump", check_dump), ("vtp", check_vtp)):
            target = Path(folder) / name
            done = subprocess.run([talus, "export", out, "--format", name, "-o", target], capture_output=True, text=True,
                                  check=False)
            if done.returncode:
                yield f"export as {name} failed: {done.stderr.strip()}"
            else:
                yield from check(run, target)


def main():
    if len(sys.argv) != 3:
        sys.exit("usage: check_export.py TALUS OUT")
    found = list(problems(*sys.argv[1:]))
    for problem in found:
        print(f"check_export.py: {problem}", file=sys.stderr)
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
