# SPDX-License-Identifier: GPL-3.0-or-later
"""What a study of a scene runs: the keys of a study file, and every setting that they ask for."""
import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from read_run import RunError
from sweeps.request import Table, read_toml
from sweeps.setting_text import inner_text

REFERENCE, DEFAULT = "reference", "default"
STEP = "time.step"


def is_number(value):
    return isinstance(value, (int, float)) and math.isfinite(value)


def is_texts(value):
    return isinstance(value, list) and all(isinstance(one, str) for one in value)


@dataclass(frozen=True)
class Key:
    """A key of a study file: what it may be, what it is where it is left out (None: it is required), and what it means."""
    name: str
    allowed: str
    good: Callable[[Any], bool]
    default: Any
    meaning: str

    def told(self):
        """As `talus keys` tells of it."""
        default = "required" if self.default is None else f"default {inner_text(self.default)}" if self.default else "may be left out"
        return f"  {self.name:<22} {self.allowed}; {default}\n" + (f"  {'':<22} {self.meaning}\n" if self.meaning else "")


TEXTS = ("an array of strings", is_texts)
VARIED = (
    Key("key", "a string", lambda one: isinstance(one, str), None, 'of the scene, as for --set: "solver.tolerance"'),
    Key("values", *TEXTS, None, 'one after the other, as for --set; "x0.5" is half of what the scene has, for the time step'),
)
KEYS = (
    Key("start", "a number of at least 0 [s], or 'auto'", lambda one: one == "auto" or is_number(one) and one >= 0, "auto",
        "all settings go on from the state that the scene has then; auto: when its first sensor begins to look, else half of its duration"),
    Key("end", "a number above 0 [s], or 'auto'", lambda one: one == "auto" or is_number(one) and one > 0, "auto", "of what is measured; auto: the scene's duration"),
    Key("settle", "a number of at least 0 [s]", lambda one: is_number(one) and one >= 0, 0.2,
        "after the start, before anything is measured: a setting with stiffer contacts first pushes out what overlap the state has, a softer one sinks in"),
    Key("seeds", "a whole number of at least 1 and at most 1000", lambda one: isinstance(one, int) and 1 <= one <= 1000, 1,
        "of the scene, each with a state of its own to start from"),
    Key("longest", "a number above 0 [s]", lambda one: is_number(one) and one > 0, 1800.0, "CPU time after which one setting is given up"),
    Key("set", *TEXTS, [], "changes of the scene for all settings, as for --set: a smaller bed, say"),
    Key("cross", *TEXTS, ["solver.stabilisation"],
        'keys of which every value is tried with every value of the others, which are varied one at a time; "all": a grid'),
    Key("reference", *TEXTS, ["solver.stabilisation=matched", "solver.tolerance=reference", "solver.min_sweeps=10", "solver.max_sweeps=2000", "time.step=x0.2"],
        "the settings that errors are measured against, as for --set"),
)
VARY = [{"key": key, "values": values} for key, values in (
    ("solver.stabilisation", ["matched", "projected"]), ("accuracy", ["10%", "1%"]), (STEP, ["x0.5", "x2", "x4"]), ("solver.min_sweeps", ["1", "4", "10"]),
    ("solver.tolerance", ["draft", "fine"]), ("solver.relaxation", ["1", "1.5"]), ("solver.pressure_scaling", ["true", "false"]))]


def keys_told():
    """The table of keys: `talus keys study`."""
    return ("study\n" + "".join(key.told() for key in KEYS) + f"  {'vary':<22} a list of tables; may be left out\n\nstudy.vary\n"
            + "".join(key.told() for key in VARIED))


def read_keys(table, keys):
    return {key.name: table.get(key.name, object, key.default, key.allowed, key.good) for key in keys}


def read_study(path=None):
    """The values of all keys in a file, or without one. Raises RunError with what is wrong and what is allowed."""
    path = Path(path or "")
    table = Table(path, "", read_toml(path) if path.name else {}, [key.name for key in KEYS] + ["vary"])
    vary = table.get("vary", list, VARY, "a list of tables")
    return {**read_keys(table, KEYS), "vary": [read_keys(Table(path, "vary", one, [key.name for key in VARIED]), VARIED) for one in vary]}


def resolved_study(study):
    """The whole study as TOML, with every key."""
    return "".join(f"{key} = {inner_text(value)}\n" for key, value in study.items())


class Setting(NamedTuple):
    """One way to run a scene."""
    name: str  # "projected, tolerance=fine"
    overrides: list  # as for --set


def in_seconds(value, time_step):
    """"x0.5" of a time step as a number of seconds."""
    try:
        factor = float(value[1:])
    except ValueError:
        factor = 0.0
    if not factor > 0:
        raise RunError(f"'{value}' is not x and a number above 0, as in x0.5")
    return repr(factor * time_step)


def setting_of(choices, time_step):
    """The setting with these pairs of key and value; in its name the last word of each key, of the stabilisation the value."""
    names = [value if key == "solver.stabilisation" else f"{key.rsplit('.', 1)[-1]}={value}" for key, value in choices]
    overrides = [f"{key}={in_seconds(value, time_step) if key == STEP and value.startswith('x') else value}" for key, value in choices]
    return Setting(", ".join(names) or DEFAULT, overrides)


def reference_of(study, time_step):
    choices = []
    for text in study["reference"]:
        key, equals, value = text.partition("=")
        if not equals:
            raise RunError(f"the reference's '{text}' is not key=value")
        choices.append((key, value))
    return setting_of(choices, time_step)._replace(name=REFERENCE)


def settings_of(study, time_step):
    """Every setting that a study tries: first the one that errors are measured against, then the scene's own; then each
    value of each key, one at a time, with every combination of the values of the crossed keys.

    time_step: of the scene's own setting [s], for values that are times it
    """
    def crossed_with(combinations, varied):
        return [[*choices, (varied["key"], value)] for choices in combinations for value in varied["values"]]

    def is_crossed(varied):
        return "all" in study["cross"] or varied["key"] in study["cross"]

    combinations = [[]]
    for varied in filter(is_crossed, study["vary"]):
        combinations = crossed_with(combinations, varied)
    single = [choices for varied in study["vary"] if not is_crossed(varied) for choices in crossed_with(combinations, varied)]
    tried = [setting_of(choices, time_step) for choices in combinations + single if choices]
    return [reference_of(study, time_step), setting_of([], time_step), *tried]
