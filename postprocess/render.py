#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes pictures and films of a run: shaded spheres, translucent walls, force chains.

    postprocess/render.py out/hopper                      the last frame, into out/hopper/picture.png
    postprocess/render.py out/hopper --time 2 --view iso
    postprocess/render.py out/hopper --film               all frames, into out/hopper/film.mp4
    postprocess/render.py out/hopper --chains --clip y    the forces in a cut through the middle

It works without a screen: where DISPLAY is not set it starts itself again under xvfb-run.
Exit codes: 0 done, 2 wrong arguments or something missing, 4 a file of the run is damaged, or a picture cannot
be written.
"""
import argparse
import os
import re
import shutil
import sys
import time
from pathlib import Path

try:
    import numpy
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
except ImportError as error:
    print(f"render.py: {error}: apt install python3-vtk9 python3-numpy, and use /usr/bin/python3.", file=sys.stderr)
    sys.exit(2)

import camera
import grain_picture as picture
from colours import array, colouring, grain_values, round_up
from film import ENCODERS, Film, require_ffmpeg
from read_run import Run, RunError, read_frame
from survey import box_corners, diagonal, grain_corners, points_of, surveyed

LARGE_WALL = 2.0  # a wall larger than this times the room that the grains take is not fitted into the picture
CHAIN_SHARE = 0.97  # of the contacts are no stronger than the thickest chains


def picture_size(text):
    if not re.fullmatch(r"[1-9]\d{1,3}x[1-9]\d{1,3}", text):
        raise argparse.ArgumentTypeError(f"'{text}' is not WIDTHxHEIGHT in pixels, like 1200x900")
    return tuple(int(number) for number in text.split("x"))


def view(text):
    if text not in camera.VIEWS and not camera.view_angles(text):
        raise argparse.ArgumentTypeError(
            f"'{text}' is neither {', '.join(camera.VIEWS)} nor two angles in degrees, like 30,20")
    return text


def clip(text):
    found = re.fullmatch(r"([xyz])(?:=([-+.\deE]+))?", text)
    try:
        return "xyz".index(found[1]), float(found[2]) if found[2] else None
    except (TypeError, ValueError):
        raise argparse.ArgumentTypeError(f"'{text}' is not x, y or z, or with a place in metres, like y=0.01") from None


def numbers(count, example):
    def read(text):
        try:
            values = [float(part) for part in text.split(",")]
        except ValueError:
            values = []
        if len(values) != count or not numpy.all(numpy.isfinite(values)):
            raise argparse.ArgumentTypeError(f"'{text}' is not {count} numbers, like {example}")
        return values
    return read


def zoom(text):
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0.1 <= value <= 100:
        raise argparse.ArgumentTypeError(f"'{text}' is not a number from 0.1 to 100")
    return value


def film_path(text):
    path = Path(text)
    if path.suffix.lower() not in ENCODERS:
        raise argparse.ArgumentTypeError(f"'{text}' does not end in {', '.join(ENCODERS)}")
    return path


def parse_arguments():
    parser = argparse.ArgumentParser(description="Makes pictures and films of a run.")
    parser.add_argument("run", metavar="OUT", help="the folder of a run")
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--frame", type=int, metavar="N", help="counted from 0; -1 is the last, as without this option")
    which.add_argument("--time", type=float, metavar="T", help="the frame nearest to this time in seconds")
    which.add_argument("--all", action="store_true", help="every frame")
    which.add_argument("--film", type=film_path, nargs="?", const=True, metavar="FILE",
                       help="a film of every frame (OUT/film.mp4): .mp4, .webm or .gif")
    parser.add_argument("--rate", type=float, default=25.0, metavar="N", help="frames of a film a second (25)")
    parser.add_argument("--output", type=Path, metavar="PATH",
                        help="a PNG file (OUT/picture.png), with --all a folder (OUT/pictures)")
    parser.add_argument("--force", action="store_true", help="replace a file that --output or --film names")
    parser.add_argument("--size", type=picture_size, metavar="WxH", help="in pixels; shaped to the scene if left out")
    parser.add_argument("--color-by", default="velocity", metavar="ARRAY",
                        help="an array of the frames or a part of it, like velocity_z; x, y, z; or none (velocity)")
    parser.add_argument("--range", type=numbers(2, "0,1.5"), metavar="LOW,HIGH", help="of the colours")
    parser.add_argument("--view", type=view, default="auto", metavar="VIEW",
                        help="front, side, iso, top, or degrees round and above: 30,20; auto: by the scene")
    parser.add_argument("--zoom", type=zoom, default=1.0, metavar="N", help="how many times larger (1)")
    parser.add_argument("--center", type=numbers(3, "0,0,0.1"), metavar="X,Y,Z", help="what is in the middle, in metres")
    parser.add_argument("--clip", type=clip, metavar="AXIS[=AT]",
                        help="leave out what is before this plane: y, through the middle, or y=0.01")
    parser.add_argument("--chains", action="store_true", help="contacts as tubes by their force, grains faint")
    arguments = parser.parse_args()
    if arguments.output and arguments.film is not None:
        parser.error("--output does not go with --film: name the film with --film FILE")
    if not 0 < arguments.rate <= 1000:
        parser.error("--rate is not a number of frames above 0 and up to 1000")
    return arguments


def chosen_frames(frames, arguments):
    """The frames asked for.

    Raises RunError where there are none.
    """
    if not frames:
        raise RunError(f"{arguments.run} holds no frames.")
    if arguments.all or arguments.film is not None:
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


def with_contacts(run, chosen):
    """Pairs of a frame of grains and one of contacts that belong together, for those of the chosen that have one.

    Raises RunError where none has.
    """
    contacts = run.frames("contacts")
    every = run.frames()
    slack = 0.51 * (every[-1].time - every[0].time) / max(1, len(every) - 1) + 1e-9
    pairs = {}
    for frame in contacts:
        nearest = min(chosen, key=lambda grains: abs(grains.time - frame.time))
        if abs(nearest.time - frame.time) <= slack:
            pairs[nearest] = frame
    if not pairs:
        there = f"from {contacts[0].time:g} to {contacts[-1].time:g} s, {len(contacts)} in all" if contacts else "none"
        raise RunError(f"There are no contacts then: the run has frames of contacts {there}; [output] contact_interval "
                       "asks for more.")
    return sorted(pairs.items())


def start_under_xvfb():
    """Starts this program again where VTK, which would abort without a window system, finds one."""
    if not (shutil.which("xvfb-run") and shutil.which("xauth")):
        raise RunError("There is no screen (DISPLAY is not set) and no xvfb-run to stand in for it: apt install xvfb xauth.")
    sys.stdout.flush()
    os.execvp("xvfb-run", ["xvfb-run", "-a", sys.executable, *sys.argv])


def some_grains(grains, kept):
    """Those of the grains for which `kept` holds, with their radii alone."""
    chosen = vtkPolyData()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(numpy.ascontiguousarray(points_of(grains)[kept]), deep=True))
    chosen.SetPoints(points)
    cells = vtkCellArray()
    count = points.GetNumberOfPoints()
    if count:
        cells.InsertNextCell(count, list(range(count)))
    chosen.SetVerts(cells)
    radius = numpy_to_vtk(numpy.ascontiguousarray(array(grains, "radius")[kept]), deep=True)
    radius.SetName("radius")
    chosen.GetPointData().AddArray(radius)
    return chosen


def some_contacts(contacts, clip_plane):
    """The contacts whose middle the clip plane keeps.

    Raises RunError where the frames tell no force.
    """
    force = contacts.GetCellData().GetArray("normal_force")
    if force is None:
        raise RunError("The frames of contacts hold no 'normal_force'; see contact_arrays in the scene's [output].")
    ends = points_of(contacts).reshape(-1, 2, 3)
    kept = clip_plane.keeps(ends.mean(axis=1)) if clip_plane else numpy.ones(len(ends), bool)
    chosen = vtkPolyData()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(numpy.ascontiguousarray(ends[kept].reshape(-1, 3)), deep=True))
    chosen.SetPoints(points)
    cells = vtkCellArray()
    cells.SetData(2, numpy_to_vtkIdTypeArray(numpy.arange(2 * kept.sum(), dtype=numpy.int64), deep=True))
    chosen.SetLines(cells)
    chosen_force = numpy_to_vtk(numpy.ascontiguousarray(vtk_to_numpy(force)[kept]), deep=True)
    chosen_force.SetName("normal_force")
    chosen.GetCellData().AddArray(chosen_force)
    return chosen


class Walls:
    """The walls of one moment: triangles, and apart from them the planes, which have no end, and walls of grains."""

    def __init__(self, run, moment):
        shapes = [wall["shape"] for wall in run.scene().get("wall", [])]
        self.triangles = numpy.empty((0, 3, 3))
        self.wall = numpy.empty(0, int)  # of each triangle
        self.is_grain = numpy.empty(0, bool)  # whether it belongs to a wall of grains
        self.planes = []  # a point and a normal of each
        for series in ("walls", "moving_walls"):
            frames = [frame for frame in run.frames(series) if frame.time <= moment + 1e-9]
            if frames and (walls := read_frame(frames[-1])).GetNumberOfCells():
                self._add(walls, shapes)

    def _add(self, walls, shapes):
        corners = points_of(walls)[vtk_to_numpy(walls.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
        of_triangle = vtk_to_numpy(walls.GetCellData().GetArray("wall"))
        shape = numpy.array([shapes[wall] for wall in of_triangle])
        others = shape != "plane"
        self.triangles = numpy.concatenate([self.triangles, corners[others]])
        self.wall = numpy.concatenate([self.wall, of_triangle[others]])
        self.is_grain = numpy.concatenate([self.is_grain, shape[others] == "grains"])
        for wall in numpy.unique(of_triangle[shape == "plane"]):
            a, b, c = corners[of_triangle == wall][0].astype(float)
            normal = numpy.cross(b - a, c - a)
            self.planes.append((a, normal / numpy.linalg.norm(normal)))

    def corners(self, largest):
        """Lowest and highest corners of the walls not larger than `largest` [m], one below the other."""
        boxes = []
        for wall in numpy.unique(self.wall):
            of_wall = self.triangles[self.wall == wall].reshape(-1, 3)
            boxes.append(numpy.array([of_wall.min(axis=0), of_wall.max(axis=0)]))
        return numpy.concatenate([box for box in boxes if diagonal(box) <= largest] or [numpy.empty((0, 3))])

    def poly_data(self, of_grains):
        """The triangles of walls of grains, or those of the others, as vtkPolyData."""
        triangles = self.triangles[self.is_grain == of_grains]
        poly_data = vtkPolyData()
        points = vtkPoints()
        points.SetData(numpy_to_vtk(numpy.ascontiguousarray(triangles.reshape(-1, 3)), deep=True))
        poly_data.SetPoints(points)
        cells = vtkCellArray()
        cells.SetData(3, numpy_to_vtkIdTypeArray(numpy.arange(3 * len(triangles), dtype=numpy.int64), deep=True))
        poly_data.SetPolys(cells)
        return poly_data


def strongest_chain(run):
    """The force of the thickest chains of a run [N]."""
    forces = [vtk_to_numpy(some_contacts(contacts, None).GetCellData().GetArray("normal_force"))
              for contacts in surveyed(run.frames("contacts")) if contacts.GetNumberOfCells()]
    pressing = numpy.concatenate(forces or [numpy.empty(0)])
    pressing = pressing[pressing > 0.0]  # attraction may hold others that are pulled apart
    return round_up(float(numpy.quantile(pressing, CHAIN_SHARE))) if len(pressing) else 1.0


def common_setting(run, frames, arguments):
    """View, colours and framing: around the grains of the frames to be drawn and the walls near them.

    Raises RunError where the clip plane is looked along, or the colours are of what is not there.
    """
    grains = surveyed(run.frames())
    room = numpy.concatenate([grain_corners(some) for some in grains])
    values = numpy.concatenate([grain_values(some, arguments.color_by) for some in grains])
    drawn = room if len(frames) > 1 else grain_corners(read_frame(frames[0]))
    walls = Walls(run, frames[0].time)
    points = numpy.concatenate([drawn, walls.corners(LARGE_WALL * diagonal(room) if len(room) else numpy.inf)])
    points = box_corners(points if len(points) else numpy.array([[-1.0] * 3, [1.0] * 3]))
    scene = run.scene()
    chosen = camera.chosen_view(arguments.view, scene, points)
    plane = camera.clip_plane(*arguments.clip, chosen, points) if arguments.clip else None
    if arguments.clip and not plane:
        raise RunError("The view looks along the clip plane: choose another with --view or --clip.")
    return picture.Setting(
        chosen, points, colouring(arguments.color_by, values, sorted(scene["materials"]), arguments.range),
        even_size(arguments, chosen, points), arguments.zoom,
        numpy.array(arguments.center) if arguments.center else None, plane,
        strongest_chain(run) if arguments.chains else 0.0)


def even_size(arguments, chosen, points):
    """The size asked for or one that fits; that of a film is even, as its formats want it."""
    size = arguments.size or picture.fitting_size(chosen, points)
    return tuple(side - side % 2 for side in size) if arguments.film is not None else size


def content_of(run, frame, contacts, setting, arguments):
    """What the picture of a frame shows."""
    grains = read_frame(frame)
    values = grain_values(grains, arguments.color_by)
    centres = points_of(grains)
    kept = setting.clip.keeps(centres) if setting.clip else numpy.ones(len(centres), bool)
    walls = Walls(run, frame.time)
    return picture.Content(
        f"{run.title()},  t = {frame.time:.3f} s", some_grains(grains, kept) if len(centres) else grains, values[kept],
        walls.poly_data(of_grains=False), walls.poly_data(of_grains=True), walls.planes,
        some_contacts(read_frame(contacts), setting.clip) if contacts else None)


class Progress:
    """A line on standard error on how far it is, written over on a terminal, every ten seconds elsewhere."""

    def __init__(self, total):
        self.total, self.begin, self.told = total, time.monotonic(), time.monotonic()

    def update(self, done):
        now = time.monotonic()
        left = (now - self.begin) / done * (self.total - done)
        line = f"frame {done} of {self.total}, {int(left) // 60}:{int(left) % 60:02} left"
        if sys.stderr.isatty():
            print(f"\r{line}\033[K", end="\n" if done == self.total else "", file=sys.stderr, flush=True)
        elif now - self.told >= 10 and done < self.total:
            print(line, file=sys.stderr, flush=True)
            self.told = now


def require_new(path, arguments):
    """Raises RunError where the user names a file that is there, without --force."""
    if path.exists() and not arguments.force:
        raise RunError(f"{path} is there already; --force replaces it.")


def make_film(contents, setting, path, rate):
    painter = picture.Painter(setting)
    with Film(path, setting.size, rate) as film:
        for content in contents:
            film.add(painter.pixels(content))
    print(path)


def render(run, frames, arguments):
    """Writes the pictures or the film, and prints their names."""
    pairs = with_contacts(run, frames) if arguments.chains else [(frame, None) for frame in frames]
    setting = common_setting(run, [frame for frame, _ in pairs], arguments)

    def contents():
        progress = Progress(len(pairs))
        for done, (frame, contacts) in enumerate(pairs, start=1):
            yield content_of(run, frame, contacts, setting, arguments)
            if len(pairs) > 1:
                progress.update(done)

    if arguments.film is not None:
        path = run.folder / "film.mp4" if arguments.film is True else arguments.film
        make_film(contents(), setting, path, arguments.rate)
        return
    if arguments.all:
        folder = arguments.output or run.folder / "pictures"
        folder.mkdir(parents=True, exist_ok=True)
        paths = [folder / f"picture_{number:06d}.png" for number in range(len(pairs))]
    else:
        paths = [arguments.output or run.folder / "picture.png"]
    painter = picture.Painter(setting)
    for path, content in zip(paths, contents()):
        path.write_bytes(painter.png(content))
        print(path)


def main():
    arguments = parse_arguments()
    try:
        run = Run(arguments.run)
        frames = chosen_frames(run.frames(), arguments)
        if arguments.film is not None:
            require_ffmpeg()
        if arguments.film not in (None, True):
            require_new(arguments.film, arguments)
        if arguments.output and not arguments.all:
            require_new(arguments.output, arguments)
        if not os.environ.get("DISPLAY"):
            start_under_xvfb()
        render(run, frames, arguments)
    except RunError as error:
        print(f"render.py: {error}", file=sys.stderr)
        sys.exit(error.exit_code)
    except OSError as error:
        print(f"render.py: {error.filename}: {error.strerror}.", file=sys.stderr)
        sys.exit(4)


if __name__ == "__main__":
    main()
