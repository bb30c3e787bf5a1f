#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes scenarios/accuracy/settings.toml, which accuracy chooses from, from what the studies found.

    tests/studies/accuracy.py

For each setting that is offered: its worst error over the studies of results/, rounded up to a hundredth of a per cent,
and the geometric mean of its cost by that of the usual setting with matched. Which errors count stands in README.md.
"""
import csv
import math
from pathlib import Path

HERE = Path(__file__).resolve().parent
TARGET = HERE.parents[1] / "scenarios" / "accuracy" / "settings.toml"

# As the studies call them: with each stabilisation from the cheapest to the dearest, each more accurate than the one before.
OFFERED = ("matched, step=x4", "matched, step=x2", "matched, tolerance=draft", "matched, min_sweeps=4", "matched, min_sweeps=10",
           "projected, step=x4", "projected, step=x2", "projected", "projected, step=x0.5")
TOLERANCES = {"draft": 5e-2, "standard": 1e-2, "fine": 1e-3}


def read_table(path):
    with path.open(newline="", encoding="utf-8") as file:
        return {row["setting"]: row for row in csv.DictReader(file)}


def row_of(table, setting):
    """Where a setting came to the same run as another, that other's row."""
    row = table[setting]
    same = "the same run as "
    return row_of(table, row["status"].removeprefix(same)) if row["status"].startswith(same) else row


def number(row, column):
    return float(row.get(column) or math.nan)


def errors_in(study, row):
    """The errors that accuracy is about, by name; of a flow or an angle what stands out from chance (95 %)."""
    names = ["velocity_error", "overlap_95"] + (["creep"] if study.startswith("column") or study == "imported_pile" else [])
    errors = {name: number(row, name) for name in names}
    for sensor in ("outlet_mass_flow", "heap_angle"):
        errors[sensor] = number(row, sensor) - 1.96 * number(row, f"{sensor}_spread")
    return {name: error for name, error in errors.items() if math.isfinite(error)}


def measured(setting, studies):
    """The worst error of a setting, which that is, and what it costs."""
    worst, costs = (0.0, ""), []
    for study, table in studies.items():
        row = row_of(table, setting)
        if row["status"] != "done":
            raise SystemExit(f"accuracy.py: '{setting}' did not come to its end in {study}: {row['status']}")
        costs.append(math.log(number(row, "cpu_s_per_s") / number(row_of(table, "matched"), "cpu_s_per_s")))
        worst = max(worst, *((error, f"{name} of {study}") for name, error in errors_in(study, row).items()))
    return *worst, math.exp(sum(costs) / len(costs))


def table_of(setting, studies):
    """A setting and what was measured, as a table of TOML."""
    stabilisation, *changes = setting.split(", ")
    keys = dict(change.split("=") for change in changes)
    error, worst, cost = measured(setting, studies)
    lines = {"stabilisation": f'"{stabilisation}"', "step_factor": float(keys.get("step", "x1")[1:]), "min_sweeps": int(keys.get("min_sweeps", 0)),
             "tolerance": TOLERANCES[keys.get("tolerance", "standard")], "error": math.ceil(1e4 * error) / 1e4, "worst": f'"{worst}"', "cost": f"{cost:.3g}"}
    return "\n[[setting]]\n" + "".join(f"{key} = {value}\n" for key, value in lines.items())


def main():
    studies = {path.stem: read_table(path) for path in sorted((HERE / "results").glob("*.csv"))}
    head = "# What accuracy chooses from, written by tests/studies/accuracy.py from the results of the studies there.\n"
    TARGET.parent.mkdir(exist_ok=True)
    TARGET.write_text(head + "".join(table_of(setting, studies) for setting in OFFERED), encoding="utf-8")


if __name__ == "__main__":
    main()
