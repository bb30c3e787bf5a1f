# SPDX-License-Identifier: GPL-3.0-or-later
"""What the cases of a sweep found, as tables.

results.csv holds what is the same whenever and wherever the cases are run: settings, results of the sensors with their
spread, the ledger, the error of the run. costs.csv holds what is not: threads and times.
"""
import csv
import io
import json

from run_page.writing import write_whole

RUN_COLUMNS = {  # name of a column: where it is in summary.json
    "simulated_time_s": ("time", "simulated"), "time_step_s": ("time", "step"), "steps": ("time", "steps"),
    "spheres_inserted": ("ledger", "inserted"), "spheres_inside": ("ledger", "inside"), "spheres_left": ("ledger", "left"),
    "spheres_escaped": ("ledger", "escaped"),
    "error_mean_residual": ("error", "residual", "mean"), "error_residual_95": ("error", "residual", "percentile_95"),
    "error_worst_residual": ("error", "residual", "worst"), "error_steps_at_cap": ("error", "residual", "steps_at_cap"),
    "error_mean_overlap_d": ("error", "overlap_d", "mean"), "error_worst_overlap_d": ("error", "overlap_d", "worst"),
    "error_split_steps": ("error", "sub_steps", "steps"), "error_energy_gained_J": ("error", "energy", "gained")}
COST_COLUMNS = {"threads": ("threads",), "wall_s": ("timing", "wall"), "cpu_s": ("timing", "cpu")}


class Case:
    """A case and what became of it."""

    def __init__(self, folder, number, settings):
        self.number, self.settings, self.folder = number, settings, folder.run_of(number)
        self.state, self.reason, self.summary = state_of(self.folder)
        if self.state != "unfinished" and not is_same(self.folder / "case.txt", folder.identity_of(settings)):
            self.state, self.summary = "unfinished", {}
            self.reason = "its folder holds a run with other settings or of other files; --force makes it again"

    def quantities(self):
        """The results of a case that is done, by sensor and name: value, spread, unit."""
        return {(sensor, name): one for sensor, found in self.summary.get("sensors", {}).items() for name, one in found.items()} if self.state == "done" else {}

    def at(self, path):
        value = self.summary
        for key in path:
            value = value.get(key) if isinstance(value, dict) else None
        return value


def is_same(path, text):
    try:
        return path.read_text(encoding="utf-8") == text
    except OSError:
        return False


def state_of(folder):
    """done, failed or unfinished; why it failed; its summary."""
    refused = folder / "refused.txt"
    if refused.is_file():
        return "failed", without_folder(refused.read_text(encoding="utf-8").strip(), folder), {}
    try:
        summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return "unfinished", "", {}
    if summary.get("status") == "done":
        return "done", "", summary
    if summary.get("status") == "failed":
        return "failed", summary["incidents"][0]["sentence"], summary
    return "unfinished", "", {}


def without_folder(sentence, folder):
    """A sentence without the path of the sweep, which is no part of the result."""
    return sentence.replace(f"{folder.parent.parent}/", "")


def read_cases(folder):
    return [Case(folder, number, settings) for number, settings in folder.cases().items()]


def column_name(sensor, name, unit):
    """As metrics.csv has it: outlet_mass_flow_kg_per_s."""
    unit = unit or "1"
    if unit == "1":
        return f"{sensor}_{name}"
    above, _, below = unit.replace(" ", "_").partition("/")
    return f"{sensor}_{name}" + ("" if above == "1" else f"_{above}") + (f"_per_{below}" if below else "")


def quantities_of(cases):
    """All results that any case has: its unit by sensor and name, in the order of the first case that has them."""
    units = {}
    for case in cases:
        for key, one in case.quantities().items():
            units.setdefault(key, one.get("unit") or "1")
    return units


def results_table(cases):
    """Columns by name, each with a value or None for every case."""
    settings = list(cases[0].settings) if cases else []
    table = {"case": [case.number for case in cases], "status": [case.state for case in cases], "reason": [case.reason or None for case in cases]}
    for key in settings:
        table[key] = [setting(case.settings[key]) for case in cases]
    for (sensor, name), unit in quantities_of(cases).items():
        found = [case.quantities().get((sensor, name), {}) for case in cases]
        table[column_name(sensor, name, unit)] = [one.get("value") for one in found]
        table[column_name(sensor, f"{name}_spread", unit)] = [one.get("spread") for one in found]
    for name, path in RUN_COLUMNS.items():
        table[name] = [case.at(path) for case in cases]
    return table


def costs_table(cases):
    return {"case": [case.number for case in cases], **{name: [case.at(path) for case in cases] for name, path in COST_COLUMNS.items()}}


def setting(text):
    """A setting as a number where it is one, else as its text."""
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    return text.strip('"') if text.startswith('"') and '"' not in text[1:-1] else text


def csv_text(table):
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(table)
    writer.writerows(zip(*table.values()))
    return text.getvalue()


def write_tables(folder, cases):
    """Writes results.csv and costs.csv, and results.parquet where pyarrow is there. Returns the names of what it wrote."""
    results = results_table(cases)
    write_whole(folder.path / "results.csv", csv_text(results))
    write_whole(folder.path / "costs.csv", csv_text(costs_table(cases)))
    try:
        import pyarrow
        import pyarrow.parquet
    except ImportError:
        return ["results.csv", "costs.csv"]
    columns = {}
    for name, values in results.items():
        kinds = {type(value) for value in values} - {type(None)}
        columns[name] = values if kinds <= {int} or kinds <= {float, int} or kinds <= {str} else [None if one is None else str(one) for one in values]
    beside = folder.path / "results.parquet.tmp"
    pyarrow.parquet.write_table(pyarrow.table(columns), beside)
    beside.replace(folder.path / "results.parquet")
    return ["results.csv", "costs.csv", "results.parquet"]
