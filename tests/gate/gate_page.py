# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes tests/results/gate.md from what the gate found and what it found before."""
import math
import textwrap

from verdicts import Row, verdict

HEAD = """# The gate

What is run before a change of the program's results lands: hard cases, short versions of the validation cases, flows
and beds at rest. `tests/run gate` runs it and writes this page; [tests/README.md](../README.md#the-gate) says how
verdicts are made. Wall time is longer where other programs ran beside it.

| | commit | processor | wall | CPU |
| --- | --- | --- | --- | --- |
{measurements}

{summary}
"""


def number(value):
    return f"{value:.3g}".replace("-", "−")


def shown(row):
    """The value as far as its error tells."""
    if row is None:
        return "–"
    if row.text:
        return row.text
    if row.of_median or not row.error > 0:
        return number(row.value)
    digits = 1 - math.floor(math.log10(row.error))
    if abs(row.value) < 1e-3:
        return f"{number(row.value)} ± {row.error:.1g}".replace("-", "−")
    return f"{row.value:.{max(0, digits)}f} ± {row.error:.{max(0, digits)}f}".replace("-", "−")


def table(rows):
    """Of triples of row, row before, verdict."""
    lines = ["| quantity | criterion | before | now | verdict |", "| --- | --- | --- | --- | --- |"]
    scene = None
    for row, before, said in rows:
        if row.scene != scene:
            lines.append(f"| **{row.scene}** | | | | |")
            scene = row.scene
        said = f"**{said}**" if said.startswith("fails") else said
        lines.append(f"| {row.what} | {row.criterion} | {shown(before)} | {shown(row)} | {said} |".replace("|  |", "| |"))
    return "\n".join(lines)


def judged(now, before):
    """Triples of all rows of now, by what the store has of both."""
    earlier = {row.key: row for row in rows_of(before)}
    return [(row, earlier.get(row.key), verdict(row, earlier.get(row.key))) for row in rows_of(now)]


def rows_of(kept):
    return [Row(**{**row, "values": tuple(row["values"])}) for row in kept.get("rows", [])]


def summary(rows, missing):
    counts = {}
    for _, _, said in rows:
        counts[said] = counts.get(said, 0) + 1
    words = f"Of {len(rows)} rows: " + ", ".join(f"{count} {said}" for said, count in sorted(counts.items())) + "."
    if missing:
        words += " Not there, since runs are missing or have failed: " + "; ".join(missing) + "."
    return textwrap.fill(words, 120)


def page(store):
    rows = judged(store["now"], store.get("before", {}))
    measurements = "\n".join(
        f"| {name} | {kept['commit']} | {kept['processor']} | {kept['minutes']:.0f} min | {kept['seconds'] / 60:.0f} min |"
        for name, kept in store.items())
    head = HEAD.format(measurements=measurements, summary=summary(rows, store["now"]["missing"]))
    return head + "\n" + table(rows) + "\n"
