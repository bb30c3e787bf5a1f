# SPDX-License-Identifier: GPL-3.0-or-later
"""The memory of a simulation as arrays that know when it has changed."""
from __future__ import annotations

import numpy

from . import _core
from .errors import StaleView


class View:
    """The spheres as they lie in memory: read only, in storage order, until the next step or change."""

    def __init__(self, simulation: _core.Simulation) -> None:
        self._simulation, self._generation = simulation, simulation.generation

    def _array(self, name):
        array = self._simulation._view(name).view(StepArray)
        array._of = self._simulation
        array._generation = self._generation
        return check(array)

    @property
    def positions(self) -> numpy.ndarray:
        """Centres, (n, 3) [m]."""
        return self._array("positions")

    @property
    def velocities(self) -> numpy.ndarray:
        """Of the centres, (n, 3) [m/s]."""
        return self._array("velocities")

    @property
    def radii(self) -> numpy.ndarray:
        """(n,) [m]."""
        return self._array("radii")

    @property
    def materials(self) -> numpy.ndarray:
        """Indices into material_names, (n,)."""
        return self._array("materials")

    @property
    def ids(self) -> numpy.ndarray:
        """(n,): storage order changes, ids do not."""
        return self._array("ids")


class StepArray(numpy.ndarray):
    """An array that raises StaleView once the step that it shows is over. What is computed from it is a plain array.

    What escapes it, as `numpy.asarray(view)` does, goes on showing the old step.
    """

    def __array_finalize__(self, parent):
        shares = parent is not None and not self.flags.owndata
        self._of = getattr(parent, "_of", None) if shares else None
        self._generation = getattr(parent, "_generation", None)

    def __getattribute__(self, name):
        if not name.startswith("_") and name not in ("flags", "view"):
            check(self)
        return super().__getattribute__(name)

    def __getitem__(self, key):
        return super(StepArray, check(self)).__getitem__(key)

    def __iter__(self):
        return super(StepArray, check(self)).__iter__()

    def __array_ufunc__(self, ufunc, method, *inputs, **options):
        return getattr(ufunc, method)(*map(plain, inputs), **options)

    def __array_function__(self, function, types, arguments, options):
        return function(*map(deeply_plain, arguments), **{key: deeply_plain(value) for key, value in options.items()})

    def __repr__(self):
        return repr(plain(self))

    def __str__(self):
        return str(plain(self))


def check(array):
    """The array itself. Raises StaleView where it shows what is no more."""
    if array._of is not None and array._generation != array._of.generation:
        raise StaleView("the view is of a step that is over: ask the simulation for a new one, or for a copy before")
    return array


def plain(value):
    return numpy.ndarray.view(check(value), numpy.ndarray) if isinstance(value, StepArray) else value


def deeply_plain(value):
    return type(value)(map(deeply_plain, value)) if type(value) in (list, tuple) else plain(value)
