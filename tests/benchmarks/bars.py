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


class PeerBars(NamedTuple):
    """What is asked of a set-up of the peers; times are those of LAMMPS and LIGGGHTS by that of Talus."""
    name: str
    soft: float  # times, at the automatic step against 5e6 Pa …
    share: float | None  # … with at most this share of their mean overlap
    equal: float | None  # times, at the longest step with at most their overlap
    stiff: float | None  # times, at the automatic step against 5e7 Pa


PEER_BARS = (PeerBars("silo_10000", 5.0, 0.25, 8.0, 10.0), PeerBars("silo_2000", 4.0, 0.7, 7.0, None),
             PeerBars("pile_3000", 4.0, None, None, None))


def of_peers(store, asked):
    """Bar 1 for a set-up of the peers."""
    rows = {(row["code"], row["setting"]): row for row in store.get("peers", {}).get("rows", [])
            if row["setup"] == asked.name}
    name = asked.name.replace("_", " of ")
    own, converged = rows.get(("Talus", "auto")), rows.get(("Talus", "converged"))
    soft = [row for (code, setting), row in rows.items() if code != "Talus" and setting == "5e6 Pa"]
    stiff = [row for (code, setting), row in rows.items() if code != "Talus" and setting == "5e7 Pa"]
    if not own or not soft or not converged:
        yield missing(1, f"{name}: CPU seconds against LAMMPS and LIGGGHTS, 5e6 Pa", f"≥ {asked.soft:g} ×",
                      "not measured (`tests/run benchmarks peers`)")
        return

    def gain(what, others, row, least):
        times = [(other["code"], other["flowing_cpu"] / row["flowing_cpu"]) for other in others]
        return Bar(1, f"{name}: CPU seconds against {what}", f"≥ {least:g} ×",
                   ", ".join(f"{code} {ratio:.2f} ×" for code, ratio in times),
                   min(ratio for _, ratio in times) >= least)

    yield gain("LAMMPS and LIGGGHTS, 5e6 Pa", soft, own, asked.soft)
    if asked.share:
        level = min(row["flow_mean"] for row in soft)
        yield Bar(1, f"{name}: mean overlap while flowing, of theirs", f"≤ {asked.share:g}",
                  f"{own['flow_mean'] / level:.2f}", own["flow_mean"] <= asked.share * level)
    if asked.equal:
        equal = [row for (code, setting), row in rows.items()
                 if code == "Talus" and setting != "converged" and row["flow_mean"] <= level]
        longest = max(equal or [own], key=lambda row: row["step"])
        yield gain(f"theirs of 5e6 Pa, at {longest['setting']}", soft, longest, asked.equal)
    if asked.stiff and stiff:
        yield gain("theirs of 5e7 Pa", stiff, own, asked.stiff)
    if "angle" in own:
        error = own["angle"] - converged["angle"]
        yield Bar(1, f"{name}: angle against the converged run", "within 1.5°", f"{error:+.1f}°", abs(error) <= 1.5)
        return
    error = own["flow"] / converged["flow"] - 1.0
    spread = sum((row["flow_error"] / row["flow"]) ** 2 for row in (own, converged)) ** 0.5
    most, limit = (2.0 * spread, "two standard errors") if asked.name == "silo_2000" else (0.03, "3 %")
    yield Bar(1, f"{name}: flow against the converged run", f"within {limit}", f"{error:+.1%} ± {spread:.1%}",
              abs(error) <= most)


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
    of_all_peers = [bar for asked in PEER_BARS for bar in of_peers(store, asked)]
    return [*of_all_peers, *of_sweeps(steps, figures, triad), *of_threads(figures),
            *of_settled(figures), *of_size(figures)]
