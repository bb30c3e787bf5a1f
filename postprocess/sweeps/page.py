# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of a sweep: a matrix of charts, a row for each result and a column for each key, and a table of the cases."""
import math

from run_page.page import html_page
from run_page.sections import number, text
from sweeps.results import quantities_of, setting

MOST_ROWS = 1000  # of the table of cases
MOST_LEVELS = 12  # of a key, for which means are drawn

STATES = {"done": "done", "failed": "failed", "unfinished": "not done yet"}


class Axis:
    """What a key was set to, as places along an axis: numbers, or words one after the other."""

    def __init__(self, key, values):
        self.key, self.values = key, [setting(value) for value in values]
        numbers = all(isinstance(value, (int, float)) and math.isfinite(value) for value in self.values)
        self.words = None if numbers else list(dict.fromkeys(str(value) for value in self.values))
        self.places = self.values if numbers else [self.words.index(str(value)) for value in self.values]

    def is_log(self):
        """Whether the numbers grow by factors rather than by steps: over two decades and more, most in the lower half."""
        known = sorted(set(self.places))
        if self.words or known[0] <= 0 or known[-1] < 100 * known[0]:
            return False
        return sum(one < 0.5 * known[-1] for one in self.places) > 0.7 * len(self.places)

    def means(self, values):
        """Mean of the values at each level; nothing where there are many levels, or one value at each."""
        levels = {}
        for place, value in zip(self.places, values):
            if value is not None:
                levels.setdefault(place, []).append(value)
        if self.words or not 2 <= len(levels) <= MOST_LEVELS or max(map(len, levels.values())) == 1:
            return []
        ordered = sorted(levels)
        return [{"x": ordered, "y": [sum(levels[place]) / len(levels[place]) for place in ordered], "kind": "mean"}]

    def chart(self, title, unit, values, errors, ids):
        kept = [k for k, value in enumerate(values) if value is not None]
        return {"title": title, "unit": unit, "across": self.key, "labels": self.words, "log": self.is_log(), "lines": self.means(values),
                "points": {"x": [self.places[k] for k in kept], "y": [values[k] for k in kept], "error": [errors[k] for k in kept], "id": [ids[k] for k in kept]}}

    def colouring(self):
        return {"title": self.key, "values": self.places, "range": [min(self.places), max(self.places)], "words": self.words}


def titled(sensor, name):
    return f"{sensor} · {name.replace('_', ' ')}"


def unit_text(unit):
    return {"1": "", "deg": "°"}.get(unit, unit)


def matrix(cases, keys):
    """The charts, row by row, of results that differ; and what they are coloured by."""
    axes = [Axis(key, [case.settings[key] for case in cases]) for key in keys]
    ids = list(range(len(cases)))
    charts, colourings = [], [axis.colouring() for axis in axes]
    for (sensor, name), unit in quantities_of(cases).items():
        found = [case.quantities().get((sensor, name), {}) for case in cases]
        values, errors = [one.get("value") for one in found], [one.get("spread") for one in found]
        known = [value for value in values if value is not None]
        if not known or min(known) == max(known):
            continue
        title = titled(sensor, name)
        charts += [axis.chart(title, unit_text(unit), values, errors, ids) for axis in axes]
        colourings.append({"title": f"{title}{f' [{unit_text(unit)}]' if unit_text(unit) else ''}", "values": values, "range": [min(known), max(known)], "words": None})
    return charts, colourings


def case_table(cases, keys):
    """A row for each case, with the way to its page."""
    quantities = list(quantities_of(cases).items())
    with_units = [f"{titled(sensor, name)}{f' [{unit_text(unit)}]' if unit_text(unit) else ''}" for (sensor, name), unit in quantities]
    head = "".join(f"<th scope='col'>{text(one)}</th>" for one in ["Case", *keys, "", *with_units])
    rows = []
    for n, case in enumerate(cases[:MOST_ROWS]):
        name = f"<a href='{page_of(case)}'>{case.number}</a>" if page_of(case) else str(case.number)
        cells = [f"<td>{text(case.settings[key])}</td>" for key in keys]
        cells.append(f"<td data-state='{case.state}' title='{text(case.reason)}'>{STATES[case.state]}{f': {text(case.reason)}' if case.reason else ''}</td>")
        found = case.quantities()
        cells += [f"<td>{number(found.get(key, {}).get('value'))}</td>" for key, _ in quantities]
        rows.append(f"<tr data-case='{n}'><th scope='row'>{name}</th>{''.join(cells)}</tr>")
    more = f"<p class='soft'>and {len(cases) - MOST_ROWS} more in results.csv</p>" if len(cases) > MOST_ROWS else ""
    return f"<div class='tall'><table><thead><tr>{head}</tr></thead><tbody>{''.join(rows)}</tbody></table></div>{more}"


def page_of(case):
    """The page of the run of a case, from the folder of the sweep; empty where there is none."""
    return f"cases/{case.folder.name}/report.html" if (case.folder / "report.html").is_file() else ""


def name_of(case, keys):
    """Case 7: friction = 0.3, seed = 2."""
    return f"Case {case.number}: " + ", ".join(f"{key} = {case.settings[key]}" for key in keys)


def lead(cases, keys):
    counts = [f"{sum(case.state == state for case in cases)} {word}" for state, word in STATES.items()]
    scene = next((case.summary["title"] for case in cases if case.summary.get("title")), "")
    return " · ".join(text(one) for one in [scene, f"{len(cases)} cases: {', '.join(one for one in counts if not one.startswith('0 '))}",
                                            f"varied: {', '.join(keys)}"] if one)


def sweep_page(folder, cases):
    """The page as HTML."""
    keys = folder.varied() or list(cases[0].settings)
    across = [key for key in keys if key != "seed"] or keys
    charts, colourings = matrix(cases, across)
    title = folder.about["title"] or folder.about["name"]
    body = f"""<header>
<div class="kind"><span class="mark" aria-hidden="true"></span>Talus · sweep</div>
<h1>{text(title)}</h1>
<p class="lead">{lead(cases, keys)}</p>
</header>
<main>
<div class="toolbar" id="colours"></div>
<section id="matrix" class="charts matrix" style="--columns: {len(across)}" aria-label="Results over settings"></section>
{"" if charts else "<p class='empty'>No two cases that are done have different results yet.</p>"}
<section class="part wide"><h2>Cases</h2>{case_table(cases, keys)}</section>
</main>
<footer><p>Bars are the spread that a sensor tells; lines join means. Numbers: <a href="results.csv">results.csv</a>, times <a href="costs.csv">costs.csv</a>.
Made by <code>talus gather</code>; nothing is loaded from a network.</p></footer>
"""
    data = {"groups": [{"id": "matrix", "charts": charts}],
            "cases": {"names": [name_of(case, keys) for case in cases], "pages": [page_of(case) for case in cases], "colourings": colourings if charts else [],
                      "coloured": 1 if len(across) > 1 else -1}}
    return html_page(f"{title} · Talus", body, data, {}, mode="charts")
