#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether results of supplied scenes change when their automatic step is halved, and what it costs.

    tests/studies/half_step.py [SCENE…]

Whole runs on one thread, three seeds or more, as many at a time as there are processors, where validation has its runs;
what is there from the same program is not run again. Writes tests/studies/results/half_step.md; scenes that are not
asked for keep what results/half_step.json has of them.

A standard error is that of the mean over the seeds: from their scatter at both steps, or what the sensor gives of
itself where that is more. Exit codes: 0 each result of these scenes changes by less than two standard errors of a
difference, and two of its own are within their limit; 1 one does not, or a run failed.
"""
import concurrent.futures
import json
import math
import os
import statistics
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path[:0] = [str(ROOT / folder) for folder in ("tests/validation", "tests/support", "postprocess")]
from case import SEEDS, Simulation  # noqa: E402  found by the line above
from making import RunFailed, make  # noqa: E402
from source import commit, processor  # noqa: E402

STORE = HERE / "results/half_step.json"
STEPS = (1.0, 0.5)
MORE_SEEDS = {"silo": tuple(range(1, 7)), "pile": tuple(range(1, 13))}  # where the results of three scatter too much
# What a scene must be given so that its results are means over long enough.
LONGER = {"vibrated_bed": {"time.duration": 8.5, "sensor.box.to": 8.5}}
# By scene: the results, and how large two standard errors of each may be, in its unit or as a share of it.
RESULTS = {
    "hopper": {("outlet", "mass_flow"): "2 %"},
    "silo": {("outlet", "mass_flow"): "2 %"},
    "pile": {("heap", "angle"): 0.5},
    "drum": {("surface", "angle"): 0.5, ("drive", "torque_y"): "2 %"},
    "vibrated_bed": {("box", "force_z"): "4 %"},
}


def run(scene, seed, step, settings):
    """The summary of a run at this share of the automatic step."""
    name = f"half_step_{scene}_{step:g}_{seed}"
    return make(ROOT / "build/talus", Simulation(name, scene, LONGER.get(scene, {}) | settings, seed)).summary()


def run_at_both(scene, seed):
    """Their summaries, by the share of the automatic step."""
    whole = run(scene, seed, 1.0, {})
    return {1.0: whole, 0.5: run(scene, seed, 0.5, {"time.step": 0.5 * whole["time"]["step"]})}


def compared(runs, sensor, quantity, most):
    """A row of the table by the runs of both steps, and whether the result keeps to it."""
    results = {step: [summary["sensors"][sensor][quantity] for summary in runs[step]] for step in STEPS}
    means = {step: statistics.fmean(r["value"] for r in found) for step, found in results.items()}
    scatter = statistics.fmean(statistics.variance(r["value"] for r in found) for found in results.values())
    own = statistics.fmean(r["spread"] ** 2 for found in results.values() for r in found)
    error = math.sqrt(max(scatter, own) / len(runs[1.0]))
    change = means[0.5] - means[1.0]
    limit = most if isinstance(most, float) else float(most.removesuffix(" %")) / 100 * abs(means[0.5])
    kept = abs(change) < 2 * math.sqrt(2) * error and 2 * error <= limit
    unit = results[1.0][0]["unit"]
    return (f"{sensor}: {quantity} [{unit}] | {means[1.0]:.4g} | {means[0.5]:.4g} | {change:+.2g} | {2 * error:.2g} of "
            f"{limit:.2g} | {'yes' if kept else '**no**'}", kept)


def overlaps(runs):
    """Mean and worst over the seeds, in percent of a diameter."""
    found = [summary["error"]["overlap_d"] for summary in runs]
    return f"{100 * statistics.fmean(o['mean'] for o in found):.2g}, {100 * max(o['worst'] for o in found):.1f}"


def measured(scene, runs):
    """What the page says of a scene."""
    rows = [compared(runs, sensor, quantity, most) for (sensor, quantity), most in RESULTS[scene].items()]
    cpu = [statistics.fmean(summary["timing"]["cpu"] for summary in runs[step]) for step in STEPS]
    split = sum(summary["error"]["sub_steps"]["steps"] for summary in runs[1.0])
    cost = (f"{1e3 * runs[1.0][0]['time']['step']:.4g} | {cpu[0]:.0f} | {cpu[1]:.0f} | {overlaps(runs[1.0])} | "
            f"{overlaps(runs[0.5])} | {split} | {len(runs[1.0])} | {commit()} | {processor()}")
    return {"results": [row for row, _ in rows], "kept": all(kept for _, kept in rows), "cost": cost}


def page(stored):
    lines = ["# Results at the automatic step and at half of it", "",
             "Written by `tests/studies/half_step.py` from whole runs.", "",
             "| scene | result | automatic | half | change | two standard errors, and their limit | within |",
             "| --- | --- | --- | --- | --- | --- | --- |"]
    for scene in RESULTS:
        lines += [f"| {scene} | {row} |" for row in stored.get(scene, {}).get("results", ["not run yet | | | | |"])]
    lines += ["", "A change may be as large as two standard errors of a difference, √2 times that of one mean.", "",
              "| scene | step [ms] | CPU [s] | at half | overlap, mean and worst [% d] | at half | steps split | "
              "seeds | commit | processor |",
              "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"]
    lines += [f"| {scene} | {stored[scene]['cost']} |" for scene in RESULTS if scene in stored]
    return "\n".join(lines) + "\n"


def main():
    scenes = sys.argv[1:] or list(RESULTS)
    unknown = [scene for scene in scenes if scene not in RESULTS]
    if unknown:
        sys.exit(f"{', '.join(unknown)}: not one of {', '.join(RESULTS)}")
    stored = json.loads(STORE.read_text()) if STORE.is_file() else {}
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        pending = {scene: [pool.submit(run_at_both, scene, seed) for seed in MORE_SEEDS.get(scene, SEEDS)]
                   for scene in scenes}
        for scene in scenes:
            try:
                found = [job.result() for job in pending[scene]]
            except RunFailed as error:
                pool.shutdown(cancel_futures=True)
                sys.exit(str(error))
            stored[scene] = measured(scene, {step: [of[step] for of in found] for step in STEPS})
            STORE.write_text(json.dumps(stored, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
            STORE.with_suffix(".md").write_text(page(stored), encoding="utf-8")
    print(page(stored))
    return 0 if all(stored[scene]["kept"] for scene in scenes) else 1


if __name__ == "__main__":
    sys.exit(main())
