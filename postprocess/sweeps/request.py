# SPDX-License-Identifier: GPL-3.0-or-later
"""What a sweep file asks for."""
import math
import re
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

from read_run import RunError

MOST = 100_000  # cases of a sweep
KINDS = ("grid", "list", "latin-hypercube", "sobol")


@dataclass(frozen=True)
class Range:
    """Numbers between two ends, both included."""
    low: float
    high: float
    steps: int | None = None
    log: bool = False
    whole: bool = False

    def at(self, share, digits):
        """The value at a share from 0 to 1 of the range, with so many digits."""
        value = self.low * (self.high / self.low) ** share if self.log else self.low + share * (self.high - self.low)
        return round(value) if self.whole else float(f"{value:.{digits}g}")

    def values(self):
        return [self.at(k / max(1, self.steps - 1), 10) for k in range(self.steps)]


@dataclass
class Sweep:
    """A scene, and what of it changes from case to case."""
    name: str
    scene: str  # a path, or the name of one that comes with Talus
    vary: dict  # of a key: a list of values, or a Range
    title: str = ""
    fixed: dict = field(default_factory=dict)  # the value of a key in every case
    kind: str = "grid"
    samples: int = 0
    design_seed: int = 1
    seeds: list = field(default_factory=list)  # of the runs; empty: the scene's own
    threads: int = 1
    reports: bool = True


class Table:
    """A table of a TOML file, of which every key must be asked for."""

    def __init__(self, path, name, values, known):
        self.path, self.name, self.values = path, name, values
        if not isinstance(values, dict):
            self.refuse(f"{self.name} must be a table")
        for key in values:
            if key not in known:
                where = f" in [{name}]" if name else ""
                self.refuse(f"unknown key '{key}'{where}; allowed are {', '.join(known)}")

    def refuse(self, sentence):
        """Raises RunError with a sentence, after the line of what it names first, where only one line can be meant."""
        named = re.search(r"'([\w.-]+)'", sentence)
        lines = lines_of(self.path, named[1].rsplit(".", 1)[-1]) if named else []
        raise RunError(f"{self.path}{f':{lines[0]}' if len(lines) == 1 else ''}: {sentence}.")

    def called(self, key):
        return f"{self.name}.{key}" if self.name else key

    def get(self, key, kind, default=None, allowed="", good=lambda value: True):
        """The value of a key, which has no default where that is None."""
        value = self.values.get(key, default)
        if value is None:
            self.refuse(f"'{self.called(key)}' is missing{f'; it is {allowed}' if allowed else ''}")
        if kind is float and isinstance(value, int) and not isinstance(value, bool):
            value = float(value)
        if not isinstance(value, kind) or (isinstance(value, bool) and kind is not bool) or not good(value):
            self.refuse(f"'{self.called(key)}' must be {allowed or kind.__name__}, not {value!r}")
        return value


def lines_of(path, key):
    """The numbers of the lines in which a key of a TOML file is set, or a table of that name begins."""
    pattern = re.compile(rf"""\s*(\[+\s*)?([\w"'-]+\s*\.\s*)*["']?{re.escape(key)}["']?\s*[=\]]""")
    return [number for number, line in enumerate(Path(path).read_text(encoding="utf-8").split("\n"), 1) if pattern.match(line)]


def read_toml(path):
    try:
        return tomllib.loads(Path(path).read_text(encoding="utf-8"))
    except FileNotFoundError as error:
        raise RunError(f"{path}: there is no such file.") from error
    except (OSError, UnicodeDecodeError) as error:
        raise RunError(f"{path}: cannot be read: {error}.") from error
    except tomllib.TOMLDecodeError as error:
        raise RunError(f"{path}: is no TOML: {error}.") from error


def leaves(values, is_leaf, key=""):
    """The keys of nested tables down to their leaves, as --set takes them: contact.glass-glass.friction."""
    for name, value in values.items():
        whole = f"{key}.{name}" if key else name
        if isinstance(value, dict) and not is_leaf(value):
            yield from leaves(value, is_leaf, whole)
        else:
            yield whole, value


