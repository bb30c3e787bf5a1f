#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that postprocess/render.py draws the grains of a run and refuses what is not there.

    tests/support/check_render.py OUT        a run whose last frame holds grains

Exit codes: 0 it does, 1 it does not.
"""
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

RENDER = Path(__file__).resolve().parents[2] / "postprocess" / "render.py"


def render(*arguments):
    return subprocess.run([sys.executable, RENDER, *arguments], capture_output=True, text=True, check=False)


def sandy_share(png):
    """Share of the pixels that are sand-coloured, as grains are and walls, text and background are not."""
    reader = vtkPNGReader()
    reader.SetFileName(str(png))
    reader.Update()
    red, _, blue = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).astype(int).T[:3]
    return float(numpy.mean(red - blue > 25))


def problems(run):
    """What is wrong, a sentence each."""
    with tempfile.TemporaryDirectory() as folder:
        png = Path(folder) / "picture.png"
        drawn = render(run, "--color-by", "none", "--size", "400x300", "--output", png)
        if drawn.returncode != 0 or not png.is_file():
            yield f"no picture was written: {drawn.stderr.strip()}"
        elif sandy_share(png) < 0.01:
            yield "the picture shows no grains"
        elsewhere = render(folder)
        if elsewhere.returncode != 2 or len(elsewhere.stderr.splitlines()) != 1:
            yield "a folder without a run was not refused in one sentence with exit code 2"
        beyond = render(run, "--frame", "1000000")
        if beyond.returncode != 2 or len(beyond.stderr.splitlines()) != 1:
            yield "a frame out of range was not refused in one sentence with exit code 2"


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: check_render.py OUT")
    found = list(problems(sys.argv[1]))
    for problem in found:
        print(f"check_render.py: {problem}", file=sys.stderr)
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
