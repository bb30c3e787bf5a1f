#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens a run in ParaView: spheres coloured by speed, translucent walls, contacts as tubes by their force.

    postprocess/paraview_view.py out/hopper                          opens ParaView
    postprocess/paraview_view.py out/hopper --picture hopper.png     without a window, by pvbatch

It needs Debian's paraview and ParaView's Python modules. Exit codes: 0 done, 2 something is missing or wrong.
"""
import os
import re
import shutil
import sys
import tomllib
from pathlib import Path

try:
    from paraview import simple
except ImportError:
    simple = None  # as in Debian's Python: this starts ParaView, in which it runs again

RUN, PICTURE = "TALUS_VIEW_RUN", "TALUS_VIEW_PICTURE"  # what the script in ParaView is told: it gets no arguments
WALL = [0.50, 0.57, 0.66]


class ViewError(Exception):
    """What keeps a run from being seen; one sentence for the user."""


def start(arguments):
    """Starts ParaView, or pvbatch for a picture, with this script."""
    if not arguments or len(arguments) not in (1, 3) or arguments[1:2] not in ([], ["--picture"]) or \
            arguments[0].startswith("-"):
        raise ViewError("usage: paraview_view.py OUT [--picture PNG]")
    run, picture = Path(arguments[0]), arguments[2] if len(arguments) == 3 else ""
    if not (run / "particles.pvd").is_file():
        raise ViewError(f"{run} holds no run of Talus with frames: it has no particles.pvd.")
    program = "pvbatch" if picture else "paraview"
    if not shutil.which(program):
        raise ViewError(f"There is no {program}: apt install --no-install-recommends paraview.")
    os.environ[RUN] = str(run.resolve())
    os.environ[PICTURE] = str(Path(picture).resolve()) if picture else ""
    script = str(Path(__file__).resolve())
    command = [program, script] if picture else [program, f"--script={script}"]
    if picture and not os.environ.get("DISPLAY"):
        if not shutil.which("xvfb-run"):
            raise ViewError("There is no screen (DISPLAY is not set) and no xvfb-run to stand in for it: apt install xvfb "
                            "xauth.")
        command = ["xvfb-run", "-a", *command]
    os.execvp(command[0], command)


def series(run, name):
    """A reader of one of the run's series of frames; None where the run has none."""
    path = run / f"{name}.pvd"
    return simple.PVDReader(registrationName=name, FileName=str(path)) if path.is_file() else None


def show_grains(run, view):
    """Spheres of their radius, which the graphics card draws from points."""
    grains = series(run, "particles")
    shown = simple.Show(grains, view)
    shown.SetRepresentationType("Point Gaussian")
    shown.ShaderPreset = "Sphere"
    shown.GaussianRadius = 1.0
    shown.ScaleByArray = 1
    shown.SetScaleArray = ["POINTS", "radius"]
    shown.UseScaleFunction = 0
    point_arrays = grains.PointData.keys()
    if "velocity" in point_arrays:
        simple.ColorBy(shown, ("POINTS", "velocity", "Magnitude"))
        shown.RescaleTransferFunctionToDataRangeOverTime()
        shown.SetScalarBarVisibility(view, True)
        bar = simple.GetScalarBar(simple.GetColorTransferFunction("velocity"), view)
        bar.Title, bar.ComponentTitle = "speed [m/s]", ""
        bar.TitleColor = bar.LabelColor = [0.0, 0.0, 0.0]
    return grains


def show_walls(run, view):
    for name in ("walls", "moving_walls"):
        walls = series(run, name)
        if walls is None:
            continue
        shown = simple.Show(walls, view)
        shown.SetRepresentationType("Surface")
        shown.ColorArrayName = [None, ""]  # one colour
        shown.DiffuseColor = shown.AmbientColor = WALL
        shown.Opacity = 0.25


def show_contacts(run, view):
    """Tubes by their force; there at hand, but not shown at first, as they would hide in the grains."""
    contacts = series(run, "contacts")
    if contacts is None or "normal_force" not in contacts.CellData.keys():
        return
    at_points = simple.CellDatatoPointData(registrationName="contact forces", Input=contacts)
    at_points.PassCellData = 1
    tubes = simple.Tube(registrationName="force chains", Input=at_points)
    tubes.Scalars = ["POINTS", "normal_force"]
    tubes.VaryRadius = "By Scalar"
    tubes.NumberofSides = 8
    tubes.Radius = 0.05 * mean_diameter(run)
    tubes.RadiusFactor = 8.0
    shown = simple.Show(tubes, view)
    simple.ColorBy(shown, ("POINTS", "normal_force"))
    simple.Hide(tubes, view)
    simple.Hide(contacts, view)


def mean_diameter(run):
    """Of the spheres of the last frame [m]."""
    grains = simple.FindSource("particles")
    times = grains.TimestepValues
    grains.UpdatePipeline(times[-1] if hasattr(times, "__len__") else times)
    low, high = grains.PointData["radius"].GetRange()
    return low + high


def look_along(run, view):
    """From the front, with gravity downwards, as in the pictures of render.py."""
    with open(run / "scene.resolved.toml", "rb") as file:
        gravity = tomllib.load(file)["world"]["gravity"]
    size = sum(component ** 2 for component in gravity) ** 0.5
    up = [-component / size for component in gravity] if size > 0 else [0.0, 0.0, 1.0]
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0.0, -1.0, 0.2], [0.0, 0.0, 0.0], up
    simple.ResetCamera(view)


def set_up(run):
    """The run in ParaView's view, at its last frame."""
    view = simple.GetActiveViewOrCreate("RenderView")
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    view.OrientationAxesLabelColor = [0.0, 0.0, 0.0]
    grains = show_grains(run, view)
    show_walls(run, view)
    show_contacts(run, view)
    simple.SetActiveSource(grains)
    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.GoToLast()
    look_along(run, view)
    simple.Render(view)
    return view


def main():
    if RUN not in os.environ:
        start(sys.argv[1:])
    if simple is None:
        raise ViewError("ParaView finds no Python modules of its own: apt install python3-paraview, or, beside libvtk9-dev, "
                        "as postprocess/README.md says.")
    view = set_up(Path(os.environ[RUN]))
    if picture := os.environ.get(PICTURE):
        simple.SaveScreenshot(picture, view, ImageResolution=[900, 900])
        print(picture)


try:
    main()
except ViewError as error:
    print(f"paraview_view.py: {error}", file=sys.stderr)
    sys.exit(2)
