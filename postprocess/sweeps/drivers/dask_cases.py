#!/usr/bin/python3
"""Runs the cases of this sweep with Dask (Debian: python3-distributed).

    dask_cases.py                                on this machine, a case a core
    dask_cases.py tcp://scheduler:8786           on the workers of a scheduler that see this folder
"""
import subprocess
import sys

from dask.distributed import Client, as_completed

TALUS, FOLDER, CASES = @TALUS_WORD@, @FOLDER_WORD@, @CASES@


def run(case):
    """The exit code of the program: 0 where the case has its result."""
    return subprocess.run([TALUS, "run", FOLDER, "--case", str(case), "--quiet"], check=False).returncode


def main():
    with Client(*sys.argv[1:2]) if sys.argv[1:] else Client(threads_per_worker=1) as client:
        ends = [future.result() for future in as_completed(client.map(run, range(1, CASES + 1), pure=False))]
    print(f"{ends.count(0)} of {CASES} cases have their results")
    sys.exit(max(ends))


if __name__ == "__main__":
    main()