def read_range(table_of, key, value):
    """A Range from { from, to, steps, scale, whole }."""
    table = table_of(key, value, ("from", "to", "steps", "scale", "whole"))
    low, high = (table.get(end, float, allowed="a finite number", good=math.isfinite) for end in ("from", "to"))
    steps = table.get("steps", int, 0, "a whole number from 2 up", lambda n: n >= 2 or "steps" not in value) or None
    log = table.get("scale", str, "linear", "'linear' or 'log'", lambda one: one in ("linear", "log")) == "log"
    if not low < high:
        table.refuse(f"'{key}' must go from a smaller number to a larger one, not from {low:g} to {high:g}")
    if log and low <= 0:
        table.refuse(f"'{key}' must begin above 0 where its scale is 'log'")
    return Range(low, high, steps, log, table.get("whole", bool, False))


def scene_of(path, name):
    """A scene as a file names it: from the file's own folder, or one that comes with Talus."""
    beside = path.parent / name
    return str(beside) if beside.is_file() else name


def read_seeds(table):
    seeds = table.values.get("seeds", [])
    if isinstance(seeds, int) and not isinstance(seeds, bool) and 0 < seeds <= MOST:
        seeds = list(range(1, seeds + 1))
    if not isinstance(seeds, list) or not all(isinstance(one, int) and not isinstance(one, bool) and one >= 0 for one in seeds) or len(set(seeds)) < len(seeds):
        table.refuse(f"'seeds' must be how many, up to {MOST}, or a list of different whole numbers from 0 up")
    return seeds


def read_fixed(values):
    return dict(leaves(values, lambda value: False))


def read_sweep(path):
    """The sweep of a file. Raises RunError with what is wrong and what is allowed."""
    path = Path(path)
    table = Table(path, "", read_toml(path), ("scene", "title", "seeds", "threads", "reports", "set", "vary", "design"))
    design = Table(path, "design", table.get("design", dict, {}), ("kind", "samples", "seed"))
    kind = design.get("kind", str, "grid", "one of " + ", ".join(KINDS), lambda one: one in KINDS)
    sampled = kind in ("latin-hypercube", "sobol")
    vary = {}
    for key, value in leaves(table.get("vary", dict, {}), lambda value: "from" in value or "to" in value):
        if isinstance(value, dict):
            vary[key] = read_range(lambda *words: Table(path, *words), key, value)
            if kind == "list":
                table.refuse(f"'{key}' must be a list of values, as the design is a list")
            if kind == "grid" and vary[key].steps is None:
                table.refuse(f"'{key}' needs 'steps', as the design is a grid; 'latin-hypercube' and 'sobol' do without")
            if sampled and vary[key].steps is not None:
                table.refuse(f"'{key}' has 'steps', but the design '{kind}' chooses its values; give a list of values to have each")
        elif isinstance(value, list) and value:
            vary[key] = value
        else:
            table.refuse(f"'{key}' must be a list of values or a range {{ from = …, to = … }}, not {value!r}")
    seeds = read_seeds(table)
    if not vary and not seeds:
        table.refuse("nothing varies: give keys in [vary], or 'seeds'")
    if "seed" in vary:
        table.refuse("'seed' is not for [vary]; 'seeds' is for that, at the top of the file")
    if kind == "list" and len({len(values) for values in vary.values()}) > 1:
        table.refuse("the lists of [vary] must be equally long, as the design is a list: "
                     + ", ".join(f"'{key}' has {len(values)}" for key, values in vary.items()))
    if sampled and not any(isinstance(value, Range) for value in vary.values()):
        table.refuse(f"the design '{kind}' needs a key with a range {{ from = …, to = … }}")
    fixed = read_fixed(table.get("set", dict, {}))
    if both := set(fixed) & set(vary):
        table.refuse(f"'{sorted(both)[0]}' is in [set] and in [vary]")
    positive = {"allowed": "a whole number from 1 up", "good": lambda n: n >= 1}
    return Sweep(name=path.stem, scene=scene_of(path, table.get("scene", str, allowed="a scene file, or the name of a scene")),
                 title=table.get("title", str, ""), fixed=fixed, vary=vary, kind=kind, seeds=seeds,
                 samples=design.get("samples", int, **positive) if sampled else 0,
                 design_seed=design.get("seed", int, 1, "a whole number from 0 up", lambda n: n >= 0),
                 threads=table.get("threads", int, 1, **positive), reports=table.get("reports", bool, True))
