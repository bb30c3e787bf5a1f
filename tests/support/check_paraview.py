#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that postprocess/paraview_view.py sets a run up in ParaView, by a picture that pvbatch makes.

    tests/support/check_paraview.py OUT        a run whose last frame holds grains

Skipped, with a word, where there is no pvbatch with ParaView's Python modules. Exit codes: 0 it does, 1 it does not.
"""
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

VIEW = Path(__file__).resolve().parents[2] / "postprocess" / "paraview_view.py"


def pixels(png):
    reader = vtkPNGReader()
    reader.SetFileName(str(png))
    reader.Update()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).astype(int)[:, :3]


def problems(run):
    """What is wrong, a sentence each."""
    with tempfile.TemporaryDirectory() as folder:
        png = Path(folder) / "picture.png"
        done = subprocess.run([VIEW, run, "--picture", png], capture_output=True, text=True, check=False)
        if "finds no Python modules" in done.stderr:
            print("skipped: pvbatch has no Python modules of ParaView")
            return
        if done.returncode or not png.is_file():
            yield f"no picture was made: {done.stderr.strip()[-500:]}"
            return
        seen = pixels(png)
        # grains have the colours of a scale of speeds; walls are grey, the background is white
        coloured = numpy.mean(numpy.ptp(seen, axis=1) > 40)
        if coloured < 0.005:
            yield f"the picture shows no grains: only {coloured:.2%} of it has a colour"
        if numpy.mean(seen.min(axis=1) > 250) < 0.3:
            yield "the picture has no white background"
        nowhere = subprocess.run([VIEW, folder, "--picture", png], capture_output=True, text=True, check=False)
        if nowhere.returncode != 2 or len(nowhere.stderr.splitlines()) != 1:
            yield "a folder without a run was not refused in one sentence with exit code 2"


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: check_paraview.py OUT")
    if not shutil.which("pvbatch"):
        print("skipped: there is no pvbatch (Debian: paraview)")
        return
    found = list(problems(sys.argv[1]))
    for problem in found:
        print(f"check_paraview.py: {problem}", file=sys.stderr)
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
