# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of a run: what the viewer plays, the words around it, and both as one HTML file."""
import base64
import json
import re
from pathlib import Path

import numpy

from run_page.charts import pack_charts, pack_profiles
from run_page.contacts import pack_contacts
from run_page.playback import Playback
from run_page.sections import STATUS, all_sections, text
from run_page.still import still
from run_page.walls import pack_walls
from run_page.writing import strict

VIEWER = Path(__file__).resolve().parent.parent / "viewer"


class RunPage:
    """The page of a run; `update` looks again at a run that goes on."""

    def __init__(self, run, most_frames=None, live=False):
        self.run, self.most_frames = run, most_frames
        self.playback = Playback(live)

    def update(self):
        """What the viewer needs as plain data, and the blobs that this names by their keys."""
        run = self.run
        frames, blobs = self.playback.pack(run, self.most_frames)
        walls, wall_blobs = pack_walls(run, frames["times"])
        contacts, contact_blobs = pack_contacts(run, frames["times"])
        charts, chart_blobs = pack_charts(run)
        scene = run.scene()
        status = status_of(run)
        facts = {"most_grains": frames["spheres"]["count"], "last_time": frames["times"][-1] if frames["times"] else None}
        data = {"title": run.title(), "folder": str(run.folder), "status": status, "status_word": STATUS[status],
                "duration": scene.get("time", {}).get("duration"),
                "frames": frames, "walls": walls, "contacts": contacts, "charts": charts, "profiles": pack_profiles(run),
                "materials": sorted(scene.get("materials", {})), "periods": periods(scene),
                "gravity": scene.get("world", {}).get("gravity", [0, 0, -9.81]), "heaps": heaps(scene),
                "sections": all_sections(run, facts)}
        return data, {**blobs, **wall_blobs, **contact_blobs, **chart_blobs}

    def picture(self, data):
        """The frame that the page opens with, as a JPEG; nothing where the run has no frames."""
        frames = self.run.frames()
        numbers = data["frames"]["numbers"]
        if not numbers:
            return None
        best = data["frames"]["best"]
        beside = min(best + 1, len(numbers) - 1)
        here, there = (frames[numbers[k]] for k in (best, beside))
        grains, radii, _ = self.playback.read_of(here)
        later, _, _ = self.playback.read_of(there)
        values = numpy.zeros(len(grains.ids))
        _, a, b = numpy.intersect1d(grains.ids, later.ids, assume_unique=True, return_indices=True)
        step = max(there.time - here.time, 1e-30)
        if data["frames"]["fastest"] > 0:
            values[a] = numpy.linalg.norm(later.positions[b] - grains.positions[a], axis=1) / step / (data["frames"]["fastest"] / 2)
        return still(grains.positions.astype(float), radii.astype(float), numpy.clip(values, 0, 1), data["frames"]["box"])


def status_of(run):
    """done, failed or interrupted as the summary says; without one running, if a process holds the folder, or ended."""
    status = run.summary().get("status")
    return status if status in STATUS else "running" if run.is_going_on() else "ended"


def unbroken(title):
    """With the digits of 10 000 kept in one line."""
    return re.sub(r"(?<=\d) (?=\d{3}\b)", "\u00a0", title)


def periods(scene):
    """Length of the world along each axis, 0 where it does not repeat itself."""
    world = scene.get("world", {})
    return [world["max"][k] - world["min"][k] if axis in world.get("periodic", []) else 0 for k, axis in enumerate("xyz")]


def heaps(scene):
    """The sensors whose surface the viewer draws."""
    return [{key: sensor[key] for key in ("name", "kind", "base", "point", "along", "length") if key in sensor}
            for sensor in scene.get("sensor", []) if sensor.get("kind") in ("repose", "slope")]


def as_json(data):
    """JSON that may stand in a script element: nothing in it ends that."""
    return json.dumps(strict(data), ensure_ascii=False, allow_nan=False).replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


def viewer_code():
    """The bundle of the viewer, and its notices of copyright."""
    return ((VIEWER / "bundle" / "viewer.js").read_text(encoding="utf-8"),
            (VIEWER / "bundle" / "viewer.css").read_text(encoding="utf-8"),
            (VIEWER / "bundle" / "LICENSES.txt").read_text(encoding="utf-8"))


def html_page(title, body, data, blobs, mode="report"):
    """A page that needs nothing from outside.

    mode: report; compare, with the data of several runs; watch, which alone may ask the server that it comes from.
    """
    code, style, notices = viewer_code()
    connect = "connect-src 'self'" if mode == "watch" else "connect-src 'none'"
    policy = f"default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; media-src blob:; {connect}"
    packed = "\n".join(f'<script type="text/plain" id="blob-{key}">{base64.b64encode(one).decode()}</script>' for key, one in blobs.items())
    return f"""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="generator" content="Talus">
<title>{text(title)}</title>
<link rel="icon" href="data:,">
<style>
{style}
</style>
</head>
<body data-mode="{mode}">
{body}
<script type="application/json" id="data">{as_json(data)}</script>
{packed}
<!--
{notices}
-->
<script>
{code}
</script>
</body>
</html>
"""


def report_page(page, mode="report"):
    """The page of one run as HTML."""
    data, blobs = page.update()
    picture = page.picture(data)
    return html_page(f"{data['title']} · Talus", report_body(data, picture), data, blobs, mode)


def report_body(data, picture):
    """The words of the page, and the places that the viewer fills."""
    sections = data["sections"]
    image = (f'<img class="still" alt="The grains at {data["frames"]["times"][data["frames"]["best"]]:.4g} s" '
             f'src="data:image/jpeg;base64,{base64.b64encode(picture).decode()}">' if picture else "")

    def part(name, title, extra=""):
        return f'<section class="part" id="part-{name}"{"" if sections[name] else " hidden"}><h2>{title}</h2><div data-section="{name}">{sections[name]}</div>{extra}</section>'

    return f"""<header>
<div class="kind"><span class="mark" aria-hidden="true"></span>Talus <span class="status" data-status="{data['status']}">{text(data['status_word'])}</span></div>
<h1>{text(unbroken(data['title']))}</h1>
<p class="lead" data-section="lead">{sections['lead']}</p>
<div data-section="incidents">{sections['incidents']}</div>
<div data-section="results">{sections['results']}</div>
</header>
<main>
<div class="linked">
<section id="stage" class="stage" aria-label="The run, playing">{image}</section>
<section id="charts" class="charts" aria-label="Charts over time"></section>
</div>
<div class="parts">
{part('modelled', 'What was modelled')}
{part('error', 'How wrong it may be')}
{part('ledger', 'Where the spheres went')}
{part('timing', 'Where the time went')}
<section class="part" id="part-packing" hidden><h2>Packing and forces</h2></section>
{part('repeat', 'To repeat and to cite it')}
</div>
</main>
<footer><p>Made by <code>talus report</code> from {text(data['folder'])}. This file holds all that it shows; nothing is loaded from a network.</p></footer>
"""
