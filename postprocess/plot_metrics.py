#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Plots how a run went over time from its metrics.csv: what its sensors saw, and how wrong it may be.

    postprocess/plot_metrics.py out/hopper                into out/hopper/metrics.png

Exit codes: 0 done, 2 wrong arguments or no such run, 4 a file of the run is damaged, or the figure cannot be
written.
"""
import argparse
import sys
from pathlib import Path

try:
    import matplotlib
    import numpy
except ImportError as error:
    print(f"plot_metrics.py: {error}: apt install python3-matplotlib, and use /usr/bin/python3.", file=sys.stderr)
    sys.exit(2)

from metric_panels import RUN_PANELS, sensor_panels
from read_run import Run, RunError

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402  after the choice of a backend without a screen


def sensor_results(run):
    """A line for each sensor with its results and their spreads; none until the run has ended."""
    for sensor, quantities in run.summary().get("sensors", {}).items():
        numbers = [f"{name.replace('_', ' ')} {number['value']:.4g} ± {number['spread']:.2g} {number['unit']}"
                   for name, number in quantities.items() if number["value"] is not None and number["spread"] is not None]
        silences = (number["silence"] for number in quantities.values() if "silence" in number)
        yield f"{sensor}: {', '.join(numbers) or next(silences, 'no result')}"


def draw_panel(axes, time, metrics, panel):
    title, label, scale, columns = panel
    for column, name in columns.items():
        if column in metrics:
            values = metrics[column]
            drawn = numpy.where(values > 0, values, numpy.nan) if scale == "log" else values
            axes.plot(time, drawn, label=name, linewidth=1)
    axes.set_title(title, fontsize="medium", loc="left")
    axes.set_ylabel(label)
    axes.set_yscale(scale)
    axes.grid(alpha=0.25)
    if len(columns) > 1:
        axes.legend(frameon=False, fontsize="small")


def draw(run):
    """A figure with two columns of panels over a common time."""
    metrics = run.metrics()
    panels = [*sensor_panels(run, metrics), *(panel for panel in RUN_PANELS if panel.columns.keys() & metrics.keys())]
    rows = (len(panels) + 1) // 2
    figure, grid = pyplot.subplots(rows, 2, figsize=(11, 2.2 * rows + 0.5), sharex=True, squeeze=False, layout="constrained")
    for axes, panel in zip(grid.flat, panels):
        draw_panel(axes, metrics["time_s"], metrics, panel)
    for axes in grid.flat[len(panels):]:
        axes.axis("off")
    for axes in grid.flat[max(0, len(panels) - 2):len(panels)]:
        axes.set_xlabel("time [s]")
        axes.tick_params(labelbottom=True)
    figure.suptitle("\n".join([run.title(), *sensor_results(run)]))
    return figure


def main():
    parser = argparse.ArgumentParser(description="Plots metrics.csv of a run.")
    parser.add_argument("run", metavar="OUT", help="the folder of a run")
    parser.add_argument("--output", type=Path, metavar="PNG", help="where to write the figure (OUT/metrics.png)")
    arguments = parser.parse_args()
    try:
        run = Run(arguments.run)
        path = arguments.output or run.folder / "metrics.png"
        draw(run).savefig(path, format="png", dpi=130)
        print(path)
    except RunError as error:
        print(f"plot_metrics.py: {error}", file=sys.stderr)
        sys.exit(error.exit_code)
    except OSError as error:
        print(f"plot_metrics.py: {error.filename}: {error.strerror}.", file=sys.stderr)
        sys.exit(4)


if __name__ == "__main__":
    main()
