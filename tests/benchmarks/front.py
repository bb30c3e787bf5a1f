# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture tests/results/front.svg: what a discharging silo costs in each code, over how deep its spheres overlap."""
import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402  after its backend was chosen
from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter  # noqa: E402

COLOURS = {"Talus": "#1b6ca8", "LAMMPS": "#c05a1c", "LIGGGHTS": "#6b7a3a"}
SHAPES = {"Talus": "o", "LAMMPS": "s", "LIGGGHTS": "^"}
BESIDE = {"Talus": (4, 5), "LAMMPS": (4, 5), "LIGGGHTS": (4, -10)}  # where a point's words stand


def draw_front(rows, path):
    """@param rows of the peers' silos; the run that counts as converged is left out"""
    setups = [name for name in dict.fromkeys(row["setup"] for row in rows) if name.startswith("silo")]
    figure, axes = plt.subplots(1, len(setups), figsize=(5.0 * len(setups), 4.2), squeeze=False, layout="tight")
    for axis, setup in zip(axes[0], setups, strict=True):
        for code, colour in COLOURS.items():
            points = sorted((100 * row["flow_mean"], row["flowing_cpu"], row["setting"]) for row in rows
                            if (row["setup"], row["code"]) == (setup, code) and row["setting"] != "converged")
            if not points:
                continue
            axis.plot([x for x, _, _ in points], [y for _, y, _ in points], SHAPES[code] + "-", color=colour, label=code)
            for x, y, setting in points:
                axis.annotate(setting, (x, y), textcoords="offset points", xytext=BESIDE[code], fontsize=7, color=colour)
        axis.set(xscale="log", yscale="log", title=setup.replace("_", " of "),
                 xlabel="mean overlap while flowing [% of a diameter]", ylabel="CPU s for a simulated second")
        for scale in (axis.xaxis, axis.yaxis):
            scale.set_major_locator(LogLocator(subs=(1, 2, 5)))
            scale.set_major_formatter(StrMethodFormatter("{x:g}"))
            scale.set_minor_formatter(NullFormatter())
        axis.margins(0.15)
        axis.grid(which="both", color="#e4e4e4", linewidth=0.6)
        axis.legend(frameon=False)
    matplotlib.rcParams["svg.hashsalt"] = "talus"  # the same bytes for the same figures
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)
