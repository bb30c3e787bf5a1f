#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints what each test of the last `tests/run` took, the longest first, as a table.

Exit codes: 0 done; 1 there is no log of a run, or a test in it has no time.
"""
import re
import sys
from pathlib import Path

LOG = Path(__file__).resolve().parents[2] / "build/Testing/Temporary/LastTest.log"
SHORTER = 1.0  # s, of which one row is made for all


def main():
    if not LOG.exists():
        sys.exit(f"{LOG} is not there: 'tests/run' makes it")
    text = LOG.read_text(errors="replace")
    times = [(float(seconds), name) for name, seconds in re.findall(
        r"^\d+/\d+ Test: (.+)$(?:\n(?!\d+/\d+ Test: ).*)*?^Test time = +([\d.]+) sec$", text, re.MULTILINE)]
    if not times or len(times) != len(re.findall(r"^\d+/\d+ Test: ", text, re.MULTILINE)):
        sys.exit(f"{LOG} does not have the time of each test")
    long = sorted((one for one in times if one[0] >= SHORTER), reverse=True)
    short = [seconds for seconds, _ in times if seconds < SHORTER]
    print("| test | s |\n| --- | ---: |")
    for seconds, name in long:
        print(f"| `{name}` | {seconds:.0f} |")
    print(f"| {len(short)} others | {sum(short):.1f} |\n| all, one after the other | {sum(t for t, _ in times):.0f} |")


if __name__ == "__main__":
    main()
