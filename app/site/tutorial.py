#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Does what the tutorial tells, and keeps its pictures for the site.

    app/site/tutorial.py TALUS FOLDER

Runs the blocks of pages/tutorial.md that are marked `sh run`, one after the other, in a folder with the files of
tutorial/; leaves what they draw in FOLDER. Nothing is done where that is newer than the tutorial.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
DRAWN = {"out/0.5/picture.png": "picture.png", "figure.png": "figure.png"}


def main():
    if len(sys.argv) != 3:
        print(__doc__, file=sys.stderr)
        sys.exit(2)
    talus, folder = Path(sys.argv[1]).resolve(), Path(sys.argv[2])
    told = HERE / "pages" / "tutorial.md"
    newest = max(path.stat().st_mtime for path in [told, *(HERE / "tutorial").iterdir()])
    if all((folder / name).exists() and (folder / name).stat().st_mtime > newest for name in DRAWN.values()):
        return
    folder.mkdir(parents=True, exist_ok=True)
    commands = "\n".join(re.findall(r"^```sh run\n(.*?)^```", told.read_text(), flags=re.M | re.S))
    commands = commands.replace("/usr/share/talus", str(ROOT))
    with tempfile.TemporaryDirectory(prefix="talus-tutorial-") as place:
        shutil.copytree(HERE / "tutorial", place, dirs_exist_ok=True)
        (Path(place) / "bin").mkdir()
        (Path(place) / "bin" / "talus").symlink_to(talus)
        path = f"{place}/bin:{os.environ['PATH']}"
        subprocess.run(["bash", "-euo", "pipefail", "-c", commands], cwd=place, check=True, stdout=subprocess.DEVNULL,
                       env={**os.environ, "PATH": path})
        for drawn, name in DRAWN.items():
            shutil.copy(Path(place) / drawn, folder / name)
    print("tutorial: done")


if __name__ == "__main__":
    main()
