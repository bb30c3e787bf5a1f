# SPDX-License-Identifier: GPL-3.0-or-later
"""What a study found: the errors of all settings against the reference, their cost, and what that advises."""
import math
from dataclasses import dataclass, field

from studies.request import REFERENCE
from studies.statistics import MeanAndError

SURE = 1.96  # standard errors
SENSOR_TARGET = 0.01
NOTABLY_CHEAPER = 0.95  # CPU times scatter by some per cent
STANDS_OUT = 5.0  # standard errors
MOST_NAMES = 6  # in one sentence


@dataclass(frozen=True)
class Kind:
    """A kind of error, and what it is reported in."""
    name: str
    unit: str  # "1" where it is relative
    meaning: str
    of_sensor: bool = False
    advised: bool = False  # worth a sentence


OWN = (  # what a run tells of itself
    Kind("velocity_error", "sqrt(g d)", "velocities after one step, against the same step solved to the end; mean of three", advised=True),
    Kind("residual", "1", "relative residual of the steps, mean"),
    Kind("residual_95", "1", "95 % of the steps have less"),
    Kind("steps_at_cap", "1", "share of the steps that stopped at the cap of sweeps"),
    Kind("overlap", "d", "mean over the loaded contacts that overlap"),
    Kind("overlap_95", "d", "95 % of them have less", advised=True),
    Kind("worst_overlap", "d", "at any look"),
    Kind("energy_gained", "M g d/s", "rises of the energy that nothing put in"),
    Kind("momentum_error", "M g h", "worst step: gain of momentum less gravity and walls"),
)
SHARED = (  # what a run should share with the reference
    Kind("height", "d", "of the packing (twice that of the centre of mass), against the reference"),
    Kind("creep", "d/s", "median way of the spheres by the time, against the reference", advised=True),
    Kind("restlessness", "m g d", "kinetic energy of a sphere without the liveliest 2 %, against the reference"),
    Kind("support_swing", "M g", "rms swing of the force by walls, against the reference"),
)
PROFILE = Kind("force_profile", "M g", "mean force by walls and through level cuts, the worst of them, against the reference", advised=True)
OWN_NAMES = {kind.name for kind in OWN}


@dataclass(frozen=True)
class Error:
    """An error over all seeds, and its standard error."""
    value: float
    spread: float = 0.0


@dataclass
class Point:
    """A setting as the study found it."""
    setting: str
    status: str = "done"  # or why it failed, for the last seed where it did
    cpu: float = 0.0  # mean over the seeds and equal settings, for a simulated second [s]
    equal_settings: int = 1  # that came to the same bits, this one among them
    updates: float = 0.0  # of contacts, mean over the seeds, for a simulated second
    memory: float = 0.0  # the most [B]
    errors: list = field(default_factory=list)  # by kind; empty where it failed

    def is_done(self):
        return self.status == "done"


@dataclass
class Result:
    """kinds; points: the reference first, then the default (the scene as it is), then the others as they were asked for."""
    kinds: list
    points: list

    def standard(self):
        return self.points[1]


def kinds_of(reference):
    kinds = [*OWN, *SHARED, PROFILE]
    known = {kind.name for kind in kinds}
    for m in reference["findings"]:
        if m["name"] not in known:
            meaning = f"of the sensor, as a share of the reference's {m['value']:.4g} {m['unit']}"
            kinds.append(Kind(m["name"], "1", meaning, of_sensor=True, advised=abs(m["value"]) > STANDS_OUT * m["spread"]))
    return kinds


def found(row, name):
    return next((m for m in row["findings"] if m["name"] == name), None)


def error_in(row, reference, kind):
    """The signed error of a kind in one row; not a number where it cannot be reported."""
    if kind is PROFILE:
        return Error(max((abs(one - other) for one, other in zip(row["profile"], reference["profile"])), default=0.0))
    m, r = found(row, kind.name), found(reference, kind.name)
    if m is None or (r is None and kind.name not in OWN_NAMES):
        return Error(math.nan, math.nan)
    known = [one["spread"] if math.isfinite(one["spread"]) else 0.0 for one in (m, r) if one]
    if kind.name in OWN_NAMES:
        return Error(m["value"], known[0])
    unit = abs(r["value"]) if kind.of_sensor else 1.0
    return Error(divided(m["value"] - r["value"], unit), divided(math.hypot(*known), unit))


