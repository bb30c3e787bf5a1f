# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of a calibration: what the keys may be, how they trade off, how well the measurements are met."""
import itertools

import numpy

from calibration.findings import UNLIKELY
from run_page.page import html_page
from run_page.sections import number, table, text, with_spread
from sweeps.page import unit_text
from sweeps.setting_text import setting_text

BINS = 48  # of a density
CLOUD = 1200  # points of a trade-off
FEW = 150  # points of a posterior, too few for its intervals


def density_chart(found, k, key):
    """How likely the values of one key are, against before, with its 95 % interval shaded."""
    values = found.value(k, found.posterior.places[:, k])
    one = found.target.unknown[key]
    edges = found.value(k, numpy.linspace(0, 1, 4 * BINS + 1))
    heights, _ = numpy.histogram(values, edges, density=True)
    window = numpy.hanning(max(2, round(4 * BINS * found.posterior.places[:, k].std())) + 2)[1:-1]  # a deviation wide
    smooth = numpy.convolve(heights, window, "same") / numpy.convolve(numpy.ones(len(heights)), window, "same")
    before = 1.0 / (edges[1:] - edges[:-1]) / (4 * BINS)
    middles = ((edges[1:] + edges[:-1]) / 2).tolist()
    _, low, high = (float(found.value(k, share)) for share in found.posterior.interval(k))
    return {"title": key, "unit": "probability density", "log": one.log, "shade": [low, high], "reach": {"x": [one.low, one.high], "y": [0]},
            "lines": [{"x": middles, "y": before.tolist(), "kind": "guide"}, {"x": middles, "y": smooth.tolist(), "kind": "density"}]}


