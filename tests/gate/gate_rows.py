# SPDX-License-Identifier: GPL-3.0-or-later
"""Rows of what the gate's jobs found."""
import re

from beds import FLOWS
from bulk import BULKS
from jobs import LAWS, MORE_SEEDS, SEEDS, Bed, hard_cases
from verdicts import Row, at_most, within

# Of test_quietness.cpp, a small settled box: overlap [d], creep [d/s], kinetic energy [m g d].
BOX = {"matched": {"overlap": 5e-4, "creep": 1e-4, "kinetic": 1e-8},
       "projected": {"overlap": 1e-5, "creep": 5e-4, "kinetic": 1e-8}}
UNITS = {"overlap": "mean overlap [d]", "creep": "creep [d/s]", "kinetic": "kinetic energy without rattlers [m g d]"}
# What the automatic step keeps to (METHOD, the length of the step), and what may lie deepest where something lands [d].
OVERLAP, LANDING = 2e-3, 0.1
# Of beds without a criterion of their own: goal and must, of what was before; fine at up to this much.
REST = {"creep": (1.5, 2, 1e-5), "kinetic": (1.5, 2, 1e-9)}
LIMIT = re.compile(r"(.*?)(?: ((?:<|>) \S+|in \S+ … \S+))?")  # what a hard case asks of a quantity, at the end


def below(scene, what, values, limit, **others):
    return within(scene, what, values, 0, limit, f"at most {limit:g}", **others)


def flow_rows(found):
    for scene in FLOWS:
        beds = [found[Bed("flow", scene, "matched", seed).name] for seed in SEEDS]
        yield below(f"flow, {scene}", "mean overlap [d]", [bed["overlap"] for bed in beds], OVERLAP)
        yield below(f"flow, {scene}", "worst overlap [d]", [bed["worst"] for bed in beds], LANDING)
        yield below(f"flow, {scene}", "steps split", [bed["split"] for bed in beds], 0)
        # As named while the step was always the usual one.
        yield at_most(f"flow, {scene}", "sweeps", [bed["sweeps"] for bed in beds], 1, 1.2)


def rest_rows(found):
    for law in LAWS:
        beds = [found[Bed("rest", "box", law, seed).name] for seed in MORE_SEEDS]
        for quantity, limit in BOX[law].items():
            yield within(f"at rest, box of 700, {law}", UNITS[quantity], [bed[quantity] for bed in beds], 0, limit,
                         f"below {limit:g}", of_median=True)
    others = [("pile of 1200", "pile", "matched", MORE_SEEDS)]
    others += [(f"column of {count}", f"column_{count}", law, (1,)) for count in (20, 100) for law in LAWS]
    for title, scene, law, seeds in others:
        beds = [found[Bed("rest", scene, law, seed).name] for seed in seeds]
        yield below(f"at rest, {title}, {law}", UNITS["overlap"], [bed["overlap"] for bed in beds], OVERLAP, of_median=True)
        for quantity, (goal, must, floor) in REST.items():
            yield at_most(f"at rest, {title}, {law}", UNITS[quantity], [bed[quantity] for bed in beds], goal, must, floor,
                          of_median=True)


def hard_rows(name, found):
    for _, criterion, measured, verdict, _ in found[f"hard case {name}"]:
        if verdict != "told":
            what, limit = LIMIT.fullmatch(criterion).groups()
            yield Row(name, what, (), limit or "", passed=verdict == "ok", text=measured)


def all_rows(build, found):
    """Of those whose jobs have all been run, and what is missing; found has what jobs found by their names."""
    makers = {**{f"hard case {name}": lambda name=name: hard_rows(name, found) for name in hard_cases(build)},
              "flows": lambda: flow_rows(found), "beds at rest": lambda: rest_rows(found),
              **{bulk.name: lambda bulk=bulk: bulk.rows(found) for bulk in BULKS}}
    rows, missing = [], []
    for what, make in makers.items():
        try:
            rows += list(make())
        except KeyError as missed:
            missing.append(f"{what} ({missed.args[0]})")
    return rows, missing
