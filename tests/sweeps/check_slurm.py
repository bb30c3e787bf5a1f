#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs a sweep of 64 hoppers as an array of a real Slurm on this machine, kills slurmd in the middle, and compares.

    tests/sweeps/check_slurm.py TALUS [--beads N]

The array's tasks are sent the signal that Slurm sends before their time is up, too: they must write a checkpoint, queue
again and go on. The CSV at the end must have the bytes of that of a run in the local pool.
Skipped where Slurm and munge are not installed, or by others than root.
Exit codes: 0 all is well or skipped, 1 it is not.
"""
import argparse
import sys
import tempfile
import time
from pathlib import Path

from own_slurm import OwnSlurm, missing
from small_sweep import expanded, gathered, local_run, skip

HOPPERS = """
scene = "hopper"
title = "64 hoppers"
seeds = 4
reports = false

[set]
fill.0.count = {beads}
fill.0.region.height = 0.15
wall.gate.remove_at = 0.2
time.duration = 0.9
time.frame_interval = 0.3
checkpoint.interval = 0.1
sensor.outlet.from = 0.3
sensor.outlet.to = 0.45

[vary]
contact.glass-glass.friction = {{ from = 0.1, to = 0.7, steps = 4 }}
contact.glass-steel.friction = {{ from = 0.1, to = 0.4, steps = 4 }}
"""


def settled(path):
    return sum(1 for _ in path.glob("cases/*/summary.json"))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("talus", type=Path)
    parser.add_argument("--beads", type=int, default=120)
    arguments = parser.parse_args()
    talus = arguments.talus.resolve()
    if reason := missing():
        skip(reason)
    text = HOPPERS.format(beads=arguments.beads)
    with tempfile.TemporaryDirectory() as name:
        wanted = local_run(talus, name, text)
        path = expanded(talus, name, "array", text)
        log = path / "drivers/slurm.log"
        with OwnSlurm(Path(name) / "slurm") as slurm:
            began = time.monotonic()
            job = slurm.submit(path / "drivers/slurm.sh")
            slurm.wait_for(lambda: settled(path) >= 4, "the array does not begin")

            def queued_again():
                """Whether a task was. The signal is sent until one was: a case is short, and its script may just begin or end."""
                slurm.ask("scancel", "--signal=USR1", "--batch", job)
                return log.exists() and "goes on after a requeue" in log.read_text()

            slurm.wait_for(queued_again, "no task queues again after the signal")
            requeued = log.read_text().count("goes on after a requeue")

            slurm.wait_for(lambda: settled(path) >= 16, "the array does not go on")
            slurm.kill_slurmd()
            at_kill = settled(path)
            slurm.wait_for(lambda: "down" in slurm.node_state(), "the node is not given up")
            while_down = settled(path)
            slurm.start_slurmd()
            slurm.wait_for(slurm.is_empty, "the array does not end", 1200)
            print(f"{settled(path)} of 64 cases in {time.monotonic() - began:.0f} s; {requeued} tasks queued again after USR1; slurmd killed at {at_kill} cases, "
                  f"{while_down} when the node was given up")
        assert gathered(talus, path) == wanted, "by Slurm the results have other bytes"


if __name__ == "__main__":
    main()
