# SPDX-License-Identifier: GPL-3.0-or-later
"""What the unknown keys may be, given what was measured.

Before, every value in their ranges is as likely as any other. A measurement is told to be normal around what runs would
find on average, with the variances of its own error, of the emulator's, and of the scatter from run to run, which an
experiment is taken to have as well, over the number of its repeats.

The posterior is summed over points of a Sobol sequence in a box, which is drawn closer until enough of them count, or
it cannot be: it holds every point that is not as good as impossible.
"""
import warnings
from dataclasses import dataclass

import numpy

ENOUGH = 1000  # points that count
MOST_BOXES = 8
STUCK = 0.8  # of its volume, to which a box must become smaller
NEGLIGIBLE = 10.0  # of the logarithm of the likelihood below its largest
DRAWN = 3000  # points of a posterior that stand for it


@dataclass
class Posterior:
    """Points in the unit cube, a row each, all as likely; and the likeliest of all that were tried."""
    places: numpy.ndarray
    best: numpy.ndarray
    misfit: float  # chi squared of the likeliest
    counting: float  # how many points count

    def interval(self, k, share=0.95):
        """Median of a key and the ends of the shortest interval that has so much of the probability.

        Where a key is likeliest at an end of its range, that end is in it.
        """
        ordered = numpy.concatenate([[0.0], numpy.sort(self.places[:, k]), [1.0]])
        held = round(share * len(ordered))
        begin = int(numpy.argmin(ordered[held:] - ordered[:-held]))
        return float(numpy.median(self.places[:, k])), float(ordered[begin]), float(ordered[begin + held])


def misfits(places, measured, emulators):
    """Chi squared at each place, and what is to be added to it for -2 log of the likelihood."""
    squares, logs = numpy.zeros(len(places)), numpy.zeros(len(places))
    for one, emulator in zip(measured, emulators):
        mean, error = emulator.tell(places)
        variance = one.error**2 + error**2 + emulator.scatter**2 / one.repeats
        squares += (one.value - mean) ** 2 / variance
        logs += numpy.log(variance / one.error**2)
    return squares, logs


def posterior(measured, emulators, dimensions):
    """The Posterior of so many keys, from some measurements, each with the emulator of what it measured."""
    from scipy.stats import qmc

    points = 2 ** min(12 + dimensions, 17)
    low, high = numpy.zeros(dimensions), numpy.ones(dimensions)
    for box in range(MOST_BOXES):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            places = low + (high - low) * qmc.Sobol(dimensions, seed=box).random(points)
        squares, logs = misfits(places, measured, emulators)
        likelihood = -0.5 * (squares + logs)
        weights = numpy.exp(likelihood - likelihood.max())
        weights /= weights.sum()
        counting = 1.0 / numpy.sum(weights**2)
        if counting >= ENOUGH:
            break
        kept = places[likelihood > likelihood.max() - NEGLIGIBLE]
        room = 0.1 * (kept.max(axis=0) - kept.min(axis=0)) + 0.02 * (high - low)
        before = high - low
        low, high = numpy.maximum(kept.min(axis=0) - room, low), numpy.minimum(kept.max(axis=0) + room, high)
        if numpy.prod((high - low) / before) > STUCK:
            break
    best = int(likelihood.argmax())
    steps = (numpy.arange(DRAWN) + 0.5) / DRAWN
    chosen = numpy.searchsorted(numpy.cumsum(weights), steps).clip(0, points - 1)
    return Posterior(places[chosen], places[best], float(squares[best]), float(counting))
