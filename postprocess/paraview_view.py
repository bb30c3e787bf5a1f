#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens a run in ParaView: spheres coloured by speed, translucent walls, contacts as tubes by their force.

    postprocess/paraview_view.py out/hopper                          opens ParaView
    postprocess/paraview_view.py out/hopper --picture hopper.png     without a window, by pvbatch

It needs Debian's paraview and ParaView's Python modules. Exit codes: 0 done, 2 something is missing or wrong.
"""
import os
import shutil
import sys
from pathlib import Path

# The script starts ParaView, in which it runs again; there it gets no arguments, but reads these.
RUN, PICTURE, HOME = "TALUS_VIEW_RUN", "TALUS_VIEW_PICTURE", "TALUS_VIEW_HOME"
simple = None
if RUN in os.environ:
    sys.path.insert(0, os.environ[HOME])
    try:
        from paraview import simple

        import camera
        import colours
        import palette
        import survey
        from read_run import Run
    except ImportError:
        simple = None  # told below

WALL_OPACITY = 0.25
CAMERA_ANGLE = 20.0  # degrees
PICTURE_SIZE = [900, 900]


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
    os.environ[HOME] = str(Path(__file__).resolve().parent)
    os.environ[PICTURE] = str(Path(picture).resolve()) if picture else ""
    script = str(Path(__file__).resolve())
    command = [program, script] if picture else [program, f"--script={script}"]
    if picture and not os.environ.get("DISPLAY"):
        if not shutil.which("xvfb-run"):
            raise ViewError("There is no screen (DISPLAY is not set) and no xvfb-run to stand in for it: apt install xvfb "
                            "xauth.")
        # ParaView closes its first connection; a server that then begins anew would refuse the next
        command = ["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24 -noreset", *command]
    os.execvp(command[0], command)


def series(run, name):
    """A reader of one of the run's series of frames; None where the run has none."""
    path = run.folder / f"{name}.pvd"
    return simple.PVDReader(registrationName=name, FileName=str(path)) if path.is_file() else None


def set_colours(shown, view, name, ramp, colouring):
    """Colours what is shown by a ramp between the limits of a colouring, with a small bar at the top."""
    table = simple.GetColorTransferFunction(name)
    span = colouring.high - colouring.low
    table.RGBPoints = [number for place, colour in ramp for number in (colouring.low + place * span, *colour)]
    table.ColorSpace = "RGB"
    table.AutomaticRescaleRangeMode = "Never"
    bar = simple.GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = colouring.label, ""
    bar.TitleColor = bar.LabelColor = palette.INK
    bar.TitleFontSize = bar.LabelFontSize = 14
    bar.Orientation, bar.WindowLocation = "Horizontal", "Upper Left Corner"
    bar.ScalarBarLength, bar.ScalarBarThickness = 0.25, 12
    bar.AutomaticLabelFormat = 0
    bar.LabelFormat = bar.RangeLabelFormat = "%.3g"
    shown.SetScalarBarVisibility(view, True)


def show_grains(run, view, frames):
    """Spheres of their radius, which the graphics card draws from points, coloured by speed where frames tell it."""
    grains = series(run, "particles")
    shown = simple.Show(grains, view)
    shown.SetRepresentationType("Point Gaussian")
    shown.ShaderPreset = "Sphere"
    shown.GaussianRadius = 1.0
    shown.ScaleByArray = 1
    shown.SetScaleArray = ["POINTS", "radius"]
    shown.UseScaleFunction = 0
    if "velocity" in grains.PointData.keys():
        simple.ColorBy(shown, ("POINTS", "velocity", "Magnitude"))
        speeds = [speed for frame in frames for speed in colours.grain_values(frame, "velocity")]
        set_colours(shown, view, "velocity", palette.RAMP,
                    colours.colouring("velocity", colours.numpy.array(speeds), [], None))
    else:
        shown.ColorArrayName = [None, ""]
        shown.DiffuseColor = palette.SAND
    return grains


def show_walls(run, view):
    for name in ("walls", "moving_walls"):
        walls = series(run, name)
        if walls is None:
            continue
        shown = simple.Show(walls, view)
        shown.SetRepresentationType("Surface")
        shown.ColorArrayName = [None, ""]  # one colour
        shown.DiffuseColor = shown.AmbientColor = palette.WALL
        shown.Opacity = WALL_OPACITY


def show_contacts(run, view, frames):
    """Tubes as thick as their force, ready in the pipeline but hidden, as they lie inside the grains: to see them, hide
    the grains or make them translucent."""
    contacts = series(run, "contacts")
    if contacts is None or "normal_force" not in contacts.CellData.keys():
        return
    radius = sum(sum(frame.GetPointData().GetArray("radius").GetRange()) / 2 for frame in frames) / len(frames)
    at_ends = simple.CellDatatoPointData(registrationName="forces at ends", Input=contacts)
    tubes = simple.Tube(registrationName="force chains", Input=at_ends)
    tubes.Scalars = ["POINTS", "normal_force"]
    tubes.VaryRadius = "By Scalar"
    tubes.Radius, tubes.RadiusFactor = 0.05 * radius, 8.0
    tubes.NumberofSides = 8
    shown = simple.Show(tubes, view)
    simple.ColorBy(shown, ("POINTS", "normal_force"))
    for hidden in (contacts, at_ends, tubes):
        simple.Hide(hidden, view)


def aim(run, view, frames):
    """As the pictures of render.py, at the room that the grains take during the run."""
    points = survey.box_corners(colours.numpy.concatenate([survey.grain_corners(frame) for frame in frames]))
    chosen = camera.chosen_view("auto", run.scene(), points)
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    distance = 0.65 * survey.diagonal(points) / colours.numpy.tan(colours.numpy.radians(CAMERA_ANGLE / 2))
    view.CameraViewAngle = CAMERA_ANGLE
    view.CameraFocalPoint = list(middle)
    view.CameraPosition = list(middle + distance * chosen.towards_eye)
    view.CameraViewUp = list(chosen.above)
    view.CenterOfRotation = list(middle)


def set_up(run):
    """The run in ParaView's view, at its last frame."""
    frames = [frame for frame in survey.surveyed(run.frames()) if frame.GetNumberOfPoints()]
    simple._DisableFirstRenderCameraReset()  # as ParaView's own scripts do: the camera stays as it is aimed
    view = simple.GetActiveViewOrCreate("RenderView")
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    view.OrientationAxesLabelColor = palette.INK
    grains = show_grains(run, view, frames)
    show_walls(run, view)
    show_contacts(run, view, frames)
    simple.SetActiveSource(grains)
    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.GoToLast()
    if frames:
        aim(run, view, frames)
    simple.Render(view)
    return view


def main():
    if RUN not in os.environ:
        start(sys.argv[1:])
    if simple is None:
        raise ViewError("ParaView finds no Python modules of its own: apt install python3-paraview, or, beside libvtk9-dev, "
                        "as postprocess/README.md says.")
    view = set_up(Run(os.environ[RUN]))
    if picture := os.environ.get(PICTURE):
        view.ViewSize = PICTURE_SIZE
        simple.SaveScreenshot(picture, view, ImageResolution=PICTURE_SIZE)
        print(picture)


try:
    main()
except ViewError as error:
    print(f"paraview_view.py: {error}", file=sys.stderr)
    sys.exit(2)
