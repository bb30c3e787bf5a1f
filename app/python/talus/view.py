# SPDX-License-Identifier: GPL-3.0-or-later
"""The memory of a simulation as arrays."""
from __future__ import annotations

import numpy

from . import _core


class View:
    """The spheres as they lie in memory, read only, in storage order. An array shows the step in which it was asked
    for: while anyone holds it, later steps go on in other memory."""

    def __init__(self, simulation: _core.Simulation) -> None:
        self._array = simulation._view

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