def divided(value, unit):
    """A share of something that may be 0."""
    return value / unit if unit else math.nan if value == 0 else math.copysign(math.inf, value)


def over_seeds(errors):
    mean, squares = MeanAndError(), 0.0
    for error in errors:
        mean.add(error.value)
        squares += error.spread * error.spread
    scatter = mean.standard_error() if len(errors) > 1 else 0.0
    return Error(abs(mean.mean()), max(math.sqrt(squares) / len(errors), scatter))


def point_of(setting, rows, kinds):
    """A setting over the seeds for which there is a reference; one seed that fails makes it fail."""
    point = Point(setting)
    references = {row["seed"]: row for row in rows if row["setting"] == REFERENCE and row["status"] == "done"}
    own = [row for row in rows if row["setting"] == setting]
    for row in own:
        if row["status"] != "done":
            point.status = row["status"]
    compared = [row for row in own if row["status"] == "done" and row["seed"] in references]
    if not compared and point.is_done():
        point.status = "not run, or without a reference"
    if not point.is_done():
        return point
    point.cpu = sum(row["cpu_s_per_s"] for row in compared) / len(compared)
    point.updates = sum(row["contact_updates_per_s"] for row in compared) / len(compared)
    point.memory = max(row["memory_B"] for row in compared)
    point.errors = [over_seeds([error_in(row, references[row["seed"]], kind) for row in compared]) for kind in kinds]
    return point


def are_the_same_run(rows, one, other):
    """Whether two settings came to the same bits for every seed: then they are one."""
    def values(row):
        return [row["contact_updates_per_s"], *(None if math.isnan(m["value"]) else m["value"] for m in row["findings"])]

    others = {row["seed"]: row for row in rows if row["setting"] == other}
    return all(row["seed"] in others and values(row) == values(others[row["seed"]]) for row in rows if row["setting"] == one)


def compare(settings, rows):
    """Errors of all settings against the reference. What a run tells of itself (residual, overlap, energy that nothing put
    in) is an error as it is. What it should share with the reference is compared with the reference of the same seed:
    by the difference, for a sensor as a share of the reference's value; of the force profile it is the worst cut. Over
    seeds the differences are averaged, so that chance cancels out; the spread is what the scatter over seeds says, or
    the runs' own spreads where that is more.

    settings: their names
    """
    reference = next((row for row in rows if row["setting"] == REFERENCE and row["status"] == "done"), None)
    result = Result(kinds_of(reference) if reference else [], [])
    for setting in settings:
        point = point_of(setting, rows, result.kinds)
        twin = next((earlier for earlier in result.points if point.is_done() and earlier.is_done()
                     and are_the_same_run(rows, point.setting, earlier.setting)), None)
        if twin:
            point.status = f"the same run as {twin.setting}"
            twin.equal_settings += 1
            twin.cpu += (point.cpu - twin.cpu) / twin.equal_settings
        result.points.append(point)
    return result


def front(result, kind):
    """The settings for which no cheaper one has as small an error, from the cheapest to the dearest; by index. The
    reference is not among them: it has no error against itself."""
    def error(i):
        return result.points[i].errors[kind].value

    known = [i for i in range(1, len(result.points)) if result.points[i].is_done() and math.isfinite(error(i))]
    best = []
    for i in sorted(known, key=lambda i: (result.points[i].cpu, error(i))):
        if not best or error(i) < error(best[-1]):
            best.append(i)
    return best


def cheapest(result, is_good):
    """The cheapest setting, but the reference, that the question is true of; None where there is none."""
    good = [point for point in result.points[1:] if point.is_done() and is_good(point)]
    return min(good, key=lambda point: point.cpu, default=None)


