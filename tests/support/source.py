# SPDX-License-Identifier: GPL-3.0-or-later
"""What figures are tied to: the commit that last changed the program, the files that they are made of, the machine."""
import hashlib
import os
import re
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = ("core", "scenarios", "io", "app", ":!*.md")  # what is compiled; other folders do not change a figure


def git(root, *arguments):
    return subprocess.run(["git", *arguments, "--", *PROGRAM], cwd=root, capture_output=True, text=True).stdout.strip()


def commit(root=ROOT):
    """Of the last change to the program, with a + where it has been changed since."""
    return git(root, "log", "-1", "--format=%h") + ("+" if git(root, "status", "--porcelain") else "")


def source_of(build):
    """The folder that a build folder was made from."""
    found = re.search(r"^CMAKE_HOME_DIRECTORY:INTERNAL=(.*)$", (Path(build) / "CMakeCache.txt").read_text(), re.MULTILINE)
    return Path(found[1])


def digest_of(paths, *texts):
    """Of files, and of texts."""
    digest = hashlib.sha256("\n".join(texts).encode())
    for path in paths:
        digest.update(path.read_bytes())
    return digest.hexdigest()


def processor():
    """Its name, and how many this process may use."""
    names = re.findall(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text())
    return f"{len(os.sched_getaffinity(0))} × {names[0] if names else 'an unknown processor'}"
