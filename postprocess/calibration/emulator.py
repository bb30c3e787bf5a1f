# SPDX-License-Identifier: GPL-3.0-or-later
"""A Gaussian process that tells what a run would find, from runs that were made.

A result is taken as f(x) plus a scatter from run to run: f is a Gaussian process (Matérn 5/2, a length for each key) whose
lengths, size and scatter are those of the largest likelihood. Its errors are then checked on each run left out of it,
and widened where they were told too small.
"""
import importlib.util
import warnings

import numpy

from read_run import RunError


def shares(unknown, values):
    """Values of keys, a row a run, as shares of their ranges."""
    columns = []
    for (low, high, log), column in zip(((one.low, one.high, one.log) for one in unknown), numpy.asarray(values, dtype=float).T):
        columns.append(numpy.log(column / low) / numpy.log(high / low) if log else (column - low) / (high - low))
    return numpy.column_stack(columns)


def require_gaussian_processes():
    """Raises RunError where a library that fits need is not there."""
    if any(importlib.util.find_spec(name) is None for name in ("sklearn", "scipy")):
        raise RunError("Calibration needs scikit-learn and SciPy: apt install python3-sklearn.")


class Emulator:
    """What runs find, over the unit cube of their keys.

    places: shares of the ranges, a row a run; values: what was found; columns: which of all unknown keys these are.
    """

    def __init__(self, places, values, columns):
        from sklearn.gaussian_process import GaussianProcessRegressor
        from sklearn.gaussian_process.kernels import ConstantKernel, Matern, WhiteKernel

        self.columns = columns
        self.places, self.values = places, numpy.asarray(values, dtype=float)
        self.middle, self.size = self.values.mean(), self.values.std() or 1.0
        kernel = ConstantKernel(1.0, (1e-2, 1e2)) * Matern([0.5] * places.shape[1], (0.1, 20.0), nu=2.5) + WhiteKernel(0.1, (1e-6, 2.0))
        self.process = GaussianProcessRegressor(kernel, n_restarts_optimizer=4, random_state=0)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # a length at its bound: a key that does nothing
            self.process.fit(places, (self.values - self.middle) / self.size)
        self.left_out, self.left_out_error = self.leave_one_out()
        self.widening = max(1.0, float(numpy.sqrt(numpy.mean(((self.values - self.left_out) / self.left_out_error) ** 2))))
        self.scatter = self.widening * self.size * float(numpy.sqrt(self.process.kernel_.k2.noise_level))

    def leave_one_out(self):
        """What the process tells of each run from all others, with its error, at the same lengths."""
        factor = self.process.L_
        inverse = numpy.linalg.inv(factor @ factor.T)
        diagonal = numpy.diag(inverse)
        z = (self.values - self.middle) / self.size
        return self.values - self.size * (inverse @ z) / diagonal, self.size / numpy.sqrt(diagonal)

    def tell(self, places):
        """The mean result at some places of all unknown keys, and its error, without the scatter of a single run."""
        means, errors = [], []
        for some in numpy.array_split(places[:, self.columns], max(1, len(places) // 4096)):
            mean, deviation = self.process.predict(some, return_std=True)
            means.append(self.middle + self.size * mean)
            error = self.widening * self.size * deviation
            errors.append(numpy.sqrt(numpy.maximum(error**2 - self.scatter**2, 0.0)))
        return numpy.concatenate(means), numpy.concatenate(errors)
