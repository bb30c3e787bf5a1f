# SPDX-License-Identifier: GPL-3.0-or-later
"""What the validation page is made of: a case has runs, rows that put what they found beside references, a figure."""
import math
import statistics
from pathlib import Path
from typing import NamedTuple

SEEDS = (1, 2, 3)


class Simulation(NamedTuple):
    """A run of a scene."""
    name: str  # of its folder; cases that give the same one share the run
    scene: str  # a name of scenarios/ or of tests/validation/scenes/
    settings: dict[str, object] = {}  # as of --set, or variables of a deck
    seed: int = 1
    program: str = ""  # "lammps" or "liggghts" runs the scene as a deck of theirs, or their own; otherwise Talus does …
    modulus: str = ""  # … with this Young's modulus [Pa], or that which the deck has


def mean_and_error(values):
    """The mean and its standard error; 0 of one value, where chance has no part."""
    count = len(values)
    return statistics.fmean(values), statistics.stdev(values) / math.sqrt(count) if count > 1 else 0.0


class Row(NamedTuple):
    """A quantity with what others have for it; within its tolerance where the mean over the seeds is in [low, high]."""
    what: str
    reference: str  # with its source
    tolerance: str  # [low, high], as the page says it
    low: float
    high: float
    values: tuple[float, ...]  # one for each seed; where chance has no part, one

    @property
    def mean(self):
        return mean_and_error(self.values)[0]

    @property
    def standard_error(self):
        return mean_and_error(self.values)[1]

    @property
    def within(self):
        """None where the row has no tolerance."""
        return self.low <= self.mean <= self.high if self.tolerance else None


def told(what, values, reference=""):
    """A row for information, which has no tolerance."""
    return Row(what, reference, "", -math.inf, math.inf, tuple(map(float, values)))


def scene_file(scene):
    """The path of a scene or deck of tests/validation/scenes/, or the name of a supplied scene."""
    path = Path(__file__).parent / "scenes" / (scene if "." in scene else f"{scene}.toml")
    return str(path) if path.is_file() else scene


def over_seeds(name, scene, settings=None, seeds=SEEDS, program="", modulus=""):
    """The same scene once with each seed, named NAME_SEED."""
    return [Simulation(f"{name}_{seed}", scene, settings or {}, seed, program, modulus) for seed in seeds]
