#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that postprocess/viewer/bundle is what its sources build to.

    tests/support/check_viewer_bundle.py

Skipped where there is no npm, or its registry does not answer.
Exit codes: 0 it is or skipped, 1 it is not.
"""
import filecmp
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

VIEWER = Path(__file__).resolve().parents[2] / "postprocess" / "viewer"


def main():
    if not shutil.which("npm"):
        print("skipped: there is no npm")
        return
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "viewer"
        shutil.copytree(VIEWER, copy, ignore=shutil.ignore_patterns("node_modules", "bundle"))
        fetched = subprocess.run(["npm", "ci", "--no-audit", "--no-fund"], cwd=copy, capture_output=True, text=True, check=False)
        if fetched.returncode != 0:
            print(f"skipped: npm cannot fetch what the viewer is built of: {fetched.stderr.strip().splitlines()[-1:]}")
            return
        built = subprocess.run(["node", "build.mjs"], cwd=copy, capture_output=True, text=True, check=False)
        if built.returncode != 0:
            sys.exit(f"check_viewer_bundle.py: the viewer does not build: {built.stderr.strip()}")
        names = sorted(path.name for path in (copy / "bundle").iterdir())
        same, _, _ = filecmp.cmpfiles(copy / "bundle", VIEWER / "bundle", names, shallow=False)
        if sorted(same) != names:
            sys.exit("check_viewer_bundle.py: the bundle is older than its sources: cd postprocess/viewer && npm ci && npm run build")


if __name__ == "__main__":
    main()
