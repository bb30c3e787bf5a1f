#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that a driver of sweeps runs all cases, also after it was killed, to the same bytes as the pool.

    tests/sweeps/check_drivers.py TALUS parallel|snakemake|dask

Skipped where the program or library is not installed.
Exit codes: 0 all is well or skipped, 1 it is not.
"""
import contextlib
import importlib.util
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from small_sweep import SWEEP, call, expanded, gathered, local_run, skip

PATIENCE = 300  # s
SHORT = SWEEP.replace("seeds = 3", "seeds = 2")


def command_of(driver, path):
    drivers = path / "drivers"
    return {"parallel": [drivers / "parallel.sh", "2"],
            "snakemake": ["snakemake", "-s", drivers / "Snakefile", "-d", drivers, "--cores", "2", "--quiet", "all", "--rerun-incomplete"],
            "dask": ["/usr/bin/python3", drivers / "dask_cases.py"]}[driver]


def kill_in_the_middle(command, path):
    """Starts the driver, and kills it with all that it started as soon as a case is over."""
    process = subprocess.Popen(command, start_new_session=True, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    end = time.monotonic() + PATIENCE
    while not any(path.glob("cases/*/summary.json")) and process.poll() is None and time.monotonic() < end:
        time.sleep(0.05)
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def main():
    talus, driver = Path(sys.argv[1]).resolve(), sys.argv[2]
    if driver == "dask" and not importlib.util.find_spec("distributed"):
        skip("there is no python3-distributed")
    if driver != "dask" and not shutil.which(driver):
        skip(f"there is no {driver}")
    with tempfile.TemporaryDirectory() as name:
        wanted = local_run(talus, name, SHORT)
        path = expanded(talus, name, driver, SHORT)
        command = [str(word) for word in command_of(driver, path)]
        kill_in_the_middle(command, path)
        if driver == "snakemake":
            call(*command[:-3], "--unlock")
        call(*command, timeout=PATIENCE, stdin=subprocess.DEVNULL)
        if driver == "snakemake":
            assert (path / "results.csv").is_file(), "the workflow did not gather"
        assert gathered(talus, path) == wanted, f"by {driver} the results have other bytes"


if __name__ == "__main__":
    main()
