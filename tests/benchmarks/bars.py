# SPDX-License-Identifier: GPL-3.0-or-later
"""The bars that the speed of Talus is measured against: what is asked, what was measured, and whether it holds."""
from typing import NamedTuple

# Seconds of a step of 1 ms with 50 sweeps, measured once (2026-11-21, 2 × AMD EPYC): peers/peers.md.
BULLET = {5000: 0.047, 20000: 0.332}
CHRONO = {5000: 0.244, 20000: 0.947}


class Bar(NamedTuple):
    number: int
    what: str
    asked: str
    measured: str
    holds: bool | None  # None where it was not measured


def missing(number, what, asked, why="not measured"):
    return Bar(number, what, asked, why, None)


def of_peers(store, count):
    """Bar 1 for a silo of so many spheres."""
    rows = {(row["code"], row["setting"]): row for row in store.get("peers", {}).get("rows", [])
            if row["setup"] == f"silo_{count}"}
    name = f"silo of {count}"
    own, converged = rows.get(("Talus", "default")), rows.get(("Talus", "converged"))
    soft = [row for (code, setting), row in rows.items() if code != "Talus" and setting == "5e6 Pa"]
    stiff = [row for (code, setting), row in rows.items() if code != "Talus" and setting == "5e7 Pa"]
    if not own or not soft:
        yield missing(1, f"{name}: CPU seconds against LAMMPS and LIGGGHTS, 5e6 Pa", "≥ 5 ×",
                      "not measured (`tests/run benchmarks peers`)")
        return

    def times(rows_of_others, row):
        return [(other["code"], other["flowing_cpu"] / row["flowing_cpu"]) for other in rows_of_others]

    def told(found):
        return ", ".join(f"{code} {ratio:.2f} ×" for code, ratio in found)

    gain = times(soft, own)
    yield Bar(1, f"{name}: CPU seconds against LAMMPS and LIGGGHTS, 5e6 Pa", "≥ 5 ×", told(gain),
              min(ratio for _, ratio in gain) >= 5.0)
    if not converged:
        yield missing(1, f"{name}: flow against the converged run", "within 3 %")
    else:
        error = own["flow"] / converged["flow"] - 1.0
        spread = sum((row["flow_error"] / row["flow"]) ** 2 for row in (own, converged)) ** 0.5
        yield Bar(1, f"{name}: flow against the converged run", "within 3 %", f"{error:+.1%} ± {spread:.1%}",
                  abs(error) <= 0.03)
    overlap = own["flow_mean"] / min(row["flow_mean"] for row in soft)
    yield Bar(1, f"{name}: mean overlap against theirs", "≤ 0.25", f"{overlap:.2f}", overlap <= 0.25)
    level = min(row["flow_mean"] for row in soft)
    equal = [row for (code, _), row in rows.items() if code == "Talus" and row["flow_mean"] <= level]
    if equal:
        best = min(equal, key=lambda row: row["flowing_cpu"])
        gain = times(soft, best)
        yield Bar(1, f"{name}: CPU seconds at their mean overlap ({best['setting']})", "≥ 8 ×", told(gain),
                  min(ratio for _, ratio in gain) >= 8.0)
    if not stiff:
        yield missing(1, f"{name}: CPU seconds against them with 5e7 Pa", "≥ 12 ×")
    else:
        gain = times(stiff, own)
        yield Bar(1, f"{name}: CPU seconds against them with 5e7 Pa", "≥ 12 ×", told(gain),
                  min(ratio for _, ratio in gain) >= 12.0)


def of_sweeps(steps, figures, triad):
    """Bar 2."""
    def rate(name):
        return figures.get(f"sweeps/{name}", {}).get("Mupdates_s")

    silo, widest = rate("silo/as_is"), (steps.get("instruction_sets") or ["SSE2"])[0]
    asked = {"AVX-512": 100, "AVX2": 60}.get(widest)
    if silo and asked:
        yield Bar(2, f"sweeps of the discharging silo, {widest}", f"≥ {asked} million a second", f"{silo:.0f}",
                  silo >= asked)
    else:
        yield missing(2, "sweeps of the discharging silo", "≥ 100 million a second")
    million = figures.get("sweeps/flow_1M/as_is")
    what = "sweeps of a million in flow"
    if million and triad:
        share = million["Mupdates_s"] * million["bytes"] * 1e-3 / triad
        yield Bar(2, what, "≥ 60 million a second, ≥ 50 % of triad", f"{million['Mupdates_s']:.0f}, {share:.0%}",
                  million["Mupdates_s"] >= 60.0 and share >= 0.5)
    else:
        yield missing(2, what, "≥ 60 million a second, ≥ 50 % of triad", "not measured (`tests/run benchmarks large`)")
    bare, full = rate("smooth_32k/as_is"), rate("rest_32k/as_is")
    if bare and full:
        yield Bar(2, "sweeps without friction against those with it, bed of 32 000", "≥ 1.5 ×", f"{bare / full:.2f} ×",
                  bare >= 1.5 * full)


def of_threads(figures):
    """Bar 3."""
    for bed in ("rest_32k", "flow_32k", "rest_250k", "flow_250k"):
        gain = figures.get(f"steps/{bed}", {}).get("gain_of_two_threads")
        what, asked = f"two threads, whole step, {bed}", "≥ 1.8 ×; serial share ≤ 3 %"
        if gain is None:
            yield missing(3, what, asked, "not measured: no two processors were free")
        else:
            serial = 2.0 / gain - 1.0
            yield Bar(3, what, asked, f"{gain:.2f} ×; {max(0.0, serial):.0%}", gain >= 1.8 and serial <= 0.03)


def of_settled(figures):
    """Bar 4."""
    for count in (5000, 20000):
        box = figures.get(f"settled/w3_{count}")
        what = (f"settled box of {count}, 50 sweeps: against Bullet and Chrono as they were on another day; kinetic "
                "energy after a second")
        asked = "≥ 4 ×, ≥ 20 ×; ≤ 1e-6 J"
        if not box:
            yield missing(4, what, asked)
            continue
        bullet, chrono = (peer[count] / (1e-3 * box["step_ms"]) for peer in (BULLET, CHRONO))
        energy = box["kinetic_energy_J"]
        yield Bar(4, what, asked, f"{bullet:.1f} ×, {chrono:.1f} ×; {energy:.1e} J",
                  bullet >= 4.0 and chrono >= 20.0 and energy <= 1e-6)


def of_size(figures):
    """Bar 5."""
    for kind in ("rest", "flow"):
        cost = {size: figures.get(f"steps/{kind}_{size}", {}).get("ns_sphere_step") for size in ("32k", "250k", "1M")}
        what, asked = f"cost of a sphere and step, {kind}, a million against 32 000", "< 1.3 ×"
        if cost["32k"] and cost["1M"]:
            ratio = cost["1M"] / cost["32k"]
            yield Bar(5, what, asked, f"{ratio:.2f} ×", ratio < 1.3)
        elif cost["32k"] and cost["250k"]:
            yield missing(5, what, asked,
                          f"250 000: {cost['250k'] / cost['32k']:.2f} × (a million: `tests/run benchmarks large`)")
        else:
            yield missing(5, what, asked)


def bars(store, triad):
    """All bars. `triad` is in GB/s, of one thread."""
    steps = store.get("steps", {})
    figures = steps.get("figures", {})
    return [*of_peers(store, 10000), *of_peers(store, 2000), *of_sweeps(steps, figures, triad), *of_threads(figures),
            *of_settled(figures), *of_size(figures)]
