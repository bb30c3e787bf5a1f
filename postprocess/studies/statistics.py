# SPDX-License-Identifier: GPL-3.0-or-later
"""Mean and standard error of numbers that are added one by one."""
import math


class MeanAndError:
    """What is not a finite number is left out."""

    def __init__(self):
        self.count, self._mean, self._squares = 0, 0.0, 0.0

    def add(self, value):
        if not math.isfinite(value):
            return
        self.count += 1
        away = value - self._mean
        self._mean += away / self.count
        self._squares += away * (value - self._mean)

    def mean(self):
        """Not a number without values."""
        return self._mean if self.count else math.nan

    def standard_error(self):
        """Standard deviation / √count; not a number with fewer than two values."""
        return math.sqrt(self._squares / (self.count - 1) / self.count) if self.count > 1 else math.nan
