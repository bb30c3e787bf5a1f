#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Looks at as many random worlds for each property as one likes, as many properties at a time as there are processors.

What was looked at by the same program from the same seed is not looked at again, so that a run can be broken off and
continued, or made longer, at the cost of the worlds that are missing.

    tests/properties/run.py PROGRAM NOTES COUNT [SEED] [--only WORD…]
"""
import argparse
import concurrent.futures
import hashlib
import os
import pathlib
import subprocess
import sys
import time


def names_of(program):
    # Catch2 returns the number of tests as exit code.
    listing = subprocess.run([program, "--list-test-names-only"], capture_output=True, text=True).stdout
    return [line.strip() for line in listing.splitlines() if line.strip()]


def look(program, notes, name, count, seed, checksum):
    environment = dict(os.environ, TALUS_PROPERTIES_COUNT=str(count), TALUS_PROPERTIES_SEED=str(seed),
                       TALUS_PROPERTIES_PROGRESS=str(notes), TALUS_PROPERTIES_PROGRAM=checksum, OMP_NUM_THREADS="1")
    began = time.monotonic()
    with open(notes / f"{name[:40].replace(' ', '_')}.log", "w") as log:
        done = subprocess.run([program, name.replace(",", "\\,").replace("[", "\\[")], env=environment, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        log.write(done.stdout)
    lines = done.stdout.splitlines()
    tally = [k for k, line in enumerate(lines) if " worlds: " in line and not line.startswith(" ")]
    told = lines[tally[0]:tally[0] + 3] if tally else lines[-5:]
    told = told[:1] + [line for line in told[1:] if line.startswith(("  failed:", "  not solved:"))]
    return name, done.returncode, told, time.monotonic() - began


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("notes", type=pathlib.Path)
    parser.add_argument("count", type=int)
    parser.add_argument("seed", type=int, nargs="?", default=1)
    parser.add_argument("--only", nargs="+", default=[])
    options = parser.parse_args()
    options.notes.mkdir(parents=True, exist_ok=True)
    checksum = hashlib.sha256(options.program.read_bytes()).hexdigest()
    names = [name for name in names_of(options.program)
             if not options.only or any(word in name for word in options.only)]
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        runs = [pool.submit(look, options.program, options.notes, name, options.count, options.seed, checksum)
                for name in names]
        for run in concurrent.futures.as_completed(runs):
            name, code, told, seconds = run.result()
            failed += code != 0
            print(f"{'FAILED' if code else 'holds'}: {name} ({seconds:.0f} s)", *("  " + line for line in told), sep="\n",
                  flush=True)
    print(f"Worlds that fail stand in {options.notes}/*.log. One of them again: TALUS_PROPERTIES_COUNT=1 "
          f"TALUS_PROPERTIES_SEED=WORLD {options.program} NAME", flush=True)
    return failed != 0


if __name__ == "__main__":
    sys.exit(main())
