# SPDX-License-Identifier: GPL-3.0-or-later
"""The page tests/results/benchmarks.md."""
import statistics

from bars import bars

PHASES = ("search", "assembly", "warm_start", "sweeps", "positions", "report")
COPIED = {f"{kind}_{size}": f"{count} of {kind}_32k" for kind in ("rest", "flow", "drum")
          for size, count in (("250k", 8), ("1M", 32))}
COPIED |= {f"wide_{size}": f"{count} of wide_4k" for size, count in (("32k", 8), ("250k", 64), ("1M", 256))}
COPIED["smooth_32k"] = "8 of smooth_4k"

HEAD = """# Benchmarks

This page is written by `tests/run benchmarks` and `tests/run benchmarks peers` from `benchmarks.json`; nothing on it is
typed by hand. Seconds on one thread are of the processor, on two by the clock. Only figures of one run can be compared
with each other: others use the machine too, and the triad says what it gave at the time.

## Bars
"""

BEDS = """A bed is simulated once and kept, then goes on for 30 steps before anything is measured. `rest`, `flow` and
`wide` lie in a trough 40 (4k: 20) spheres wide and half as long, periodic along its length, 35 (4k: 17) deep: at rest;
flowing out through a slot; at rest with diameters of 6 to 18 mm. `smooth` is `rest` without friction. All others are of
10 mm ± 5 %. `drum` turns half full. Where it says *copies*, they lie side by side along the periodic axis. `silo`,
`hopper`, `pile`, `drum`, `packing` without a size are the shipped scenes at 2, 1.6, 3, 2.5 and 1 s.
"""

SWEEPS = """Ten sweeps on the contacts of one step, after the warm start, each time from the same impulses and
velocities; the median. *Bytes* is the least that an update moves with all numbers in double: 80 B for the contact,
with friction 136, with rolling 200; and 128 B for each sphere, read and written once in a sweep. So *GB/s* is what was
of use, and beds that fit into a cache may exceed the triad (a = b + 3 c over 400 MB).
"""

STEPS = """Milliseconds of a step on one thread and the share of each phase in them; `report` is all that comes after
positions. *Gain* is what two threads bring, the median of blocks of steps in turn; *serial* the share of a step that
would explain it (Karp and Flatt 1990).
"""


def table(header, rows, texts=1):
    """Markdown; after so many columns of text come numbers."""
    lines = ["| " + " | ".join(header) + " |", "|" + " --- |" * texts + " ---: |" * (len(header) - texts)]
    lines += ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join(lines).replace("|  |", "| |") + "\n"


def number(value, digits=3):
    if value is None:
        return "–"
    return f"{value:,.0f}".replace(",", " ") if abs(value) >= 10 ** (digits - 1) else f"{value:.{digits}g}"


def of_group(figures, group):
    """Names without the group, and their figures."""
    return {name.removeprefix(group + "/"): value for name, value in figures.items() if name.startswith(group + "/")}


def triad_of(figures, threads):
    rates = [value["GB_s"] for name, value in of_group(figures, "triad").items() if name.endswith(f"/{threads}")]
    return statistics.median(rates) if rates else None


def origin(part):
    return f"commit {part['commit']}, {part['date']}, {part['machine']}"


def bar_table(store, triad):
    verdict = {True: "holds", False: "**no**", None: "–"}
    rows = [(str(bar.number), bar.what, bar.asked, bar.measured, verdict[bar.holds]) for bar in bars(store, triad)]
    return table(("bar", "what", "asked", "measured", ""), rows, texts=5)


def sweep_table(figures, triad):
    rows = []
    for name, value in of_group(figures, "sweeps").items():
        bed, _, variant = name.partition("/")
        rate, two = value["Mupdates_s"], value.get("Mupdates_s_two_threads")
        flow = 1e-3 * rate * value["bytes"]
        what = "friction" if variant == "as_is" else variant.replace("_", " ")
        if bed.startswith("smooth"):
            what = "no friction"
        if bed.startswith("drum"):
            what += ", moving walls"
        rows.append((bed, what, COPIED.get(bed, ""), number(value["spheres"]), number(value["contacts"]), number(rate),
                     number(two), number(value["bytes"]), number(flow), f"{flow / triad:.0%}"))
    return table(("bed", "models", "copies", "spheres", "contacts", "million updates/s", "two threads", "bytes", "GB/s",
                  "of triad"), rows, texts=3)


def step_table(figures):
    rows = []
    for bed, value in of_group(figures, "steps").items():
        gain = value.get("gain_of_two_threads")
        shares = [f"{value['step_ms'] * value[phase]:.3g} ({value[phase]:.0%})" for phase in PHASES]
        rows.append((bed, number(value["spheres"]), number(value["candidates"]), number(value["contacts"]),
                     f"{value['sweeps_a_step']:.1f}", number(value["step_ms"]), *shares,
                     number(value["assembly_ns_contact"]), number(value["ns_sphere_step"]), number(value["Mupdates_s"]),
                     f"{gain:.2f}" if gain else "–", f"{max(0.0, 2.0 / gain - 1.0):.0%}" if gain else "–"))
    header = ("bed", "spheres", "candidates", "contacts", "sweeps", "ms a step",
              *(phase.replace("_", " ") for phase in PHASES), "assembly, ns a contact", "ns a sphere",
              "million updates/s", "gain", "serial")
    return table(header, rows)


