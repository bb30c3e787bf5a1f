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
import os
import pathlib
import re
import sys

sys.path[:0] = [str(pathlib.Path(__file__).parent), str(pathlib.Path(__file__).parents[1] / "support")]
from hard_cases import case_names, checksum_of, run_case  # noqa: E402  found by the line above
from source import commit  # noqa: E402


def by_number(name):
    return int(re.match(r"\d+", name).group()), name


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

    failed = [[row for row in cases[name] if row[3] == "FAILED"] for name in names]
    print("\n" + markdown([rows for rows in failed if rows]) if any(failed) else "\nall hold")
    if arguments.write:
        table = markdown([cases[name] for name in names])
        write_between_marks(arguments.write, f"All rows are of commit {commit()}, on {os.cpu_count()} processors that other "
                                             f"programs may have used too.\n\n{table}")
    sys.exit(any(row[3] == "FAILED" for rows in cases.values() for row in rows))


if __name__ == "__main__":
    main()
