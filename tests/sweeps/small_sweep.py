# SPDX-License-Identifier: GPL-3.0-or-later
"""A small sweep for tests, and what they do with it: twelve hoppers of sixty beads, some of which must fail."""
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "postprocess"))

SWEEP = """
scene = "hopper"
title = "Sixty beads"
seeds = 3
reports = false

[set]
fill.0.count = 60
fill.0.region.height = 0.05
wall.gate.remove_at = 0.1
time.duration = 0.6
time.frame_interval = 0.2
checkpoint.interval = 0.05
sensor.outlet.from = 0.2
sensor.outlet.to = 0.35

[design]
kind = "list"

[vary]
contact.glass-glass.friction = [0.1, 0.3, -1, 0.5]
world.min = [[-1, -1, -1], [-1, -1, -1], [-1, -1, -1], [-1, -1, -0.1]]
"""  # a friction below 0 is refused; in the smallest world beads escape
DONE, FAILED = 6, 6


def write_sweep(folder, text=SWEEP):
    path = Path(folder) / "beads.toml"
    path.write_text(text, encoding="utf-8")
    return path


def call(*words, code=0, **options):
    """What a command prints. Raises AssertionError where it does not end with that exit code."""
    ended = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False, **options)
    told = ended.stdout + ended.stderr
    assert ended.returncode == code, f"{' '.join(map(str, words))} ended with {ended.returncode}, not {code}: {told}"
    return told


def local_run(talus, folder, text=SWEEP, jobs=2):
    """Runs the sweep in a pool. Returns what results.csv holds."""
    call(talus, "sweep", write_sweep(folder, text), "--out", Path(folder) / "local", "--jobs", jobs, "--quiet")
    return (Path(folder) / "local/results.csv").read_bytes()


def expanded(talus, folder, name, text=SWEEP):
    """The folder of the same sweep, of which nothing was run."""
    path = Path(folder) / name
    call(talus, "sweep", write_sweep(folder, text), "--out", path, "--quiet")
    return path


def gathered(talus, path):
    """What results.csv of a sweep holds now."""
    call(talus, "gather", path)
    return (path / "results.csv").read_bytes()


def processes_of(path):
    """The processes whose command names a folder."""
    found = []
    for entry in Path("/proc").iterdir():
        if entry.name.isdecimal() and int(entry.name) != os.getpid():
            try:
                if str(path).encode() in (entry / "cmdline").read_bytes():
                    found.append(int(entry.name))
            except OSError:
                pass  # it has ended meanwhile
    return found


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(0)
