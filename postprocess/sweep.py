#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the cases of a sweep, and runs them where it is asked to: what `talus sweep` calls.

    postprocess/sweep.py --talus build/talus frictions.toml --jobs 2

Exit codes: 0 done; 2 wrong arguments, a wrong sweep or something missing; 4 a case could not be run, or a file not be
written; 128 + N: signal N stopped it, after checkpoints.
"""
import argparse
import shlex
import shutil
import sys
from pathlib import Path

try:
    import numpy  # noqa: F401  whether it is there
except ImportError:
    print("sweep.py: NumPy is not there: apt install python3-numpy, and use /usr/bin/python3.", file=sys.stderr)
    sys.exit(2)

from read_run import RunError
from sweeps.folder import make_folder
from sweeps.gathering import gather
from sweeps.pool import Stopped, run_all
from sweeps.request import read_sweep


def parse_arguments(prog, what):
    """What sweeps and calibrations are asked with."""
    parser = argparse.ArgumentParser(prog=prog, description=what)
    parser.add_argument("file", metavar="FILE", type=Path, help="what to do, in TOML")
    parser.add_argument("--talus", default="talus", metavar="PROGRAM", help="the program (talus)")
    parser.add_argument("--out", type=Path, metavar="DIR", help="where to (out/NAME)")
    parser.add_argument("--jobs", type=int, default=0, metavar="N", help="run the cases, so many at a time")
    parser.add_argument("--force", action="store_true", help="begin anew where the folder holds another one")
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")
    arguments = parser.parse_args()
    arguments.program = "talus" if shutil.which("talus") else shlex.quote(arguments.talus)
    where = f" --out {shlex.quote(str(arguments.out))}" if arguments.out else ""
    arguments.again = f"{arguments.program} {prog.split()[-1]} {shlex.quote(str(arguments.file))}{where}"
    arguments.out = arguments.out or Path("out") / arguments.file.stem
    return arguments


def tell_ways(folder, arguments):
    """How the cases can be run."""
    drivers = shlex.quote(str(folder.path / "drivers"))
    ways = [("here", f"{arguments.again} --jobs 2"), ("with GNU parallel", f"{drivers}/parallel.sh 2"), ("as a Slurm array", f"sbatch {drivers}/slurm.sh"),
            ("with Snakemake", f"snakemake -s {drivers}/Snakefile -d {drivers} --cores 2"), ("with Dask", f"/usr/bin/python3 {drivers}/dask_cases.py"),
            ("one of them", f"{arguments.program} run {shlex.quote(str(folder.path))} --case 1")]
    for way, command in ways:
        print(f"  {way:<20} {command}")


def explained(main):
    """Runs it, and ends with a sentence and the right exit code where that fails."""
    name = Path(sys.argv[0]).name
    try:
        sys.exit(main())
    except RunError as error:
        print(f"{name}: {error}", file=sys.stderr)
        sys.exit(2)
    except Stopped as signal:
        print(f"{name}: stopped by a signal, after checkpoints; the same command goes on.", file=sys.stderr)
        sys.exit(128 + signal.args[0])
    except OSError as error:
        print(f"{name}: {error.filename}: {error.strerror}.", file=sys.stderr)
        sys.exit(4)


def main():
    arguments = parse_arguments("talus sweep", "Makes the cases of a sweep, and runs them where it is asked to.")
    folder = make_folder(read_sweep(arguments.file), arguments.out, arguments.talus, arguments.force)
    if arguments.jobs < 1:
        if not arguments.quiet:
            print(f"{len(folder.cases())} cases in {folder.path / 'cases.csv'}; to run them:")
            tell_ways(folder, arguments)
            print(f"and then {arguments.program} gather {shlex.quote(str(folder.path))}")
        return 0
    complaints = run_all(arguments.talus, arguments.jobs, [folder], arguments.quiet)
    for complaint in complaints[:5]:
        print(f"sweep.py: {complaint}", file=sys.stderr)
    told = gather(folder)
    if not arguments.quiet:
        print(told)
    return 4 if complaints else 0


if __name__ == "__main__":
    explained(main)
