# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes tests/results/validation.md from what was found in the cases."""
import importlib
import math
import statistics
import textwrap
from pathlib import Path

from cases import CASES

PAGE = Path(__file__).resolve().parents[1] / "results/validation.md"

HEAD = """# Beside theory and experiment

Bulk behaviour that others have measured, computed or derived, and what Talus has for it. `tests/run validation` makes
the runs and writes this page; the docstring of each case, in `tests/validation/cases/`, says more of its law,
parameters and sources, and why its tolerance is what it is. Values are the mean over {seeds} seeds, or as many as are
told, ± its standard error, and are within their tolerance where the mean is; one without an error is of one run. Rows
without a tolerance are for information. Tolerances were written down before the runs, but where the docstring says
other. References "from memory" were not read again: their tolerances are wide for that. Seconds are those of the
processor, of all runs of a case from their first step on; cases may share runs, and two are made at a time.

{verdict} All {runs} runs took {seconds:.0f} seconds.{missing}
"""
VERDICTS = {True: "within", False: "**outside**", None: ""}


def number(value):
    return f"{value:.4g}".replace("-", "−")


def with_error(value, error):
    """The value as far as its error tells, which has two digits."""
    if not error > 0:
        return number(value)
    digits = max(0, 1 - math.floor(math.log10(error)))
    return f"{value:.{digits}f} ± {error:.{digits}f}".replace("-", "−")


def verdict_of(cases):
    rows = [row for case in cases.values() for row in case["rows"] if row["within"] is not None]
    outside = [row for row in rows if not row["within"]]
    if not outside:
        return f"All {len(rows)} quantities are within their tolerance."
    return (f"Of {len(rows)} quantities {len(rows) - len(outside)} are within their tolerance; "
            f"{len(outside)} are **outside**.")


def value_of(row, usual):
    """The mean and its error, with the number of seeds where it is another than usual."""
    count = len(row["values"])
    return with_error(row["mean"], row["standard_error"]) + ("" if count in (1, usual) else f" ({count} seeds)")


def section(name, case, module, seeds):
    title = f"{module.TITLE[0].upper()}{module.TITLE[1:]}"
    lines = [f"## {title}", "", "| quantity | reference (source) | tolerance | Talus | |",
             "| --- | --- | --- | --- | --- |"]
    for row in case["rows"]:
        lines.append(f"| {row['what']} | {row['reference']} | {row['tolerance']} "
                     f"| {value_of(row, seeds)} "
                     f"| {VERDICTS[row['within']]} |")
    lines += ["", f"![{title}](validation/{name}.png)", ""]
    if module.FINDINGS:
        lines += [textwrap.fill(" ".join(module.FINDINGS.split()), 120), ""]
    seconds = case["seconds"].values()
    lines += [f"{len(seconds)} runs, of up to {case['spheres']} spheres: {sum(seconds):.0f} seconds. "
              f"Measured {case['date']} at {case['commit']}.", ""]
    return "\n".join(lines)


def write_page(cases):
    """From rows, seconds of each run and the like of each case by the name of its file, as run.py keeps them."""
    modules = {name: importlib.import_module(f"cases.{name}") for name in CASES}
    seeds = statistics.mode(len(row["values"]) for case in cases.values() for row in case["rows"]
                            if len(row["values"]) > 1)
    missing = [modules[name].TITLE for name in CASES if name not in cases]
    seconds = {run: value for case in cases.values() for run, value in case["seconds"].items()}
    head = HEAD.format(seeds={3: "three"}.get(seeds, seeds), verdict=verdict_of(cases),
                       runs=len(seconds), seconds=sum(seconds.values()),
                       missing=f"\n\nNot yet here: {'; '.join(missing)}." if missing else "")
    sections = (section(name, cases[name], modules[name], seeds) for name in CASES if name in cases)
    PAGE.write_text("\n".join([head, *sections]), encoding="utf-8")
