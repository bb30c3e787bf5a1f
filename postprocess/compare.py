#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares runs on one page: what their sensors found in one table and one figure each, and two runs playing beside each
other with one camera and one clock.

    postprocess/compare.py out/smooth out/rough           into compare.html

Exit codes: 0 done, 2 wrong arguments or something missing, 4 a file of a run is damaged, or the page cannot be
written.
"""
import argparse
import sys
from pathlib import Path

try:
    import numpy  # noqa: F401  whether it is there
    import vtkmodules.vtkIOXML  # noqa: F401
except ImportError as error:
    print(f"compare.py: {error}: apt install python3-vtk9 python3-numpy, and use /usr/bin/python3.", file=sys.stderr)
    sys.exit(2)

from read_run import Run, RunError
from run_page.page import RunPage, html_page
from run_page.sections import STATUS, number, percent, seconds, text, with_spread
from run_page.writing import refuse_foreign, write_whole

MOST_RUNS = 8


def parse_arguments():
    parser = argparse.ArgumentParser(prog="compare.py", description="Compares runs on one page.")
    parser.add_argument("runs", nargs="+", metavar="OUT", help="the folders of two to eight runs")
    parser.add_argument("--output", type=Path, default=Path("compare.html"), metavar="HTML", help="where to write the page (compare.html)")
    parser.add_argument("--force", action="store_true", help="replace a file that is no page of Talus")
    arguments = parser.parse_args()
    if not 2 <= len(arguments.runs) <= MOST_RUNS:
        parser.error(f"give two to {MOST_RUNS} runs, not {len(arguments.runs)}")
    return arguments


def labels_of(runs):
    """A short name for each: the folder's, with as many of those above as tell them apart."""
    parts = [run.folder.resolve().parts for run in runs]
    for count in range(1, max(len(one) for one in parts) + 1):
        labels = ["/".join(one[-count:]) for one in parts]
        if len(set(labels)) == len(labels):
            return labels
    return [f"{label} ({n + 1})" for n, label in enumerate(labels)]  # the same folder twice


def panels_of(runs):
    """The charts, one for each column that any of the runs draws."""
    panels = {}
    for run in runs:
        for panel in run["charts"]["panels"]:
            for curve in panel["curves"]:
                several = len(panel["curves"]) > 1 and curve["label"] != panel["title"]
                title = f"{panel['title']}, {curve['label']}" if several else panel["title"]
                panels.setdefault(curve["column"], {"column": curve["column"], "title": title, "unit": panel["unit"], "log": panel["log"]})
    return list(panels.values())


def results_table(runs, labels):
    """A row for each result of a sensor and a column for each run; then what the runs cost and how wrong they may be."""
    summaries = [run.summary() for run in runs]
    rows = {}
    for summary in summaries:
        for sensor, quantities in summary.get("sensors", {}).items():
            for name, one in quantities.items():
                unit = f" [{one['unit']}]" if one.get("unit") not in (None, "1") else ""
                rows.setdefault((sensor, name), f"{sensor} · {name.replace('_', ' ')}{unit}")

    def result(summary, sensor, name):
        one = summary.get("sensors", {}).get(sensor, {}).get(name, {})
        return with_spread(one.get("value"), one.get("spread"))

    def cells(first, value):
        return "<tr><th scope='row'>" + text(first) + "</th>" + "".join(f"<td>{text(value(one) if one else '–')}</td>" for one in summaries) + "</tr>"

    body = [cells(title, lambda summary, key=key: result(summary, *key)) for key, title in rows.items()]
    body += [cells("Spheres inserted", lambda one: number(one["ledger"]["inserted"])),
             cells("Left through an outlet", lambda one: number(one["ledger"]["left"])),
             cells("Simulated", lambda one: seconds(one["time"]["simulated"])),
             cells("Step", lambda one: f"{number(one['time']['step'], 3)} s"),
             cells("Mean residual", lambda one: number(one["error"]["residual"]["mean"], 2)),
             cells("Worst overlap", lambda one: f"{percent(one['error']['overlap_d']['worst'])} d"),
             cells("Processor time", lambda one: seconds(one["timing"]["cpu"])),
             cells("Version", lambda one: one["version"])]
    head = "".join(f"<th scope='col'>{text(label)}</th>" for label in labels)
    return f"<div class='scroll'><table><thead><tr><th></th>{head}</tr></thead><tbody>{''.join(body)}</tbody></table></div>"


