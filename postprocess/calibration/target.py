# SPDX-License-Identifier: GPL-3.0-or-later
"""What was measured, and which keys are unknown."""
import math
from dataclasses import dataclass
from pathlib import Path

from sweeps.request import Sweep, Table, leaves, read_fixed, read_range, read_seeds, read_toml, scene_of


@dataclass(frozen=True)
class Measured:
    """A measurement, and the sensor that finds the same in a run of a scene."""
    scene: str  # a name of Target.sweeps
    sensor: str
    name: str
    value: float
    error: float  # standard deviation
    unit: str  # as asked for; empty: whatever the sensor has
    repeats: int  # experiments of which the value is the mean

    @property
    def title(self):
        return f"{self.sensor} · {self.name.replace('_', ' ')}"


@dataclass
class Target:
    name: str
    title: str
    unknown: dict  # Range by key
    measured: list
    sweeps: dict  # by name: runs of a scene with values of the unknown keys


def read_target(path):
    """The target of a file. Raises RunError with what is wrong and what is allowed."""
    path = Path(path)
    table = Table(path, "", read_toml(path), ("title", "seeds", "threads", "reports", "set", "unknown", "measured", "design"))
    unknown = {}
    for key, value in leaves(table.get("unknown", dict, allowed="a table of keys with ranges { from = …, to = … }"), lambda value: "from" in value or "to" in value):
        if not isinstance(value, dict):
            table.refuse(f"'{key}' must be a range {{ from = …, to = … }}, not {value!r}")
        unknown[key] = read_range(lambda *words: Table(path, *words), key, value)
        if unknown[key].steps is not None or unknown[key].whole:
            table.refuse(f"'{key}' has 'steps' or 'whole', but what is unknown may have any value between its ends")
    if not unknown:
        table.refuse("[unknown] has no keys")
    design = Table(path, "design", table.get("design", dict, {}), ("samples", "seed"))
    positive = {"allowed": "a whole number from 1 up", "good": lambda n: n >= 1}
    common = {"kind": "sobol", "seeds": read_seeds(table), "threads": table.get("threads", int, 1, **positive),
              "reports": table.get("reports", bool, False), "samples": design.get("samples", int, 16 * 2 ** (len(unknown) - 1), **positive),
              "design_seed": design.get("seed", int, 1, "a whole number from 0 up", lambda n: n >= 0)}
    fixed = read_fixed(table.get("set", dict, {}))
    measured, sweeps = [], {}
    for values in table.get("measured", list, allowed="a list of [[measured]]"):
        one = Table(path, "measured", values, ("scene", "set", "quantity", "value", "error", "unit", "repeats", "leaves_out"))
        left_out = one.get("leaves_out", list, [], "a list of keys of [unknown], some of them", lambda keys: set(keys) < set(unknown))
        own = {**fixed, **read_fixed(one.get("set", dict, {}))}
        if both := set(own) & set(unknown):
            table.refuse(f"'{sorted(both)[0]}' is set and in [unknown]")
        scene = scene_of(path, one.get("scene", str, allowed="a scene file, or the name of a scene"))
        name = sweep_of(sweeps, Sweep(name=Path(scene).stem, scene=scene, fixed=own, **common,
                                      vary={key: one for key, one in unknown.items() if key not in left_out}))
        sensor, _, quantity = one.get("quantity", str, allowed="a sensor and what it finds, as 'outlet.mass_flow'", good=lambda text: "." in text.strip(".")).rpartition(".")
        measured.append(Measured(name, sensor, quantity, one.get("value", float, allowed="a finite number", good=math.isfinite),
                                 one.get("error", float, allowed="a standard deviation above 0", good=lambda error: 0 < error < math.inf),
                                 one.get("unit", str, ""), one.get("repeats", int, 1, **positive)))
    if not measured:
        table.refuse("there is no [[measured]]")
    for key in unknown:
        if not any(key in sweep.vary for sweep in sweeps.values()):
            table.refuse(f"'{key}' is left out of every scene")
    return Target(path.stem, table.get("title", str, "") or path.stem, unknown, measured, sweeps)


def sweep_of(sweeps, sweep):
    """The name of the same sweep among those that there are, else of this one, which is put beside them."""
    for name, other in sweeps.items():
        if (other.scene, other.fixed, other.vary) == (sweep.scene, sweep.fixed, sweep.vary):
            return name
    name = sweep.name if sweep.name not in sweeps else f"{sweep.name}-{len(sweeps) + 1}"
    sweep.name = name
    sweeps[name] = sweep
    return name
