#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts bugs into a copy of Talus, one at a time, and says which test sees each.

    tests/mutants/run.py [WORD…]        with words only the mutants whose name has one of them

The copy lies in build/mutants and is built like the default tests; a mutant takes some minutes. mutants.toml lists the
bugs: a file, a text that stands there once, and what is put in its place.

Exit codes: 0 every mutant was seen, 1 one was not, 2 one cannot be put in.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
COPY = ROOT / "build" / "mutants"
TESTS = ["core", "physics", "scenarios", "io", "app", "validation"]


def prepare():
    """Brings the copy up to date; files that are the same stay untouched, and are not built again."""
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard"], cwd=ROOT, check=True,
                            capture_output=True, text=True).stdout.split("\n")
    for name in filter(None, listed):
        source, copy = ROOT / name, COPY / name
        if source.is_file() and not (copy.is_file() and copy.read_bytes() == source.read_bytes()):
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source, copy)
    subprocess.run(["cmake", "-S", COPY, "-B", COPY / "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release"], check=True,
                   stdout=subprocess.DEVNULL)


def build():
    """Whether it can be built."""
    targets = [f"test_{name}" for name in TESTS]
    return subprocess.run(["ninja", "-C", COPY / "build", *targets], stdout=subprocess.DEVNULL).returncode == 0


def killer():
    """The first test that fails, or nothing."""
    for name in TESTS:
        program = COPY / "build" / f"test_{name}"
        output = subprocess.run([program, "~[slow]", "--abort"], capture_output=True, text=True)
        if output.returncode != 0:
            title = re.search(r"-{79}\n(.+?)\n-{79}", output.stdout, re.DOTALL)
            return f"{name}: {' '.join(title[1].split()) if title else 'it crashed'}"
    return None


def main():
    mutants = tomllib.loads((pathlib.Path(__file__).parent / "mutants.toml").read_text())["mutant"]
    words = sys.argv[1:]
    survivors = 0
    prepare()
    for mutant in mutants:
        if words and not any(word in mutant["name"] for word in words):
            continue
        path = COPY / mutant["file"]
        text = path.read_text()
        if text.count(mutant["old"]) != 1:
            sys.exit(f"run.py: {mutant['name']}: its text stands {text.count(mutant['old'])} times in {mutant['file']}")
        path.write_text(text.replace(mutant["old"], mutant["new"]))
        seen = killer() if build() else "the compiler"
        path.write_text(text)
        survivors += seen is None
        print(f"{mutant['name']}: {seen or 'SURVIVES'}", flush=True)
    sys.exit(1 if survivors else 0)


if __name__ == "__main__":
    main()
