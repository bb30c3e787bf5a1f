#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the studies that accuracy chooses from, one after the other, into build/studies.

    tests/studies/run.py [--write] [WORD…]

With words only those with one of them in their name; a word that names a study of questions/ runs that. What is there
from the same program is not run again, and a study that was broken off goes on where it was. --write puts the tables
into tests/studies/results, with the commit that they are of in results/measured.json, and writes what was found for
each accuracy from them.

Exit codes: 0 done, 1 a study failed, or an accuracy does not keep what it promises, 2 the call is wrong, 130 broken off.
"""
import argparse
import datetime
import json
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "tests/support"))
from source import commit, digest_of, processor  # noqa: E402  found by the line above

FOLDER, RESULTS = ROOT / "build/studies", HERE / "results"


def studies(words):
    """Paths of what to run; questions only where a word names them."""
    usual, questions = sorted(HERE.glob("*.toml")), sorted(HERE.glob("questions/*.toml"))
    if not words:
        return usual
    return [path for path in (*usual, *questions) if any(word in str(path.relative_to(HERE)) for word in words)]


def scene_of(path):
    """The scene, which the command in a study's first line names."""
    return shlex.split(path.read_text().splitlines()[0].removeprefix("#"))[2]


def program_checksum(build):
    return digest_of([build / "talus", *sorted((build / "python/talus").glob("_core.*.so"))])


def run(path, made_of):
    """Whether a study is there, or has been made, from the same program. What is of another one is replaced."""
    folder = FOLDER / path.stem
    begun, done = folder.with_suffix(".begun"), folder.with_suffix(".done")
    if done.is_file() and done.read_text() == made_of:
        print(f"{path.stem} is there", flush=True)
        return True
    anew = not (begun.is_file() and begun.read_text() == made_of)
    begun.write_text(made_of)
    if anew and folder.is_dir():
        shutil.rmtree(folder)
    command = [ROOT / "build/talus", "study", scene_of(path), "--settings", path, "-o", folder]
    if subprocess.run(command, cwd=ROOT).returncode:
        return False
    done.write_text(made_of)
    return True


def keep(paths):
    """Puts tables beside those of other studies, and tells of what commit they are. 0 where accuracies keep to what they
    promise."""
    for path in paths:
        results = path.parent / "results"
        shutil.copy(FOLDER / path.stem / "study.csv", results / f"{path.stem}.csv")
        store = results / "measured.json"
        measured = json.loads(store.read_text()) if store.is_file() else {}
        measured[path.stem] = {"commit": commit(), "processor": processor(), "date": datetime.date.today().isoformat()}
        store.write_text(json.dumps(measured, indent=1) + "\n")
    return subprocess.run(["/usr/bin/python3", HERE / "accuracy.py"]).returncode


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("words", nargs="*")
    parser.add_argument("--write", action="store_true", help="put the tables into tests/studies/results")
    arguments = parser.parse_args()
    chosen = studies(arguments.words)
    if not chosen:
        parser.error(f"no study has {' or '.join(arguments.words)} in its name")
    FOLDER.mkdir(parents=True, exist_ok=True)
    made_of = program_checksum(ROOT / "build")
    failed = [path.stem for path in chosen if not run(path, made_of + digest_of([path]))]
    if failed:
        print(f"failed or broken off: {', '.join(failed)}", file=sys.stderr)
        return 1
    if arguments.write:
        return keep(chosen)
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(130)
