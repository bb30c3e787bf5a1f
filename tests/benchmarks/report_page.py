#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures the page of a run against its bars: how large it is, how long it takes to write, to open and to draw.

    tests/benchmarks/report_page.py [OUT] [--talus PROGRAM]

OUT is a run of the scene hopper, of all its three seconds with contacts every 0.1 s; without one PROGRAM [build/talus]
makes it, which takes some minutes. Pages are drawn by software in headless Chromium, in a window of 1366 x 768 (Debian:
chromium, chromium-driver, python3-selenium). Prints the table of tests/results/report_page.md.
"""
import argparse
import os
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests/support"), str(ROOT / "postprocess")]
from check_viewer import Browser, webdriver  # noqa: E402  found by the line above
from read_run import Run, read_frame  # noqa: E402

COPIES, SPACING = 10, 0.3  # hoppers beside each other, m
DRAWING = 8  # s
TURN = """const done = arguments[arguments.length - 1], { stage } = talus.player, first = stage.drawn, begin = performance.now();
const turn = () => {
  stage.turn(0.03, 0);
  const seconds = (performance.now() - begin) / 1000;
  seconds < SECONDS ? requestAnimationFrame(turn) : done([stage.drawn - first, seconds, stage.ratio]);
};
turn();"""
PLAY = """const done = arguments[arguments.length - 1], { stage } = talus.player, first = stage.drawn, begin = performance.now();
talus.clock.seek(talus.clock.from);
talus.clock.play(true);
setTimeout(() => done([stage.drawn - first, (performance.now() - begin) / 1000, stage.ratio]), 1000 * SECONDS);"""


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", metavar="OUT", nargs="?", type=Path)
    parser.add_argument("--talus", type=Path, default=ROOT / "build/talus", metavar="PROGRAM")
    return parser.parse_args()


def write_page(out, page):
    """Seconds by the clock and of the processor, and megabytes."""
    before, began = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    subprocess.run([sys.executable, ROOT / "postprocess/report.py", out, "--output", page], check=True, capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return time.monotonic() - began, cpu, page.stat().st_size / 1e6


def copies(run, folder):
    """A run of as many hoppers beside each other: the grains of one, again and again."""
    (folder / "frames").mkdir(parents=True)
    for name in ("scene.resolved.toml", "metrics.csv", "summary.json"):
        shutil.copy(run.folder / name, folder)
    listed = []
    for k, frame in enumerate(run.frames()):
        one = read_frame(frame)
        places = vtk_to_numpy(one.GetPoints().GetData())
        arrays = {name: vtk_to_numpy(one.GetPointData().GetArray(name)) for name in ("id", "radius", "material")}
        count = int(run.summary()["ledger"]["inserted"])
        many = vtkPolyData()
        points = vtkPoints()
        points.SetData(numpy_to_vtk(numpy.concatenate([turned(places, 0.7 * n) + [SPACING * (n % 5), SPACING * (n // 5), 0] for n in range(COPIES)])
                                    .astype(numpy.float32), deep=True))
        many.SetPoints(points)
        for name, values in arrays.items():
            array = numpy_to_vtk(numpy.concatenate([values + (count * n if name == "id" else 0) for n in range(COPIES)]), deep=True)
            array.SetName(name)
            many.GetPointData().AddArray(array)
        writer = vtkXMLPolyDataWriter()
        writer.SetFileName(str(folder / f"frames/particles_{k:06d}.vtp"))
        writer.SetInputData(many)
        writer.Write()
        listed.append(f'<DataSet timestep="{frame.time}" file="frames/particles_{k:06d}.vtp"/>')
    (folder / "particles.pvd").write_text(f"<VTKFile type='Collection'><Collection>{''.join(listed)}</Collection></VTKFile>")
    return folder


def turned(places, angle):
    """About z, so that no two hoppers are the same."""
    c, s = numpy.cos(angle), numpy.sin(angle)
    return places @ numpy.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])


def cpu_of(process):
    """Seconds that a process and all those under it have taken."""
    children, seconds = {}, {}
    for path in Path("/proc").glob("[0-9]*/stat"):
        try:
            words = path.read_text().rsplit(")", 1)[1].split()
        except OSError:  # it has just ended
            continue
        children.setdefault(int(words[1]), []).append(int(path.parent.name))
        seconds[int(path.parent.name)] = (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")
    family = [process]
    for one in family:
        family += children.get(one, [])
    return sum(seconds.get(one, 0.0) for one in family)


def draw(browser, script):
    """Pictures a second, processor seconds for one, and how many of the pixels a side were drawn."""
    server = browser.driver.service.process.pid
    before = cpu_of(server)
    pictures, seconds, ratio = browser.driver.execute_async_script(script.replace("SECONDS", str(DRAWING)))
    return f"{pictures / seconds:.1f}; {(cpu_of(server) - before) / max(pictures, 1):.3f} s of the processor each, at {ratio:.2g} of the pixels a side"


def rows(out):
    run = Run(out)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        page, large = folder / "page.html", folder / "large.html"
        wall, cpu, size = write_page(out, page)
        yield "size of the page", "≤ 3 MB", f"{size:.2f} MB"
        yield "writing it", "≤ 20 s", f"{wall:.1f} s, {cpu:.1f} s of the processor"
        browser = Browser(name)
        try:
            browser.open(page.as_uri())
            first = browser.run("return performance.getEntriesByName('first picture')[0].startTime") / 1000
            yield "first picture after opening", "≤ 2 s", f"{first:.2f} s"
            yield "pictures a second, turning", "≥ 20", draw(browser, TURN)
            yield "pictures a second, playing", "≥ 20", draw(browser, PLAY)
            wall, cpu, size = write_page(copies(run, folder / "many"), large)
            yield f"size of a page of {COPIES * run.summary()['ledger']['inserted']:,} spheres".replace(",", " "), "≤ 6 MB", f"{size:.2f} MB"
            yield "writing that", "", f"{wall:.1f} s, {cpu:.1f} s of the processor"
            browser.open(large.as_uri())
            yield "pictures a second of that, turning", "still turning", draw(browser, TURN)
            yield "drawn by", "", f"Chromium {browser.driver.capabilities['browserVersion'].split('.')[0]} without a graphics card"
        finally:
            browser.driver.quit()


def main():
    arguments = parse_arguments()
    if webdriver is None or not shutil.which("chromium") or not shutil.which("chromedriver"):
        sys.exit("report_page.py: apt install chromium chromium-driver python3-selenium")
    with tempfile.TemporaryDirectory() as folder:
        out = arguments.run
        if out is None:
            out = Path(folder) / "hopper"
            subprocess.run([arguments.talus, "run", "hopper", "--quiet", "--set", "output.contact_interval=0.1", "-o", out], check=True)
        print("| what | bar | measured |\n| --- | --- | --- |")
        for row in rows(out):
            print(f"| {' | '.join(row)} |".replace("|  |", "| |"), flush=True)


if __name__ == "__main__":
    main()
