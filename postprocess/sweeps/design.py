# SPDX-License-Identifier: GPL-3.0-or-later
"""Which cases a sweep has."""
import itertools
import math
import warnings

from read_run import RunError
from sweeps.request import MOST, Range


def cases_of(sweep):
    """The settings of each case, in order: key and value. Every setting comes with every seed.

    Raises RunError where they are too many.
    """
    if (count := count_of(sweep)) > MOST:
        raise RunError(f"{sweep.name}: the sweep has {count} cases; {MOST} are allowed.")
    cases = []
    for point in points_of(sweep):
        for seed in sweep.seeds or [None]:
            cases.append({**sweep.fixed, **point, **({} if seed is None else {"seed": seed})})
    return cases


def count_of(sweep):
    sizes = [one.steps or 1 if isinstance(one, Range) else len(one) for one in sweep.vary.values()]
    points = max(sizes, default=1) if sweep.kind == "list" else math.prod(sizes) * (sweep.samples or 1)
    return points * max(1, len(sweep.seeds))


def points_of(sweep):
    """The points of the design: what [vary] says, without seeds."""
    if sweep.kind == "list":
        return [dict(zip(sweep.vary, values)) for values in zip(*sweep.vary.values())]
    ranges = {key: one for key, one in sweep.vary.items() if isinstance(one, Range)}
    lists = {key: one for key, one in sweep.vary.items() if not isinstance(one, Range)}
    if sweep.kind == "grid":
        return [dict(zip(sweep.vary, values)) for values in
                itertools.product(*(one.values() if isinstance(one, Range) else one for one in sweep.vary.values()))]
    shares = unit_points(sweep.kind, len(ranges), sweep.samples, sweep.design_seed)
    points = []
    for row in shares:
        sampled = {key: one.at(share, 6) for (key, one), share in zip(ranges.items(), row)}
        for values in itertools.product(*lists.values()):
            chosen = {**sampled, **dict(zip(lists, values))}
            points.append({key: chosen[key] for key in sweep.vary})
    return points


def unit_points(kind, dimensions, count, seed):
    """Points in the unit cube, a row each. More points of a Sobol sequence begin with the fewer."""
    try:
        from scipy.stats import qmc
    except ImportError as error:
        raise RunError(f"The design '{kind}' needs SciPy: apt install python3-scipy.") from error
    sampler = (qmc.Sobol if kind == "sobol" else qmc.LatinHypercube)(dimensions, seed=seed)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # that so many are no power of two
        return sampler.random(count)
