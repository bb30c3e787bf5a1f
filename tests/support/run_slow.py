#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the slow tests one by one, and leaves out what has passed with the same program.

    tests/support/run_slow.py BUILD [WORD…]

Each test case of the programs that ctest labels slow is run by itself, each other entry of that label by ctest. With words
only those with one of them in their name. BUILD/slow/passed.json has what passed, and what it was made of: the program
and the scenes; of entries that are scripts also all files of app, postprocess, scenarios and tests.

Exit codes: 0 all have passed or were skipped, 1 some have failed, 2 the call is wrong.
"""
import argparse
import datetime
import json
import os
import re
import subprocess
import sys
import time
from pathlib import Path
from typing import NamedTuple

from source import digest_of

ROOT = Path(__file__).resolve().parents[2]
SCENES = ("scenarios", "tests/hard/scenes", "tests/validation/scenes", "tests/data")
SCRIPTS = ("app", "postprocess", "scenarios", "tests", "CMakeLists.txt")  # what entries that are scripts are made of


class Test(NamedTuple):
    name: str
    command: list[str]
    environment: dict[str, str]
    folder: str
    made_of: str


def program_files(build):
    """The program, its module, and what scenes and meshes tests read."""
    scenes = [path for folder in SCENES for path in sorted((ROOT / folder).rglob("*"))
              if path.is_file() and path.suffix not in (".md", ".py")]
    return [build / "talus", *sorted((build / "python/talus").glob("_core.*.so")), *scenes]


def git(*arguments):
    return subprocess.run(["git", *arguments, "--", *SCRIPTS], cwd=ROOT, capture_output=True, text=True, check=True).stdout


def slow_tests(build):
    """All, of the programs that are built."""
    listing = subprocess.run(["ctest", "--test-dir", build, "-L", "slow", "--show-only=json-v1"], capture_output=True,
                             text=True, check=True).stdout
    files = program_files(build)
    of_scripts = digest_of(files, git("ls-files", "-s"), git("diff"))
    for entry in json.loads(listing)["tests"]:
        command = entry.get("command")
        properties = {one["name"]: one["value"] for one in entry["properties"]}
        folder = properties["WORKING_DIRECTORY"]
        if not command:
            print(f"{entry['name']} is not built")
        elif command[1:] == ["[slow]"]:
            program = Path(command[0])
            cases = subprocess.run([program, "--list-test-names-only", "[slow]"], capture_output=True, text=True).stdout
            environment = dict(one.split("=", 1) for one in properties.get("ENVIRONMENT", []))
            made_of = digest_of([program, *files])
            for case in filter(None, map(str.strip, cases.splitlines())):
                wanted = re.sub(r"([,\[\\*\"])", r"\\\1", case)
                yield Test(f"{program.name}: {case}", [str(program), wanted], environment, folder, made_of)
        else:
            again = ["ctest", "--test-dir", str(build), "--output-on-failure", "-R", f"^{re.escape(entry['name'])}$"]
            yield Test(entry["name"], again, {}, folder, of_scripts)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path)
    parser.add_argument("words", nargs="*")
    arguments = parser.parse_args()
    store = arguments.build.resolve() / "slow/passed.json"
    store.parent.mkdir(exist_ok=True)
    passed = json.loads(store.read_text()) if store.is_file() else {}
    tests = list(slow_tests(arguments.build.resolve()))
    tests = [test for test in tests if not arguments.words or any(word in test.name for word in arguments.words)]
    failed = []
    for k, test in enumerate(tests, 1):
        where = f"[{k}/{len(tests)}] {test.name}: "
        if passed.get(test.name, {}).get("made_of") == test.made_of:
            print(f"{where}passed on {passed[test.name]['date']}", flush=True)
            continue
        began = time.monotonic()
        done = subprocess.run(test.command, cwd=test.folder, env={**os.environ, **test.environment}, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, errors="replace")
        seconds = time.monotonic() - began
        if done.returncode:
            failed.append(test.name)
            passed.pop(test.name, None)
            print(done.stdout)
        skipped = "***Skipped" in done.stdout or "No tests ran" in done.stdout
        if not done.returncode and not skipped:
            passed[test.name] = {"made_of": test.made_of, "seconds": round(seconds, 1),
                                 "date": datetime.date.today().isoformat()}
        store.write_text(json.dumps(passed, indent=1, ensure_ascii=False) + "\n")
        print(f"{where}{'FAILED' if done.returncode else 'skipped' if skipped else 'passed'}, {seconds:.0f} s", flush=True)
    print(f"{len(failed)} of {len(tests)} slow tests failed" + "".join(f"\n  {name}" for name in failed))
    return int(bool(failed))


if __name__ == "__main__":
    sys.exit(main())
