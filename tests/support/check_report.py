#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks the pages of postprocess/report.py and compare.py without a browser: what they hold is what the frames hold, they
need nothing from outside, names stay text, and what is not there is refused.

    tests/support/check_report.py OUT        a run of hostile_names.toml

Exit codes: 0 all is well, 1 it is not.
"""
import base64
import html
import json
import shutil
import subprocess
import sys
import tempfile
import zlib
from html.parser import HTMLParser
from pathlib import Path

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

POSTPROCESS = Path(__file__).resolve().parents[2] / "postprocess"
sys.path.insert(0, str(POSTPROCESS))
from read_run import Run, read_frame  # noqa: E402  found by the line above
from run_page.sections import changes  # noqa: E402


def call(script, *arguments):
    return subprocess.run([sys.executable, POSTPROCESS / script, *map(str, arguments)], capture_output=True, text=True, check=False)


class Page(HTMLParser):
    """The elements of a page, and the texts of its scripts by their ids."""

    def __init__(self, path):
        super().__init__()
        self.elements, self.scripts, self.title = [], {}, ""
        self.inside, self.id = "", ""
        self.feed(Path(path).read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        self.elements.append((tag, dict(attrs)))
        self.inside, self.id = tag, dict(attrs).get("id") or ""

    def handle_endtag(self, tag):
        self.inside = ""

    def handle_data(self, data):
        if self.inside == "script":
            self.scripts[self.id] = self.scripts.get(self.id, "") + data
        elif self.inside == "title":
            self.title += data

    def data(self):
        return json.loads(self.scripts["data"])

    def blob(self, key):
        return zlib.decompress(base64.b64decode(self.scripts[f"blob-{key}"]))


def unzigzag(planes):
    """Whole numbers from rows of bytes, the lowest first."""
    unsigned = sum(row.astype(numpy.int64) << (8 * byte) for byte, row in enumerate(planes))
    return (unsigned >> 1) ^ -(unsigned & 1)


def frames_of(page, frames):
    """Ids and positions [m] of each frame that the page plays, read by its format alone."""
    for group in frames["groups"]:
        raw = numpy.frombuffer(page.blob(group["blob"]), dtype=numpy.uint8)
        n, count, width = group["slots"], group["count"], group["width"]
        ids = numpy.cumsum(unzigzag(raw[:4 * n].reshape(4, n)))
        bits, at = (n + 7) // 8, 4 * n
        changes = raw[at:at + count * bits].reshape(count, bits)
        there = numpy.bitwise_xor.accumulate(numpy.unpackbits(changes, axis=1, count=n, bitorder="little"), axis=0).astype(bool)
        steps = unzigzag(raw[at + count * bits:].reshape(count, 3, width, n).transpose(2, 0, 1, 3))
        places = numpy.cumsum(steps, axis=0).transpose(0, 2, 1) * frames["quantum"] + numpy.array(frames["origin"])
        for k in range(count):
            yield ids[there[k]], places[k][there[k]]


def problems_of_frames(run, page):
    frames = page.data()["frames"]
    listed = run.frames()
    played = list(frames_of(page, frames))
    if [listed[number].time for number in frames["numbers"]] != frames["times"] or len(played) != len(frames["times"]):
        yield "the times of the frames are not those of the run"
    for number, (ids, places) in zip(frames["numbers"], played):
        data = read_frame(listed[number])
        true_ids = vtk_to_numpy(data.GetPointData().GetArray("id"))
        true_places = vtk_to_numpy(data.GetPoints().GetData())
        if not numpy.array_equal(ids, true_ids):
            yield f"frame {number} has other grains than the run"
        elif numpy.abs(places - true_places).max() > 0.501 * frames["quantum"]:
            yield f"frame {number} has grains elsewhere than the run"
    spheres = frames["spheres"]
    raw = numpy.frombuffer(page.blob(spheres["blob"]), dtype=numpy.uint8)[4 * spheres["count"]:]
    levels = raw[:spheres["count"]] + 256.0 * raw[spheres["count"]:2 * spheres["count"]]
    radii = spheres["low"] + (spheres["high"] - spheres["low"]) * levels / 65535
    first = read_frame(listed[0]).GetPointData()
    if numpy.abs(radii - vtk_to_numpy(first.GetArray("radius"))).max() > 1e-4 * spheres["high"]:
        yield "radii are not those of the run"
    if not numpy.array_equal(raw[2 * spheres["count"]:], vtk_to_numpy(first.GetArray("material"))):
        yield "materials are not those of the run"


def problems_of_text(run, page):
    """Names stay text, and nothing is asked for from outside."""
    known = {"html", "head", "meta", "title", "link", "style", "body", "header", "div", "span", "h1", "h2", "p", "b", "small", "main",
             "section", "img", "table", "thead", "tbody", "tr", "th", "td", "i", "pre", "code", "details", "summary", "footer", "script"}
    for tag, attributes in page.elements:
        address = attributes.get("src") or attributes.get("href") or "data:"
        if tag not in known or any(name.startswith("on") for name in attributes) or not address.startswith("data:"):
            yield f"the page holds the element <{tag} {attributes}>"
    for wanted in (run.title(), run.scene()["sensor"][0]["name"]):
        if wanted not in json.dumps(page.data(), ensure_ascii=False).replace("\\\\", "\\").replace('\\"', '"'):
            yield f"the name {wanted} does not come through"
    if page.title != f"{run.title()} · Talus":
        yield f"the page has the title {page.title}"
    for told in run.summary()["explanations"].values():
        if html.escape(told) not in page.data()["sections"]["modelled"]:
            yield f"what the run tells of itself does not come through: {told}"
    if page.data()["status"] != "done":
        yield "the run is not said to be done"


def problems_of_changes():
    seen, bound, unknown = {"error": 0.0012, "seen": True}, {"error": 0.003, "seen": False}, {"error": None, "seen": False}
    for result, wanted in (({"step": seen, "solver": bound}, "<span>step ± 0.0012 · solver ± below 0.003</span>"),
                           ({"step": unknown, "solver": unknown}, "<span>step ± ? · solver ± ?</span>"), ({"value": 1.0}, "")):
        if changes(result) != wanted:
            yield f"what companions found of {result} is reported as {changes(result)}"


def problems_of_refusals(run, folder):
    elsewhere = call("report.py", folder)
    if elsewhere.returncode != 2 or len(elsewhere.stderr.splitlines()) != 1:
        yield "a folder without a run was not refused in one sentence with exit code 2"
    notes = folder / "notes.html"
    notes.write_text("my own")
    if call("report.py", run.folder, "--output", notes).returncode != 2 or notes.read_text() != "my own":
        yield "a file that is no page was overwritten"
    if call("report.py", run.folder, "--output", folder / "nowhere" / "page.html").returncode != 4:
        yield "a page that cannot be written did not end with exit code 4"


def problems_of_killed(run, folder):
    """A run that was killed in the middle of a row."""
    killed = folder / "killed"
    shutil.copytree(run.folder, killed, ignore=shutil.ignore_patterns("summary.json", "report.html"))
    metrics = killed / "metrics.csv"
    metrics.write_text(metrics.read_text()[:-7])
    made = call("report.py", killed)
    if made.returncode != 0:
        yield f"a run that was killed has no page: {made.stderr.strip()}"
    elif Page(killed / "report.html").data()["status"] != "ended":
        yield "a run that was killed is not said to be broken off"
    (killed / "particles.pvd").unlink()
    metrics.unlink()
    if call("report.py", killed).returncode != 0:
        yield "a run that was killed before its first frame has no page"


def problems_of_damage(run, folder):
    def page_of(damage):
        copy = folder / "damaged"
        shutil.rmtree(copy, ignore_errors=True)
        shutil.copytree(run.folder, copy)
        damage(copy / run.frames()[1].path.relative_to(run.folder))
        return call("report.py", copy)

    cut = page_of(lambda frame: frame.write_bytes(frame.read_bytes()[:-200]))
    if cut.returncode != 4 or not cut.stderr.endswith("is damaged: it is cut short.\n") or cut.stderr.count("\n") != 1:
        yield f"a frame that is cut short did not end in one sentence with exit code 4: {cut.stderr}"
    gone = page_of(Path.unlink)
    if gone.returncode != 4 or "is not there, though the run lists it" not in gone.stderr:
        yield f"a frame that is gone did not end with exit code 4: {gone.stderr}"


def problems_of_comparison(run, folder):
    page = folder / "compare.html"
    made = call("compare.py", run.folder, run.folder, "--output", page)
    if made.returncode != 0:
        yield f"two runs were not compared: {made.stderr.strip()}"
        return
    data = Page(page).data()
    if len(data["runs"]) != 2 or data["runs"][0]["label"] == data["runs"][1]["label"]:
        yield "two runs are not told apart"
    if call("compare.py", run.folder).returncode != 2:
        yield "one run was compared with nothing"


def problems(out):
    run = Run(out)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        made = call("report.py", out, "--output", folder / "report.html")
        if made.returncode != 0:
            yield f"no page was written: {made.stderr.strip()}"
            return
        page = Page(folder / "report.html")
        yield from problems_of_frames(run, page)
        yield from problems_of_text(run, page)
        yield from problems_of_changes()
        yield from problems_of_refusals(run, folder)
        yield from problems_of_killed(run, folder)
        yield from problems_of_damage(run, folder)
        yield from problems_of_comparison(run, folder)


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: check_report.py OUT")
    found = list(problems(sys.argv[1]))
    for problem in found:
        print(f"check_report.py: {problem}", file=sys.stderr)
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
