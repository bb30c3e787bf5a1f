#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes pictures of a run: shaded spheres, translucent walls.

    postprocess/render.py out/hopper                      the last frame, into out/hopper/picture.png
    postprocess/render.py out/hopper --time 2 --view iso
    postprocess/render.py out/hopper --all                every frame, into out/hopper/pictures/

It works without a screen: where DISPLAY is not set it starts itself again under xvfb-run.
Exit codes: 0 done, 2 wrong arguments or something missing, 4 a picture cannot be written.
"""
import argparse
import os
import re
import shutil
import sys
from pathlib import Path

try:
    import numpy
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonDataModel import vtkPolyData
    from vtkmodules.vtkFiltersCore import vtkAppendPolyData
except ImportError as error:
    print(f"render.py: {error}: apt install python3-vtk9 python3-numpy, and use /usr/bin/python3.", file=sys.stderr)
    sys.exit(2)

import grain_picture as picture
from read_run import Run, RunError, read_frame

SURVEYED_FRAMES = 10  # frames looked at for what all pictures of a run share, spread evenly over it
LARGE_WALL = 2.0  # a wall larger than this times the room that the grains take is not fitted into the picture


def picture_size(text):
    if not re.fullmatch(r"[1-9]\d{1,3}x[1-9]\d{1,3}", text):
        raise argparse.ArgumentTypeError(f"'{text}' is not WIDTHxHEIGHT in pixels, like 1200x900")
    return tuple(int(number) for number in text.split("x"))


def parse_arguments():
    parser = argparse.ArgumentParser(description="Makes pictures of a run.")
    parser.add_argument("run", metavar="OUT", help="the folder of a run")
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--frame", type=int, metavar="N", help="counted from 0; -1 is the last, as without this option")
    which.add_argument("--time", type=float, metavar="T", help="the frame nearest to this time in seconds")
    which.add_argument("--all", action="store_true", help="every frame")
    parser.add_argument("--output", type=Path, metavar="PATH",
                        help="a PNG file (OUT/picture.png), with --all a folder (OUT/pictures)")
    parser.add_argument("--size", type=picture_size, metavar="WxH", help="in pixels; shaped to the scene if left out")
    parser.add_argument("--color-by", choices=["velocity", "radius", "id", "material", "none"], default="velocity")
    parser.add_argument("--view", choices=list(picture.VIEWS), default="front")
    return parser.parse_args()


def chosen_frames(frames, arguments):
    """The frames asked for.

    Raises RunError where there are none.
    """
    if not frames:
        raise RunError(f"{arguments.run} holds no frames.")
    if arguments.all:
        return frames
    if arguments.time is not None:
        first, last = frames[0].time, frames[-1].time
        slack = (last - first) / max(1, len(frames) - 1)
        if not first - slack <= arguments.time <= last + slack:
            raise RunError(f"There is no frame at {arguments.time:g} s: the run has frames from {first:g} to {last:g} s.")
        return [min(frames, key=lambda frame: abs(frame.time - arguments.time))]
    number = -1 if arguments.frame is None else arguments.frame
    if not -len(frames) <= number < len(frames):
        raise RunError(f"There is no frame {number}: the run has frames 0 to {len(frames) - 1}.")
    return [frames[number]]


def start_under_xvfb():
    """Starts this program again where VTK, which would abort without a window system, finds one."""
    if not (shutil.which("xvfb-run") and shutil.which("xauth")):
        raise RunError("There is no screen (DISPLAY is not set) and no xvfb-run to stand in for it: apt install xvfb xauth.")
    sys.stdout.flush()
    os.execvp("xvfb-run", ["xvfb-run", "-a", sys.executable, *sys.argv])


def array(poly_data, name):
    values = poly_data.GetPointData().GetArray(name)
    if values is None:
        raise RunError(f"The frames hold no '{name}'; see particle_arrays in the scene's [output].")
    return vtk_to_numpy(values)


def colour_values(grains, color_by):
    """A number for each grain."""
    if color_by == "none" or not grains.GetNumberOfPoints():
        return numpy.zeros(grains.GetNumberOfPoints())
    if color_by == "velocity":
        return numpy.linalg.norm(array(grains, "velocity"), axis=1)
    return array(grains, color_by) * (1e3 if color_by == "radius" else 1)


def round_up(value):
    """The next of 1, 2, 5, 10, …"""
    power = 10.0 ** numpy.floor(numpy.log10(value))
    return next(step * power for step in (1, 2, 5, 10) if step * power >= 0.999 * value)


def colouring(color_by, values):
    """How values like these are coloured; speeds above half the greatest share the last colour."""
    if color_by == "none" or not values.size:
        return picture.Colouring("", 0.0, 1.0)
    if color_by == "velocity":
        fast = float(values.max()) / 2
        return picture.Colouring("speed [m/s]", 0.0, round_up(fast) if fast > 0 else 1.0)
    if color_by == "material":
        steps = max(2, int(values.max()) + 1)
        return picture.Colouring("material", 0.0, steps - 1.0, steps)
    low, high = (float(f"{value:.3g}") if color_by == "radius" else float(value) for value in (values.min(), values.max()))
    return picture.Colouring("radius [mm]" if color_by == "radius" else "id", low, high if high > low else low + 1.0)


def grain_corners(grains):
    """Lowest and highest corner of the box around the grains; no rows where there are none."""
    if not grains.GetNumberOfPoints():
        return numpy.empty((0, 3))
    centres, radii = vtk_to_numpy(grains.GetPoints().GetData()), array(grains, "radius")[:, None]
    return numpy.array([(centres - radii).min(axis=0), (centres + radii).max(axis=0)])


def wall_corners(walls, largest):
    """Lowest and highest corners of the walls not larger than `largest` [m], one below the other."""
    if not walls.GetNumberOfCells():
        return numpy.empty((0, 3))
    triangles = vtk_to_numpy(walls.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    corners = vtk_to_numpy(walls.GetPoints().GetData())[triangles]
    wall_of_triangle = vtk_to_numpy(walls.GetCellData().GetArray("wall"))
    boxes = []
    for wall in numpy.unique(wall_of_triangle):
        of_wall = corners[wall_of_triangle == wall].reshape(-1, 3)
        boxes.append(numpy.array([of_wall.min(axis=0), of_wall.max(axis=0)]))
    return numpy.concatenate([box for box in boxes if diagonal(box) <= largest] or [numpy.empty((0, 3))])


def diagonal(points):
    return float(numpy.linalg.norm(numpy.ptp(points, axis=0))) if len(points) else 0.0


def box_corners(points):
    """The eight corners of the box around the points."""
    return numpy.array(numpy.meshgrid(*zip(points.min(axis=0), points.max(axis=0)))).reshape(3, 8).T


def walls_at(run, time):
    """The walls that stand at that time, where they are then."""
    all_walls = vtkAppendPolyData()
    all_walls.AddInputData(vtkPolyData())
    for series in ("walls", "moving_walls"):
        frames = [frame for frame in run.frames(series) if frame.time <= time + 1e-9]
        if frames and (walls := read_frame(frames[-1])).GetNumberOfCells():
            all_walls.AddInputData(walls)
    all_walls.Update()
    return all_walls.GetOutput()


def common_setting(run, frames, arguments):
    """View, colours and framing: around the grains of the frames to be drawn and the walls near them."""
    every = run.frames()
    spread = numpy.unique(numpy.linspace(0, len(every) - 1, SURVEYED_FRAMES).round().astype(int))
    surveyed = [read_frame(every[index]) for index in spread]
    room = numpy.concatenate([grain_corners(grains) for grains in surveyed])
    values = numpy.concatenate([colour_values(grains, arguments.color_by) for grains in surveyed])

    drawn = room if len(frames) > 1 else grain_corners(read_frame(frames[0]))
    walls = walls_at(run, frames[0].time)
    points = numpy.concatenate([drawn, wall_corners(walls, LARGE_WALL * diagonal(room) if len(room) else numpy.inf)])
    points = box_corners(points if len(points) else numpy.array([[-1.0] * 3, [1.0] * 3]))
    size = arguments.size or picture.fitting_size(arguments.view, points)
    return picture.Setting(arguments.view, points, colouring(arguments.color_by, values), size)


def render(run, frames, arguments):
    """Writes the pictures and prints their names."""
    setting = common_setting(run, frames, arguments)
    if arguments.all:
        folder = arguments.output or run.folder / "pictures"
        folder.mkdir(parents=True, exist_ok=True)
        paths = [folder / f"picture_{number:06d}.png" for number in range(len(frames))]
    else:
        paths = [arguments.output or run.folder / "picture.png"]
    for path, frame in zip(paths, frames):
        grains = read_frame(frame)
        values = colour_values(grains, arguments.color_by)
        title = f"{run.title()},  t = {frame.time:.3f} s"
        picture.write_picture(path, grains, values, walls_at(run, frame.time), title, setting)
        print(path)


def main():
    arguments = parse_arguments()
    try:
        run = Run(arguments.run)
        frames = chosen_frames(run.frames(), arguments)
        if not os.environ.get("DISPLAY"):
            start_under_xvfb()
        render(run, frames, arguments)
    except RunError as error:
        print(f"render.py: {error}", file=sys.stderr)
        sys.exit(2)
    except OSError as error:
        print(f"render.py: {error.filename}: {error.strerror}.", file=sys.stderr)
        sys.exit(4)


if __name__ == "__main__":
    main()
