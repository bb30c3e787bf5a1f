# SPDX-License-Identifier: GPL-3.0-or-later
"""The charts of a run over time, from its metrics.csv, and those of its profiles."""
import csv

import numpy

from metric_panels import RUN_PANELS, Panel, sensor_panels, split_unit
from run_page.packing import blob, pack_floats
from run_page.sections import with_spread

MOST_ROWS = 1500  # of metrics.csv; of more, the least and the greatest of some in a row are kept
WINDOWS = 50  # a flow is the growth of the passed mass over so small a share of the run


def flows(columns, time):
    """Of each passed mass or count its growth by time, as a column of its own."""
    window = max((time[-1] - time[0]) / WINDOWS, 4 * float(numpy.median(numpy.diff(time)))) if len(time) > 8 else 0.0
    found = {}
    for name, passed in columns.items():
        for ending, flow in (("_passed_mass_kg", "_mass_flow_kg_per_s"), ("_passed_count", "_sphere_flow_per_s")):
            if name.endswith(ending) and window > 0:
                before, after = (numpy.clip(time + shift, time[0], time[-1]) for shift in (-window / 2, window / 2))
                grown = numpy.interp(after, time, passed) - numpy.interp(before, time, passed)
                found[name.removesuffix(ending) + flow] = grown / (after - before)
    return found, window


def thinned(time, columns):
    """At most MOST_ROWS rows; of those that follow each other the least and the greatest of each column stay."""
    if len(time) <= MOST_ROWS:
        return time, columns
    each = -(-2 * len(time) // MOST_ROWS)
    whole = len(time) // each * each
    ends = lambda values: numpy.stack([values.min(axis=1), values.max(axis=1)], axis=1).ravel()  # noqa: E731
    return ends(time[:whole].reshape(-1, each)), {name: ends(values[:whole].reshape(-1, each)) for name, values in columns.items()}


def result_of(run, column):
    """What the summary says of the quantity in a column, and over which times; nothing if it does not."""
    for sensor in run.scene().get("sensor", []):
        name = sensor["name"]
        if column.startswith(f"{name}_"):
            quantity = split_unit(column)[0].removeprefix(f"{name}_")
            result = run.summary().get("sensors", {}).get(name, {}).get(quantity)
            if result and result.get("value") is not None and "from" in sensor:
                end = run.summary()["time"]["simulated"]
                to = sensor.get("to", end)
                return {"from": sensor["from"], "to": min(to, end), "value": result["value"],
                        "told": with_spread(result["value"], result.get("spread"))}
    return None


def result_in(run, panel):
    """Of all curves of a chart together, each by its name where there are several."""
    found = [(label, result) for name, label in panel.columns.items() if (result := result_of(run, name))]
    if not found:
        return None
    told = ", ".join(f"{label} {one['told']}" if len(panel.columns) > 1 else one["told"] for label, one in found)
    first = found[0][1]
    return {"from": first["from"], "to": first["to"], "values": [one["value"] for _, one in found], "told": told}


def pack_charts(run):
    """The charts that the viewer draws over time, and the blob of their numbers."""
    try:
        metrics = run.metrics()
    except Exception:  # a run that has written no row yet has no charts yet
        return {"columns": [], "rows": 0, "panels": []}, {}
    time = metrics["time_s"]
    flow, window = flows(metrics, time)
    columns = {**metrics, **flow}
    panels = [Panel(f"{split_unit(name)[0].replace('_', ' ')}", unit_of(name), "linear", {name: f"over {window:.2g} s"})
              for name in flow if name.endswith("_kg_per_s")]
    panels += [panel for panel in sensor_panels(run, metrics) if not panel.title.endswith((" passed mass", " passed count"))]
    panels += [panel for panel in RUN_PANELS if panel.columns.keys() & columns.keys()]
    used = [name for panel in panels for name in panel.columns if name in columns]
    used = list(dict.fromkeys(used + [f"{one['name']}_{end}" for one in run.scene().get("sensor", [])
                                      for end in ("angle_deg", "apex_m", "foot_m") if f"{one['name']}_{end}" in columns]))
    time, kept = thinned(time, {name: columns[name] for name in used})
    packed = blob(pack_floats(numpy.array([time, *(kept[name] for name in used)])))
    listed = [{"title": panel.title, "unit": "" if panel.label == "number" else panel.label, "log": panel.scale == "log",
               "curves": [{"column": name, "label": label} for name, label in panel.columns.items() if name in columns],
               "result": result_in(run, panel)}
              for panel in panels]
    return {"blob": packed.key, "columns": ["time_s", *used], "rows": len(time), "panels": listed}, {packed.key: packed.data}


def unit_of(column):
    return split_unit(column)[1]


def pack_profiles(run):
    """The tables profile_NAME.csv that sensors left: of each the places and its quantities with their errors."""
    profiles = []
    for sensor in run.scene().get("sensor", []):
        path = run.folder / f"profile_{sensor['name']}.csv"
        if sensor.get("kind") != "profile" or not path.is_file():
            continue
        with path.open(newline="", encoding="utf-8") as file:
            header, *rows = list(csv.reader(file)) or [[]]
        table = dict(zip(header, numpy.array([row for row in rows if len(row) == len(header)], dtype=float).reshape(-1, len(header)).T))
        curves = []
        for name in header[1:]:
            base, unit = split_unit(name)
            if not name.endswith("_error") and "_error_" not in name and name != "samples":
                error = table.get(f"{name}_error", table.get(f"{base}_error" + name.removeprefix(base)))
                curves.append({"title": base.replace("_", " "), "unit": "" if unit == "number" else unit, "values": plain(table[name]),
                               "errors": plain(error) if error is not None else None})
        profiles.append({"sensor": sensor["name"], "place": plain(table.get("position_m", numpy.empty(0))), "curves": curves})
    return profiles


def plain(values):
    return [float(f"{value:.6g}") if numpy.isfinite(value) else None for value in values]