def differences(runs, labels):
    """What the scenes of the runs do not have in common, key by key."""
    flat = [dict(leaves(run.scene())) for run in runs]
    keys = sorted({key for one in flat for key in one if any(other.get(key) != one[key] for other in flat)})
    if not keys:
        return "<p>The scenes are the same, key by key.</p>"
    head = "".join(f"<th scope='col'>{text(label)}</th>" for label in labels)
    rows = "".join(f"<tr><th scope='row'><code>{text(key)}</code></th>" + "".join(f"<td>{text(one.get(key, '–'))}</td>" for one in flat) + "</tr>"
                   for key in keys[:60])
    more = f"<p class='soft'>and {len(keys) - 60} more keys</p>" if len(keys) > 60 else ""
    return f"<div class='scroll'><table><thead><tr><th></th>{head}</tr></thead><tbody>{rows}</tbody></table></div>{more}"


def leaves(value, key=""):
    """The keys of a scene down to plain values; tables of a list go by their names."""
    if isinstance(value, dict):
        for name, one in value.items():
            yield from leaves(one, f"{key}.{name}" if key else name)
    elif isinstance(value, list) and value and isinstance(value[0], dict):
        for n, one in enumerate(value):
            yield from leaves(one, f"{key}.{one.get('name', n)}")
    else:
        yield key, str(value)


def page_of(runs):
    labels = labels_of(runs)
    entries, blobs = [], {}
    for run, label in zip(runs, labels):
        data, packed = RunPage(run).update()
        del data["sections"]
        entries.append({**data, "label": label})
        blobs.update(packed)
    statuses = ", ".join(f"{label}: {STATUS[entry['status']]}" for label, entry in zip(labels, entries) if entry["status"] != "done")
    body = f"""<header>
<div class="kind"><span class="mark" aria-hidden="true"></span>Talus</div>
<h1>{text(' and '.join(labels) if len(labels) == 2 else f'{len(labels)} runs')}</h1>
<p class="lead">{text(' · '.join(dict.fromkeys(entry['title'] for entry in entries)))}{text(f' · {statuses}') if statuses else ''}</p>
</header>
<main>
<div class="linked">
<section id="stage" class="stage" aria-label="Two runs, playing"></section>
<section id="charts" class="charts" aria-label="Charts over time"></section>
</div>
<div class="parts">
<section class="part wide"><h2>What was found</h2>{results_table(runs, labels)}</section>
<section class="part wide"><h2>What the scenes do not have in common</h2>{differences(runs, labels)}</section>
</div>
</main>
<footer><p>Made by <code>postprocess/compare.py</code>. This file holds all that it shows; nothing is loaded from a network.</p></footer>
"""
    data = {"runs": entries, "panels": panels_of(entries)}
    return html_page(f"{', '.join(labels)} · Talus", body, data, blobs, mode="compare")


def main():
    arguments = parse_arguments()
    try:
        if not arguments.force:
            refuse_foreign(arguments.output)
        write_whole(arguments.output, page_of([Run(folder) for folder in arguments.runs]))
        print(arguments.output)
    except RunError as error:
        print(f"compare.py: {error}", file=sys.stderr)
        sys.exit(error.exit_code)
    except OSError as error:
        print(f"compare.py: {error.filename}: {error.strerror}.", file=sys.stderr)
        sys.exit(4)


if __name__ == "__main__":
    main()
