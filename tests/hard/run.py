#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the hard cases, as many at a time as there are processors, and prints their table.

A case whose result is there from the same program is not run again, so that a run can be broken off and continued, and
a case added, at the cost of the cases that are missing.

    tests/hard/run.py PROGRAM RESULTS [--write PAGE] [WORD…]

With words only the cases whose name has one of them. --write puts the table between the marks of that file.
"""
import argparse
import concurrent.futures
import hashlib
import os
import pathlib
import re
import subprocess
import sys


def case_names(program):
    # Catch2 returns the number of tests as exit code.
    listing = subprocess.run([program, "--list-test-names-only"], capture_output=True, text=True).stdout
    return [line.strip() for line in listing.splitlines() if line.strip()]


def checksum_of(program):
    """Of the program, of the one that some cases run, and of all scenes and meshes that cases read."""
    root = pathlib.Path(__file__).resolve().parents[2]
    folders = [root / "scenarios", root / "tests/hard/scenes", root / "tests/validation/scenes"]
    scenes = [path for folder in folders for path in sorted(folder.iterdir()) if path.suffix in {".toml", ".stl", ".vtu"}]
    digest = hashlib.sha256()
    for path in [program, program.resolve().parent / "talus", *scenes]:
        digest.update(path.read_bytes())
    return digest.hexdigest()


def by_number(name):
    return int(re.match(r"\d+", name).group()), name


def run_case(program, results, name, checksum):
    """The rows of one case, and whether it was run now."""
    table, mark = results / f"{name}.tsv", results / f"{name}.program"
    if table.exists() and mark.exists() and mark.read_text() == checksum:
        return rows_of(table), False
    table.unlink(missing_ok=True)
    # Idle threads must not spin: the case that runs 16 would keep the processors from all others.
    environment = dict(os.environ, TALUS_HARD_RESULTS=str(results), OMP_NUM_THREADS="1", GOMP_SPINCOUNT="2000")
    with open(results / f"{name}.log", "w") as log:
        done = subprocess.run([program, name.replace(",", "\\,").replace("[", "\\[")], env=environment, stdout=log,
                              stderr=subprocess.STDOUT)
    rows = rows_of(table) if table.exists() else []
    if not rows:
        rows.append([name, "has results", f"exit code {done.returncode}", "FAILED", "0"])
    if done.returncode and all(row[3] != "FAILED" for row in rows):
        rows.append([name, "comes to its end", f"exit code {done.returncode}", "FAILED", "0"])
    else:
        mark.write_text(checksum)
    return rows, True


def rows_of(table):
    return [line.split("\t") for line in table.read_text().splitlines()]


def markdown(cases):
    lines = ["| case | criterion | measured | | CPU s |", "| --- | --- | --- | --- | --- |"]
    for rows in cases:
        for k, (name, criterion, measured, verdict, seconds) in enumerate(rows):
            shown = "" if verdict == "told" else verdict
            lines.append(f"| {name if k == 0 else ''} | {criterion} | {measured} | {shown} | {seconds if k == 0 else ''} |"
                         .replace("|  |", "| |").replace("|  |", "| |"))
    return "\n".join(lines)


def write_between_marks(path, table):
    text = path.read_text()
    begin, end = "<!-- hard cases begin -->\n", "<!-- hard cases end -->"
    head, rest = text.split(begin)
    path.write_text(head + begin + table + "\n" + rest[rest.index(end):])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("results", type=pathlib.Path)
    parser.add_argument("words", nargs="*")
    parser.add_argument("--write", type=pathlib.Path, metavar="PAGE")
    arguments = parser.parse_args()

    results = arguments.results.resolve()
    results.mkdir(parents=True, exist_ok=True)
    program = str(arguments.program.resolve())
    checksum = checksum_of(arguments.program)
    names = sorted(case_names(program), key=by_number)
    if arguments.words:
        names = [name for name in names if any(word in name for word in arguments.words)]

    cases = {}
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        pending = {pool.submit(run_case, program, results, name, checksum): name for name in names}
        for future in concurrent.futures.as_completed(pending):
            rows, ran = future.result()
            name = pending[future]
            cases[name] = rows
            failed = [row for row in rows if row[3] == "FAILED"]
            verdict = "FAILED: " + "; ".join(f"{row[1]}: {row[2]}" for row in failed) if failed else "ok"
            print(f"[{len(cases)}/{len(names)}] {name}: {verdict}{'' if ran else ' (from before)'}", flush=True)

    table = markdown([cases[name] for name in names])
    print("\n" + table)
    if arguments.write:
        commit = subprocess.run(["git", "log", "-1", "--format=%h"], cwd=pathlib.Path(__file__).parent, capture_output=True,
                                text=True).stdout.strip()
        write_between_marks(arguments.write, f"All rows are of commit {commit}, on {os.cpu_count()} processors that other "
                                             f"programs may have used too.\n\n{table}")
    sys.exit(any(row[3] == "FAILED" for rows in cases.values() for row in rows))


if __name__ == "__main__":
    main()
