# SPDX-License-Identifier: GPL-3.0-or-later
"""Rows of the gate, and what is said of them: beside a criterion of their own, or beside what was before."""
import math
import statistics
from typing import NamedTuple


class Row(NamedTuple):
    """A quantity of a scene. What it is held against is one of these:

    low and high, where a case has a criterion of its own; goal and must, factors by which it may exceed what was before,
    fine at up to `floor` whatever was before; or neither: then it is what was before, within the scatter.
    """
    scene: str
    what: str
    values: tuple[float, ...]  # one for each seed
    criterion: str
    low: float = -math.inf
    high: float = math.inf
    goal: float = 0.0
    must: float = 0.0
    floor: float = 0.0
    of_median: bool = False  # of the seeds, where some are a thousand times as much as others; else their mean
    passed: bool | None = None  # where a hard case has judged it itself
    text: str = ""  # as that has it

    @property
    def key(self):
        return f"{self.scene}: {self.what}"

    @property
    def value(self):
        return statistics.median(self.values) if self.of_median else statistics.fmean(self.values)

    @property
    def error(self):
        """Standard error of the mean; 0 of one value, where chance has no part."""
        count = len(self.values)
        return statistics.stdev(self.values) / math.sqrt(count) if count > 1 else 0.0


def within(scene, what, values, low, high, criterion, **others):
    return Row(scene, what, tuple(map(float, values)), criterion, low, high, **others)


def same(scene, what, values):
    return Row(scene, what, tuple(map(float, values)), "as before, ± 3 errors or 2 %")


def at_most(scene, what, values, goal, must, floor=0.0, **others):
    criterion = f"at most {goal:g}, must {must:g} × before" + (f", or {floor:g}" if floor else "")
    return Row(scene, what, tuple(map(float, values)), criterion, goal=goal, must=must, floor=floor, **others)


def from_case(scene, row):
    """A row of a validation case: by its own tolerance, or, where it has none, beside what was before."""
    if not row.tolerance:
        return same(scene, row.what, row.values)
    return within(scene, row.what, row.values, row.low, row.high, row.tolerance)


def moved(now, before):
    """Whether it differs by more than three standard errors of the difference, and by more than 2 %."""
    scatter = max(3 * math.hypot(now.error, before.error), 0.02 * abs(before.value))
    return not abs(now.value - before.value) <= scatter


def holds(row):
    """By its own criterion; None where it has none."""
    if row.passed is not None:
        return row.passed
    if row.low == -math.inf and row.high == math.inf:
        return None
    return row.low <= row.value <= row.high


def verdict(now, before):
    """Of a row beside the same row before, which may be missing."""
    own = holds(now)
    if own is not None:
        other = before is not None and now.passed is None and moved(now, before)
        if own:
            return "ok; moved" if other else "ok"
        as_before = before is not None and holds(before) is False
        return "fails" + (", as before" if as_before else "") + ("; moved" if as_before and other else "")
    if before is None:
        return "new"
    if not now.must:
        return "fails" if moved(now, before) else "ok"
    if now.value <= max(now.goal * before.value, now.floor):
        return "ok"
    return "above the goal" if now.value <= now.must * before.value else "fails"