def choice(result, best, default_is_good):
    """"use X: 2.1 x faster than the default", or that the default it is.

    default_is_good: the default will do as well
    """
    standard = result.standard()
    ratio = divided(standard.cpu, best.cpu)
    costs_as_much = best is standard or abs(divided(1.0, ratio) - 1.0) < 1.0 - NOTABLY_CHEAPER
    if costs_as_much and default_is_good:
        return "nothing that was tried is notably cheaper than the default"
    if costs_as_much:
        return f"use {best.setting}: it takes as long as the default"
    if ratio >= 1.0:
        return f"use {best.setting}: {ratio:.2g} × faster than the default"
    return f"use {best.setting}: it takes {divided(1.0, ratio):.2g} × as long as the default"


def advice_for_all(result):
    """Nowhere worse: of what a difference is known to, only what is above that counts."""
    standard = result.standard()

    def is_good(point):
        return not any(kind.advised and error.value > had.value + SURE * math.hypot(error.spread, had.spread)
                       for kind, error, had in zip(result.kinds, point.errors, standard.errors))

    return f"To be nowhere worse than the default: {choice(result, cheapest(result, is_good) or standard, True)}."


def advice_for_default(result, k):
    kind, had = result.kinds[k], result.standard().errors[k]
    best = cheapest(result, lambda point: point.errors[k].value <= had.value) or result.standard()
    unit = "" if kind.unit == "1" else f" {kind.unit}"
    return f"For no more {kind.name} than the default's {had.value:.2g}{unit}: {choice(result, best, True)}."


def first_of(names):
    """"one, two, three and 40 more"."""
    return ", ".join(names[:MOST_NAMES]) + (f" and {len(names) - MOST_NAMES} more" if len(names) > MOST_NAMES else "")


def advice_for_sensors(result):
    """What goes for sensors, each choice in one sentence with all the measures that it is right for."""
    choices, unsure = {}, []
    for k, kind in enumerate(result.kinds):
        had = result.standard().errors[k]
        if not kind.of_sensor or not kind.advised or not math.isfinite(had.value):
            continue

        def is_good(point, k=k):
            return point.errors[k].value + SURE * point.errors[k].spread <= SENSOR_TARGET

        best = cheapest(result, is_good)
        if best:
            choices.setdefault(choice(result, best, is_good(result.standard())), []).append(kind.name)
        else:
            unsure.append(f"{kind.name} (the default differs by {100 * had.value:.2g} ± {100 * SURE * had.spread:.2g} %)")
    sentences = [f"For 1 % in {first_of(names)}: {chosen}." for chosen, names in choices.items()]
    if unsure:
        sentences.append(f"No setting is sure to be within 1 % in {first_of(unsure)}; more seeds or a longer time tell more.")
    return sentences


def advice(result):
    """What the result advises: a sentence for each kind of error, with the cheapest setting that keeps what the default
    has; and for sensors the cheapest that is sure (95 %) to be within a per cent, one for all that it is right for."""
    if len(result.points) < 2 or not result.standard().is_done():
        return []
    own = [advice_for_default(result, k) for k, kind in enumerate(result.kinds)
           if kind.advised and not kind.of_sensor and math.isfinite(result.standard().errors[k].value)]
    return [advice_for_all(result), *own, *advice_for_sensors(result)]


def study_csv(result):
    """A line for each setting: costs, each error and its standard error."""
    names = [kind.name.replace(" ", "_") for kind in result.kinds]
    lines = [",".join(["setting,status,cpu_s_per_s,contact_updates_per_s,memory_B", *(f"{name},{name}_spread" for name in names)])]
    for point in result.points:
        errors = "".join(f",{e.value:.6g},{e.spread:.3g}" for e in point.errors) if point.is_done() else ",," * len(names)
        status = point.status.replace('"', "'")
        lines.append(f'"{point.setting}","{status}",{point.cpu:.6g},{point.updates:.6g},{point.memory:.0f}{errors}')
    return "\n".join(lines) + "\n"
