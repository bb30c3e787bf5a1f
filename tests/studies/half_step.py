#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether results of supplied scenes change when their automatic step is halved, and what it costs.

    tests/studies/half_step.py [SCENE…]

Whole runs on one thread, three seeds or more, as many at a time as there are processors, where validation has its runs;
what is there from the same program is not run again. Writes tests/studies/results/half_step.md when all scenes are
there.

A standard error is that of the mean over the seeds: from their scatter at both steps, or what the sensor gives of
itself where that is more. Exit codes: 0 each result changes by less than two standard errors of a difference, and two
of its own are within their limit; 1 one does not, or a run failed.
"""
import concurrent.futures
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

STEPS = (1.0, 0.5)
MORE_SEEDS = {"pile": tuple(range(1, 13))}  # where the results of three scatter too much
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


def page(found, scenes):
    """The page, and whether all is kept."""
    changes, costs, kept = [], [], True
    for scene in scenes:
        for (sensor, quantity), most in RESULTS[scene].items():
            row, good = compared(found[scene], sensor, quantity, most)
            changes.append(f"| {scene} | {row} |")
            kept = kept and good
        whole, half = found[scene][1.0], found[scene][0.5]
        cpu = [statistics.fmean(summary["timing"]["cpu"] for summary in runs) for runs in (whole, half)]
        step = whole[0]["time"]["step"]
        split = sum(summary["error"]["sub_steps"]["steps"] for summary in whole)
        costs.append(f"| {scene} | {1e3 * step:.4g} | {cpu[0]:.0f} | {cpu[1]:.0f} | {overlaps(whole)} | "
                     f"{overlaps(half)} | {split} |")
    text = ("# Results at the automatic step and at half of it\n\nWritten by `tests/studies/half_step.py` at "
            f"{commit()} on {processor()}: whole runs of three seeds, of the pile of twelve.\n\n"
            "| scene | result | automatic | half | change | two standard errors, and their limit | within |\n"
            "| --- | --- | --- | --- | --- | --- | --- |\n"
            + "\n".join(changes) + "\n\nA change may be as large as two standard errors of a difference, √2 times that "
            "of one mean.\n\n"
            "| scene | step [ms] | CPU [s] | at half | overlap, mean and worst [% d] | at half | steps split |\n"
            "| --- | --- | --- | --- | --- | --- | --- |\n" + "\n".join(costs) + "\n")
    return text, kept


def main():
    scenes = sys.argv[1:] or list(RESULTS)
    unknown = [scene for scene in scenes if scene not in RESULTS]
    if unknown:
        sys.exit(f"{', '.join(unknown)}: not one of {', '.join(RESULTS)}")
    jobs = [(scene, seed) for scene in scenes for seed in MORE_SEEDS.get(scene, SEEDS)]
    try:
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            summaries = list(pool.map(lambda job: run_at_both(*job), jobs))
    except RunFailed as error:
        sys.exit(str(error))
    found = {scene: {step: [of[step] for job, of in zip(jobs, summaries) if job[0] == scene] for step in STEPS}
             for scene in scenes}
    text, kept = page(found, scenes)
    print(text)
    if scenes == list(RESULTS):
        (HERE / "results/half_step.md").write_text(text, encoding="utf-8")
    return 0 if kept else 1


if __name__ == "__main__":
    sys.exit(main())
