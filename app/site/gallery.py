#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the scenes of gallery.toml and makes their pictures, for the site.

    app/site/gallery.py TALUS FOLDER [SCENE…]

Each scene leaves FOLDER/NAME.png, FOLDER/NAME.json (its command, commit and figures) and FOLDER/NAME.html, the report
that plays the run. A scene that has them already is left alone unless its file or its
entry in gallery.toml has changed; delete FOLDER to make all anew, with another Talus for instance. Runs go on one
thread, so that the seconds that are reported are those of one.
"""
import json
import os
import shlex
import shutil
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent


def commit():
    """The commit of the source tree, with a plus where files differ from it; empty outside a repository."""
    if not shutil.which("git"):
        return ""
    told = subprocess.run(["git", "-C", ROOT, "describe", "--always", "--dirty=+", "--exclude=*"], capture_output=True,
                          text=True)
    return told.stdout.strip()


def arguments_of(entry):
    changes = [word for change in entry.get("set", []) for word in ("--set", change)]
    return ["run", entry["scene"], "--until", str(entry["until"]), *changes, "--threads", "1"]


def is_made(entry, folder, inputs):
    told = folder / f"{entry['scene']}.json"
    if not all((folder / f"{entry['scene']}.{ending}").exists() for ending in ("json", "png", "html")):
        return False
    known = json.loads(told.read_text())
    return known["entry"] == entry and all(path.stat().st_mtime < told.stat().st_mtime for path in inputs)


def make(talus, entry, folder):
    name = entry["scene"]
    with tempfile.TemporaryDirectory(prefix="talus-gallery-") as place:
        out = Path(place) / name
        command = arguments_of(entry)
        subprocess.run([talus, *command, "--quiet", "-o", out], check=True)
        subprocess.run([ROOT / "postprocess" / "render.py", out, "--view", entry.get("view", "front"),
                        "--size", "800x800", "--output", folder / f"{name}.png"], check=True, stdout=subprocess.DEVNULL)
        # from there, so that the page names the run without the way to it
        subprocess.run([talus, "report", name, "--output", folder / f"{name}.html", "--force"], cwd=place, check=True,
                       stdout=subprocess.DEVNULL)
        summary = json.loads((out / "summary.json").read_text())
    told = {"entry": entry, "command": shlex.join(["talus", *command]), "commit": commit(), "summary": summary}
    (folder / f"{name}.json").write_text(json.dumps(told, indent=1))
    print(f"{name}: {summary['timing']['cpu']:.0f} CPU seconds", flush=True)


def main():
    if len(sys.argv) < 3:
        print(__doc__, file=sys.stderr)
        sys.exit(2)
    talus, folder, wanted = os.path.abspath(sys.argv[1]), Path(sys.argv[2]).resolve(), sys.argv[3:]
    folder.mkdir(parents=True, exist_ok=True)
    for entry in tomllib.loads((HERE / "gallery.toml").read_text())["run"]:
        if wanted and entry["scene"] not in wanted:
            continue
        if not is_made(entry, folder, [ROOT / "scenarios" / f"{entry['scene']}.toml"]):
            make(talus, entry, folder)


if __name__ == "__main__":
    main()