def two_thread_table(figures):
    """Where the time of two threads goes."""
    rows = [(bed, number(value["step_ms_two_threads"]), *(f"{value[phase + '_two_threads']:.0%}" for phase in PHASES))
            for bed, value in of_group(figures, "steps").items() if "gain_of_two_threads" in value]
    if not rows:
        return "Two threads were not measured: no two processors were free.\n"
    return "Two threads, by the clock:\n\n" + table(
        ("bed", "ms a step", *(phase.replace("_", " ") for phase in PHASES)), rows)


def other_tables(figures):
    search = [(bed, number(value["spheres"]), number(value["candidates"]), number(value["ns_sphere"]))
              for bed, value in of_group(figures, "search").items()]
    files = [(name.replace("_", " ").replace("/", ", "), number(value["B_sphere"]), number(value["MB_s"]))
             for name, value in of_group(figures, "files").items()]
    settled = [(bed.removeprefix("w3_"), number(value["contacts"]), number(value["step_ms"]),
                number(value["Mupdates_s"]), f"{value['kinetic_energy_J']:.1e}")
               for bed, value in of_group(figures, "settled").items()]
    return "\n".join([
        "## Search", "", "All pairs listed anew, one thread.", "",
        table(("bed", "spheres", "candidates", "ns a sphere"), search),
        "## Files", "", "CPU seconds, so that the disk does not count.", "",
        table(("what", "B a sphere", "MB/s"), files),
        "## Settled boxes", "", "Settled for a second, then 1000 steps of 1 ms with 50 sweeps each, one thread.", "",
        table(("spheres", "contacts", "ms a step", "million updates/s", "kinetic energy after it [J]"), settled)])


def peer_tables(part):
    lines = ["## Peers", "", f"Measured at {origin(part)}. One thread each; [peers.md](../benchmarks/peers/peers.md) "
             "has the set-ups. CPU seconds are for a simulated second, overlaps in mean diameters, flows in spheres a "
             "second.", ""]
    for code in part["skipped"]:
        lines += [f"{code} was skipped: it is not installed.", ""]
    lines += ["![What a silo costs, over how deep its spheres overlap](front.svg)", "",
              "A silo that discharges: CPU seconds for a simulated second, over the mean overlap of its contacts. Lower "
              "and further left is better.", ""]
    for setup in dict.fromkeys(row["setup"] for row in part["rows"]):
        rows = sorted((row for row in part["rows"] if row["setup"] == setup),
                      key=lambda row: ("Talus", "LAMMPS", "LIGGGHTS").index(row["code"]))
        runs = rows[0]["runs"]
        how = f"{runs} runs each, the median; of the flow the mean." if runs > 1 else "One run each."
        lines += [f"### {setup.replace('_', ' of ').capitalize()}", "", how, ""]
        if setup.startswith("silo"):
            header = ("code", "setting", "step [ms]", "settling, CPU s", "discharging, CPU s", "flow",
                      "mean overlap before opening",
                      "worst", "mean while flowing", "worst")
            cells = [(row["code"], row["setting"], number(1e3 * row["step"]), number(row["settling_cpu"]),
                      number(row["flowing_cpu"]),
                      f"{number(row['flow'])} ± {row['flow_error']:.0f}",
                      *(f"{row[name]:.3%}" for name in ("rest_mean", "rest_worst", "flow_mean", "flow_worst")))
                     for row in rows]
        else:
            header = ("code", "setting", "step [ms]", "CPU s", "angle [°]", "over the lip", "mean overlap", "worst")
            cells = [(row["code"], row["setting"], number(1e3 * row["step"]), number(row["flowing_cpu"]),
                      f"{row['angle']:.1f}",
                      number(row["lost"]), f"{row['rest_mean']:.3%}", f"{row['rest_worst']:.2%}") for row in rows]
        lines.append(table(header, cells, texts=2))
    return "\n".join(lines)


def page(store):
    steps = store.get("steps")
    figures = steps["figures"] if steps else {}
    triad = triad_of(figures, 1)
    parts = [HEAD, bar_table(store, triad)]
    if steps:
        free = statistics.median(value["free_processors"] for value in of_group(figures, "machine").values())
        widest = (steps["instruction_sets"] or ["SSE2"])[0]
        parts += ["## Machine\n", f"Measured at {origin(steps)}, which has {widest}. Triad {triad:.1f} GB/s on one "
                  f"thread, {triad_of(figures, 2):.1f} on two. Others left {free:.1f} processors free.\n",
                  "## Beds\n", BEDS, "## Sweeps\n", SWEEPS, sweep_table(figures, triad), "## Steps\n", STEPS,
                  step_table(figures), two_thread_table(figures), other_tables(figures)]
    if "peers" in store:
        parts.append(peer_tables(store["peers"]))
    return "\n".join(parts).rstrip() + "\n"
