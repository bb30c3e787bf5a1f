#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Solves dumped steps with Talus and with Siconos, and compares speed and answers.

    talus dump hopper --at 2.0 -o hopper.hdf5
    tests/benchmarks/compare_siconos.py hopper.hdf5 --tolerance 1e-4 1e-8

Needs python3-siconos (Siconos's numerics), python3-h5py and python3-scipy of Debian; without them it says "skipped".

Siconos solves u = W r + q, here with W = Hᵀ M⁻¹ H in sparse blocks of 3 × 3, by nonsmooth Gauss–Seidel (fc3d_nsgs) in
the order of the file and from r = 0, as Talus does. Chosen for speed:

    storage    sparse blocks; ordinary sparse storage took two to four times as long for the same sweeps
    contact    newton: Alart and Curnier's function with the line search of Goldstein and Price; projection: projections
               onto the cone until they stand, which took up to twice as long where we tried both
    error      light: the change of a sweep, |Δr| / |r|, which costs next to nothing

So that both stop at the same accuracy, the light error's tolerance is halved, beginning with four times ours, until the
answer meets our tolerance under our measures; neither makes more than 100 000 sweeps. What is timed is a solve with
that tolerance from zero: the sweeps, not the assembly of W nor the reading of the file. Seconds are of the processor,
of one thread: others on the machine count less than with a clock. Where a solve takes less than a tenth of a second
they are noise.

Exit codes: 0 done, or skipped; 1 with --check, where a check fails; 2 the call or a file is wrong.
"""
import argparse
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
import warnings
from pathlib import Path
from typing import NamedTuple

os.environ["OMP_NUM_THREADS"] = os.environ["OPENBLAS_NUM_THREADS"] = "1"  # before anything loads them
try:
    import h5py
    import numpy
    import scipy.sparse
    import siconos.numerics as numerics
except ImportError as error:
    print(f"skipped: {error.name} is not installed (Debian: python3-siconos, python3-h5py, python3-scipy)")
    sys.exit(0)

MAX_SWEEPS = 100_000
LOCAL_SOLVERS = {
    "newton": numerics.SICONOS_FRICTION_3D_ONECONTACT_NSN_GP,
    "projection": numerics.SICONOS_FRICTION_3D_ONECONTACT_ProjectionOnConeWithLocalIteration,
}


class CompareError(Exception):
    """A problem that cannot be compared; the text is one sentence for the user."""


class Answer(NamedTuple):
    sweeps: int
    reaction: "numpy.ndarray"
    velocity: "numpy.ndarray"  # of the bodies


class Measures(NamedTuple):
    """What Talus says of an answer."""
    residual: float  # ε
    velocity_error: float  # worst of a contact, m/s
    met: bool  # ε is within the tolerance


def read_matrix(group):
    """A matrix that talus wrote: triplets."""
    rows, columns, count = (int(numpy.ravel(group[name][()])[0]) for name in ("m", "n", "nz"))
    if count < 0:
        raise CompareError(f"{group.file.filename}: only matrices of triplets, as 'talus dump' writes them, are read.")
    place = (group["i"][:count], group["p"][:count])
    return scipy.sparse.csc_matrix((group["x"][:count], place), shape=(rows, columns))


class Problem:
    """A contact problem of a file: M v = H r + f, u = Hᵀ v + w; in the local form u = W r + q."""

    def __init__(self, path):
        self.path = Path(path)
        with h5py.File(path) as file:
            if "fclib_global" not in file or int(numpy.ravel(file["fclib_global/spacedim"][()])[0]) != 3:
                raise CompareError(f"{path}: not a global problem with contacts of three rows.")
            group = file["fclib_global"]
            if "G" in group:
                raise CompareError(f"{path}: it has equalities, which fc3d_nsgs has not.")
            self.M, self.H = read_matrix(group["M"]), read_matrix(group["H"])
            self.f, self.w, self.mu = (group["vectors"][name][()].astype(float) for name in ("f", "w", "mu"))
        if self.M.nnz != self.M.shape[0]:
            raise CompareError(f"{path}: M must be diagonal, as that of spheres is.")
        self.mass = self.M.diagonal()
        inverse_mass = scipy.sparse.diags(1.0 / self.mass)
        self.W = (self.H.T @ inverse_mass @ self.H).tocsr()
        self.q = self.H.T @ (self.f / self.mass) + self.w

    def contacts(self):
        return len(self.mu)

    def velocity(self, reaction):
        return (self.H @ reaction + self.f) / self.mass

    def velocity_difference(self, a, b):
        """Largest difference over largest velocity; rows are weighed with √M, so that metres, radians and the bodies
        that stand for compliance can be compared."""
        weight = numpy.sqrt(self.mass)
        return numpy.max(weight * numpy.abs(a - b)) / numpy.max(weight * numpy.abs(a))


class Talus:
    """`talus solve` of one problem with one tolerance."""

    def __init__(self, binary, problem, tolerance, folder):
        self.command = [str(binary), "solve", "--tolerance", repr(tolerance)]
        self.problem = problem
        self.guessed, self.solved = Path(folder, "guessed.hdf5"), Path(folder, "solved.hdf5")
        shutil.copy(problem.path, self.guessed)
        self.seconds_without_sweeps = min(self.run(problem.path, 0)[0] for _ in range(3))

    def run(self, path, max_sweeps, *options):
        """Returns the seconds of processor, whether the tolerance was met, and what was said."""
        command = [*self.command, "--max-sweeps", str(max_sweeps), *options, "-o", str(self.solved), "--force", str(path)]
        with tempfile.TemporaryFile("w+") as output:
            process = subprocess.Popen(command, stdout=output, stderr=subprocess.STDOUT)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            output.seek(0)
            text = output.read()
        if process.returncode not in (0, 1):
            raise CompareError(f"talus failed: {text.strip()}")
        return usage.ru_utime + usage.ru_stime, process.returncode == 0, text

    def solve(self):
        """Returns the seconds of the sweeps, and the answer."""
        seconds, _, text = self.run(self.problem.path, MAX_SWEEPS)
        with h5py.File(self.solved) as file:
            answer = Answer(int(number_after("sweeps", text)), file["solution/r"][()], file["solution/v"][()])
        return seconds - self.seconds_without_sweeps, answer

    def measure(self, reaction):
        """Measures a reaction, which is handed over as the only guess of the file."""
        with h5py.File(self.guessed, "r+") as file:
            if "guesses" in file:
                del file["guesses"]
            file["guesses/number_of_guesses"] = numpy.int32(1)
            file["guesses/1/r"] = reaction
        _, met, text = self.run(self.guessed, 0, "--guess", "1")
        return Measures(number_after("residual", text), number_after("worst velocity violation", text), met)


def number_after(label, text):
    return float(re.search(rf"^{label}: ([^\s,]+)", text, re.MULTILINE).group(1))


class Siconos:
    """fc3d_nsgs of one problem."""

    def __init__(self, problem, local_solver):
        self.problem = problem
        rows = 3 * problem.contacts()
        _, self.blocks = numerics.SBM_from_csparse(3, problem.W)
        self.blocks.thisown = False  # the matrix frees it
        self.matrix = numerics.NM_create(numerics.NM_SPARSE_BLOCK, rows, rows)
        self.matrix.matrix1 = self.blocks
        self.statement = numerics.FrictionContactProblem(3, self.matrix, problem.q, problem.mu)
        self.options = numerics.SolverOptions(numerics.SICONOS_FRICTION_3D_NSGS)
        iparam = self.options.iparam
        iparam[numerics.SICONOS_FRICTION_3D_IPARAM_ERROR_EVALUATION] = (
            numerics.SICONOS_FRICTION_3D_NSGS_ERROR_EVALUATION_LIGHT)
        numerics.solver_options_update_internal(self.options, 0, LOCAL_SOLVERS[local_solver])

    def sweep(self, reaction, tolerance):
        """Sweeps on from this reaction. Returns the seconds of processor and the number of sweeps."""
        self.options.iparam[numerics.SICONOS_IPARAM_MAX_ITER] = MAX_SWEEPS
        self.options.dparam[numerics.SICONOS_DPARAM_TOL] = tolerance
        begin = time.process_time()
        numerics.fc3d_nsgs(self.statement, reaction, numpy.zeros_like(reaction), self.options)
        return time.process_time() - begin, int(self.options.iparam[numerics.SICONOS_IPARAM_ITER_DONE])

    def light_tolerance(self, talus, tolerance):
        """The largest of 4, 2, 1, ½ … times the tolerance with which the answer meets ours, if any does."""
        reaction = numpy.zeros_like(self.problem.q)
        light = 4.0 * tolerance
        while light > 1e-15:
            _, sweeps = self.sweep(reaction, light)
            if talus.measure(reaction).met or sweeps == MAX_SWEEPS:
                break
            light /= 2.0
        return light

    def solve(self, light_tolerance):
        """Returns the seconds of the sweeps, and the answer."""
        reaction = numpy.zeros_like(self.problem.q)
        seconds, sweeps = self.sweep(reaction, light_tolerance)
        return seconds, Answer(sweeps, reaction, self.problem.velocity(reaction))

    def own_error(self, reaction):
        """Siconos's full error: the natural map with ρ = 1, in mixed units, over |q|."""
        velocity = numpy.zeros_like(reaction)
        norm_q = float(numpy.linalg.norm(self.problem.q))
        return numerics.fc3d_compute_error(self.statement, reaction.copy(), velocity, 0.0, self.options, norm_q)[1]


class Comparison(NamedTuple):
    text: str
    met: bool
    velocity_difference: float


def compare(problem, tolerance, arguments):
    """Solves a problem with both, in turn."""
    with tempfile.TemporaryDirectory() as folder:
        talus = Talus(arguments.talus, problem, tolerance, folder)
        siconos = Siconos(problem, arguments.local)
        light = siconos.light_tolerance(talus, tolerance)
        seconds = {"Talus": [], "Siconos": []}
        answers = {}
        for _ in range(arguments.runs):
            for name, solve in (("Talus", talus.solve), ("Siconos", lambda: siconos.solve(light))):
                taken, answers[name] = solve()
                seconds[name].append(taken)
        measures = {name: talus.measure(answer.reaction) for name, answer in answers.items()}
        difference = problem.velocity_difference(answers["Talus"].velocity, answers["Siconos"].velocity)
        lines = []
        for name, answer in answers.items():
            taken = statistics.median(seconds[name])
            updates = answer.sweeps * problem.contacts() / taken if taken > 0.0 else numpy.nan
            lines.append(f"| {problem.path.stem} | {problem.contacts()} | {tolerance:g} | {name} | {answer.sweeps} "
                f"| {taken:.3g} | {updates:.3g} | {measures[name].residual:.2g} "
                f"| {measures[name].velocity_error:.2g} | {siconos.own_error(answer.reaction):.2g} ")
        ratio = statistics.median(a / b for a, b in zip(seconds["Talus"], seconds["Siconos"]))
        lines[0] += "| | |"
        lines[1] += f"| {difference:.2g} | {ratio:.2f} |"
        return Comparison("\n".join(lines), all(each.met for each in measures.values()), difference)


HEADER = """\
| problem | contacts | tolerance | solver | sweeps | seconds | updates/s | ε | velocity error, m/s | Siconos's error \
| velocity difference | seconds, Talus / Siconos |
| --- | ---: | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"""


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("problems", nargs="+", metavar="PROBLEM", help="a file that 'talus dump' wrote")
    parser.add_argument("--tolerance", nargs="+", type=float, default=[1e-4, 1e-8], help="on our ε [1e-4 1e-8]")
    parser.add_argument("--runs", type=int, default=3, help="of each, in turn; the median counts [3]")
    parser.add_argument("--local", choices=LOCAL_SOLVERS, default="newton",
        help="Siconos's solver of a contact [newton]")
    parser.add_argument("--talus", default=Path(__file__).resolve().parents[2] / "build" / "talus", help="the program")
    parser.add_argument("--check", action="store_true", help="fail unless both answers meet the tolerance")
    parser.add_argument("--same-velocities", type=float, metavar="LIMIT",
        help="fail where velocities differ by more, relative to the largest: for problems with one solution")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    warnings.filterwarnings("ignore", message="Performance warning")  # of Siconos, on the conversion of W
    failures = []
    print(HEADER, flush=True)
    try:
        for path in arguments.problems:
            problem = Problem(path)
            for tolerance in arguments.tolerance:
                comparison = compare(problem, tolerance, arguments)
                print(comparison.text, flush=True)
                if arguments.check and not comparison.met:
                    failures.append(f"{path}: an answer does not meet {tolerance:g}")
                limit = arguments.same_velocities
                if limit is not None and not comparison.velocity_difference <= limit:
                    failures.append(f"{path}: velocities differ by {comparison.velocity_difference:.2g}")
    except (CompareError, OSError, KeyError) as error:
        print(f"compare_siconos.py: {error}", file=sys.stderr)
        sys.exit(2)
    for failure in failures:
        print(f"compare_siconos.py: {failure}", file=sys.stderr)
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
