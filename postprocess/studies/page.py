# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of a study: advice, a chart of each error against cost, and all settings."""
import math

from run_page.page import html_page
from run_page.sections import text
from studies.result import SURE, advice, front

LAWS = ["matched", "projected"]


def law_of(point):
    return int("projected" in point.setting)


def shown(value):
    return f"{value:.2g}" if math.isfinite(value) else "–"


def chart(result, k):
    """Of one kind of error: the settings as points, and a line along those that no cheaper one beats."""
    kind = result.kinds[k]
    kept = [i for i, point in enumerate(result.points) if i > 0 and point.is_done() and math.isfinite(point.errors[k].value)]
    at = {i: (result.points[i].cpu, result.points[i].errors[k].value) for i in kept}
    stairs = []
    for i in front(result, k):
        stairs += [(at[i][0], stairs[-1][1]), at[i]] if stairs else [at[i]]
    spreads = [result.points[i].errors[k].spread for i in kept]
    return {"title": kind.name, "unit": "" if kind.unit == "1" else kind.unit, "across": "CPU seconds for a simulated second", "log": True, "logUp": True,
            "note": kind.meaning, "ring": 1, "lines": [{"x": [x for x, _ in stairs], "y": [y for _, y in stairs], "kind": "mean"}],
            "points": {"x": [at[i][0] for i in kept], "y": [at[i][1] for i in kept], "id": kept,
                       "error": [SURE * one if math.isfinite(one) else None for one in spreads]}}


def has_something_to_show(result, k):
    return any(point.is_done() and math.isfinite(point.errors[k].value) and point.errors[k].value > 0 for point in result.points[1:])


def setting_table(result):
    units = ["CPU s / s", "contact updates / s", "MB", *(f"{kind.name} [{kind.unit}]" if kind.unit != "1" else kind.name for kind in result.kinds)]
    head = "".join(f"<th scope='col'>{text(one)}</th>" for one in ["Setting", *units])
    rows = []
    for n, point in enumerate(result.points):
        if point.is_done():
            cells = [f"{point.cpu:.3g}", f"{point.updates:.2e}", f"{1e-6 * point.memory:.0f}",
                     *(shown(e.value) + (f" ± {e.spread:.1g}" if e.spread > 0 else "") for e in point.errors)]
            row = "".join(f"<td>{one}</td>" for one in cells)
        else:
            row = f"<td colspan='{len(units)}'>{text(point.status)}</td>"
        rows.append(f"<tr data-case='{n}'><th scope='row'>{text(point.setting)}</th>{row}</tr>")
    return f"<div class='tall'><table><thead><tr>{head}</tr></thead><tbody>{''.join(rows)}</tbody></table></div>"


def study_page(result, title, what):
    """The page as HTML.

    what: sentences on what was studied, and its units
    """
    charts = [chart(result, k) for k in range(len(result.kinds)) if has_something_to_show(result, k)]
    sentences = "".join(f"<li>{text(one)}</li>" for one in advice(result))
    body = f"""<header>
<div class="kind"><span class="mark" aria-hidden="true"></span>Talus · study</div>
<h1>{text(title)}</h1>
<p class="lead">{text(what)}</p>
</header>
<main>
<section class="part wide"><h2>Advice</h2><ul>{sentences}</ul></section>
<div class="toolbar" id="colours"></div>
<section id="errors" class="charts matrix" style="--columns: 2" aria-label="Error against cost"></section>
<section class="part wide"><h2>All settings</h2>{setting_table(result)}</section>
</main>
<footer><p>A point is a setting; the ring is the default, bars are 95 % intervals, and the line joins the settings for which no cheaper one has as
small an error. Numbers: <a href="study.csv">study.csv</a>. Made by <code>talus study</code>; nothing is loaded from a network.</p></footer>
"""
    law = {"title": "stabilisation", "values": [law_of(point) for point in result.points], "range": [0, 1], "words": LAWS}
    data = {"groups": [{"id": "errors", "charts": charts}],
            "cases": {"names": [point.setting for point in result.points], "pages": None, "colourings": [law], "coloured": 0}}
    return html_page(f"Study: {title} · Talus", body, data, {}, mode="charts")
