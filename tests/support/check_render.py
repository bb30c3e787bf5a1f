#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that postprocess/render.py draws grains, cuts, force chains and films, and refuses what is not there.

    tests/support/check_render.py OUT        a run whose last frame holds grains

Exit codes: 0 it does, 1 it does not.
"""
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "postprocess"))
from read_run import Run  # noqa: E402  found by the line above

RENDER = Path(__file__).resolve().parents[2] / "postprocess" / "render.py"


def render(*arguments):
    return subprocess.run([sys.executable, RENDER, *arguments], capture_output=True, text=True, check=False)


def colours(png):
    """Red, green and blue of the pixels."""
    reader = vtkPNGReader()
    reader.SetFileName(str(png))
    reader.Update()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).astype(int).T[:3]


def sandy_share(png):
    """Share of the pixels that are sand-coloured, as grains are and walls, text and background are not."""
    red, _, blue = colours(png)
    return float(numpy.mean(red - blue > 25))


def chain_share(png):
    """Share of the pixels below title and colour bar that are blue, purple or red, as force chains are."""
    red, green, blue = colours(png)
    coloured = (blue - red > 40) | (red - green > 60)
    return float(numpy.mean(coloured[:int(0.8 * len(coloured))]))  # rows come from below


def is_refused(outcome):
    return outcome.returncode == 2 and len(outcome.stderr.splitlines()) == 1


def film_problems(run, folder):
    """A film of every frame, in each format, where there is ffmpeg."""
    frames = len(Run(run).frames())
    for ending in ("mp4", "webm", "gif"):
        film = Path(folder) / f"film.{ending}"
        made = render(run, "--film", film, "--size", "97x65", "--color-by", "none")
        if not shutil.which("ffmpeg"):
            if not is_refused(made) or "ffmpeg" not in made.stderr:
                yield "a film without ffmpeg was not refused in one sentence with exit code 2"
            print("left out: films, as there is no ffmpeg")
            return
        counted = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries", "stream=nb_read_frames",
                                  "-of", "csv=p=0", film], capture_output=True, text=True, check=False)
        if made.returncode or counted.stdout.strip().strip(",") != str(frames):
            yield f"{film.name} has {counted.stdout.strip() or 'no'} frames of {frames}: {made.stderr.strip()}"


def problems(run):
    """What is wrong, a sentence each."""
    with tempfile.TemporaryDirectory() as folder:
        png, cut, chains = (Path(folder) / f"{name}.png" for name in ("picture", "cut", "chains"))
        plain = ("--color-by", "none", "--size", "400x300")
        drawn = render(run, *plain, "--output", png)
        if drawn.returncode != 0 or not png.is_file():
            yield f"no picture was written: {drawn.stderr.strip()}"
        elif sandy_share(png) < 0.01:
            yield "the picture shows no grains"
        elif render(run, *plain, "--output", cut, "--clip", "y=1000").returncode or sandy_share(cut) > 0:
            yield "grains before the clip plane are drawn"
        elif not is_refused(render(run, *plain, "--output", png)):
            yield "a picture that is there was replaced without --force"
        forces = render(run, "--chains", "--size", "400x300", "--output", chains)
        if forces.returncode or not chain_share(chains) > chain_share(png):
            yield f"no force chains were drawn: {forces.stderr.strip()}"
        for color_by in ("material", "velocity_z", "x", "radius"):
            if render(run, "--color-by", color_by, "--size", "100x80", "--force", "--output", cut).returncode:
                yield f"grains cannot be coloured by {color_by}"
        for what, arguments in (("a folder without a run", [folder]), ("a frame out of range", [run, "--frame", "1000000"]),
                                ("an array that is not there", [run, "--color-by", "fish"]),
                                ("a cut along the view", [run, "--view", "front", "--clip", "x"])):
            if not is_refused(render(*arguments)):
                yield f"{what} was not refused in one sentence with exit code 2"
        yield from film_problems(run, folder)


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: check_render.py OUT")
    found = list(problems(sys.argv[1]))
    for problem in found:
        print(f"check_render.py: {problem}", file=sys.stderr)
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