def pair_chart(found, first, second):
    """Which values of two keys go together."""
    keys = list(found.target.unknown)
    places = found.posterior.places[:: max(1, len(found.posterior.places) // CLOUD)]
    together = float(numpy.corrcoef(found.posterior.places[:, [first, second]].T)[0, 1])
    word = "nothing to do with each other" if abs(together) < 0.2 else "one makes up for the other" if together < 0 else "they rise together"
    ranges = list(found.target.unknown.values())
    return {"title": keys[second], "across": keys[first], "log": ranges[first].log,
            "note": f"correlation {together:.2f}: {word}",
            "points": {"x": found.value(first, places[:, first]).tolist(), "y": found.value(second, places[:, second]).tolist(), "cloud": True},
            "reach": {"x": [ranges[first].low, ranges[first].high], "y": [ranges[second].low, ranges[second].high]}}


def fit_chart(found):
    """Each measurement and what the posterior tells of it, in its own errors."""
    told = found.told(found.posterior.places)
    places, errors = [], []
    for one, (mean, error) in zip(found.target.measured, told):
        places.append(float((mean.mean() - one.value) / one.error))
        errors.append(float(numpy.sqrt(mean.var() + numpy.mean(error**2)) / one.error))
    labels = [f"{n + 1}" for n in range(len(places))]
    return {"title": "Simulated minus measured", "unit": "in errors of the measurement", "across": "measurement", "labels": labels,
            "points": {"x": list(range(len(places))), "y": places, "error": errors},
            "lines": [{"x": [-0.5, len(places) - 0.5], "y": [height] * 2, "kind": "guide"} for height in (-1, 1)]}


def emulator_chart(one, unit, emulator):
    """What the emulator tells of each run from the others."""
    ends = [float(min(emulator.values.min(), emulator.left_out.min())), float(max(emulator.values.max(), emulator.left_out.max()))]
    return {"title": f"{one.scene}: {one.title}", "unit": unit_text(unit), "across": "found by a run",
            "points": {"x": emulator.values.tolist(), "y": emulator.left_out.tolist(), "error": emulator.left_out_error.tolist()},
            "lines": [{"x": ends, "y": ends, "kind": "guide"}],
            "note": f"told from the other runs; scatter from run to run {emulator.scatter:.2g} {unit_text(unit)}"}


def cards(found):
    parts = []
    for k, key in enumerate(found.target.unknown):
        median, low, high = (float(found.value(k, share)) for share in found.posterior.interval(k))
        parts.append(f"<div class='card'><span>{text(key)}</span><b>{number(median, 3)}</b> <small>95 %: {number(low, 3)} to {number(high, 3)}</small></div>")
    return f"<div class='cards'>{''.join(parts)}</div>"


def fit_table(found):
    best = found.told(found.posterior.best[None, :])
    rows = []
    for n, (one, unit, emulator, (mean, error)) in enumerate(zip(found.target.measured, found.units, found.emulators, best), 1):
        rows.append((f"{n} · {one.scene}: {one.title}{f' [{unit_text(unit)}]' if unit_text(unit) else ''}", with_spread(one.value, one.error),
                     with_spread(float(mean[0]), float(error[0])), number(emulator.scatter / one.repeats**0.5, 2), number((float(mean[0]) - one.value) / one.error, 2)))
    return table(rows, ("", "measured", "simulated, with the emulator's error", "scatter of an experiment", "difference in errors"))


def warnings_of(found):
    """What to know before the intervals are believed."""
    told = []
    if found.chance() < UNLIKELY:
        told.append("No values in the ranges meet all measurements: the best ones miss them by more than their errors and the scatter allow. "
                    "A range may be too narrow, an error too small, or the scene is not the experiment.")
    for k, key in enumerate(found.target.unknown):
        _, low, high = found.posterior.interval(k)
        if high - low > 0.8:
            told.append(f"{key} is hardly told by these measurements: its interval is nearly its whole range.")
        elif low < 0.01 or high > 0.99:
            told.append(f"{key} comes close to an end of its range: a wider one may change the interval.")
    if found.posterior.counting < FEW:
        told.append(f"Only {found.posterior.counting:.0f} points stand for what is likely: so many unknown keys make the intervals coarse.")
    for scene, count in found.dropped.items():
        if count:
            told.append(f"{count} of the cases of {scene} {'has' if count == 1 else 'have'} no result, and {'is' if count == 1 else 'are'} left out.")
    _, errors = zip(*found.told(found.posterior.best[None, :]))
    shares = [float(error[0]) ** 2 / (one.error**2 + float(error[0]) ** 2 + emulator.scatter**2 / one.repeats)
              for one, emulator, error in zip(found.target.measured, found.emulators, errors)]
    if max(shares) > 0.4:
        told.append("More samples would narrow the intervals: the emulator's own error is a large part of what is not known.")
    return "".join(f"<li>{text(one)}</li>" for one in told)


def calibration_page(found, sweeps):
    """The page as HTML. sweeps: folder of the sweep of each scene, from that of the page."""
    target = found.target
    best = " ".join(f"--set {key}={setting_text(float(f'{float(found.value(k, found.posterior.best[k])):.4g}'))}" for k, key in enumerate(target.unknown))
    notes = warnings_of(found)
    pairs = list(itertools.combinations(range(len(target.unknown)), 2))
    body = f"""<header>
<div class="kind"><span class="mark" aria-hidden="true"></span>Talus · calibration</div>
<h1>{text(target.title)}</h1>
<p class="lead">{len(target.measured)} measurements · {len(target.unknown)} unknown keys · {' · '.join(f'<a href="{text(path)}/sweep.html">{len(found.emulators[[one.scene for one in target.measured].index(name)].values)} runs of {text(name)}</a>' for name, path in sweeps.items())}</p>
{f'<ul class="incidents">{notes}</ul>' if notes else ''}
{cards(found)}
</header>
<main>
<section><h2>What the keys may be</h2><div id="densities" class="charts"></div></section>
{'<section><h2>What trades off</h2><div id="pairs" class="charts"></div></section>' if pairs else ''}
<section class="part wide"><h2>How the measurements are met</h2>{fit_table(found)}<div id="fit" class="charts"></div>
<p class="soft">Simulated: at the likeliest values, in the table; over all likely values, in the chart.</p>
<pre class="copy">{text(best)}</pre></section>
<section><h2>How well the runs are emulated</h2><div id="emulators" class="charts"></div></section>
</main>
<footer><p>Shaded: 95 % intervals; dashed: what was assumed before. Numbers: <a href="calibration.json">calibration.json</a>.
Made by <code>talus calibrate</code>; nothing is loaded from a network.</p></footer>
"""
    groups = [{"id": "densities", "charts": [density_chart(found, k, key) for k, key in enumerate(target.unknown)]},
              {"id": "fit", "charts": [fit_chart(found)]},
              {"id": "emulators", "charts": [emulator_chart(*one) for one in zip(target.measured, found.units, found.emulators)]}]
    if pairs:
        groups.append({"id": "pairs", "charts": [pair_chart(found, *pair) for pair in pairs]})
    return html_page(f"{target.title} · Talus", body, {"groups": groups}, {}, mode="charts")
