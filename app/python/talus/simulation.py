# SPDX-License-Identifier: GPL-3.0-or-later
"""Simulations that a program makes the steps of."""
from __future__ import annotations

import json
import math
import os
import warnings
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy

from . import _core
from .errors import SceneError, StepWarning
from .run import Measurement
from .scene_text import scene_text, toml_value
from .view import View

Scene = str | os.PathLike | Mapping
Changes = Mapping[str, Any] | Iterable[str] | None  # a dict, or texts as --set takes them


def read(scene: Scene, use: Callable[[str, str | None], Any]) -> Any:
    """Calls use(path or name, text) for a scene in whatever form it comes."""
    if isinstance(scene, Mapping):
        text, keys = scene_text(scene)
        try:
            return use("scene", text)
        except SceneError as error:
            if error.file != "scene" or error.line is None:
                raise
            sentence = str(error).split(": ", 1)[1]
            raise SceneError(f"{keys[error.line - 1]}: {sentence}") from None
    if isinstance(scene, str) and ("\n" in scene or "=" in scene and not os.path.exists(scene)):
        return use("scene", scene)
    return use(os.fspath(scene), None)


def overrides(changes: Changes) -> list[str]:
    """As --set has them."""
    if isinstance(changes, Mapping):
        return [f"{key}={toml_value(value)}" for key, value in changes.items()]
    return list(changes or ())


def check(scene: Scene, set: Changes = None) -> dict[str, Any]:
    """What `talus check` tells of a scene, as a dict: spheres, step_length [s], diameters [m] (least, mean, largest),
    overlaps, warnings, resolved (the scene as TOML with every key) and more. Raises SceneError where it is wrong."""
    return read(scene, lambda path, text: _core.check(path, text, overrides(set)))


def keys(table: str = "") -> str:
    """Every key of a scene, or of one of its tables ("wall"), with default, unit and meaning: `talus keys`."""
    return _core.keys(table)


def resume(place: str | os.PathLike, set: Changes = None, threads: int = 0) -> Simulation:
    """The run in a folder, which goes on there from its checkpoint, or what `save` kept in a file.

    `set` may change what `talus resume --set` may.
    """
    simulation = Simulation.__new__(Simulation)
    _core.Simulation.__init__(simulation, os.fspath(place), overrides(set), threads)
    return simulation


class Simulation(_core.Simulation):
    """A scene, built; its steps are made by step() or run(), and between them it can be looked at and changed.

    scene    name of a supplied scene, path, TOML text, or dict with the keys of a scene file
    set      changes: {"contact.glass-glass.friction": 0.3}, or texts as --set takes them
    threads  for the steps; 0: all. The bits are the same for any number.
    out      a folder into which goes what `talus run` writes; close(), or leaving a `with`, ends the run in it
    force    replaces the files of a run in that folder
    state    bytes of state(), from which it begins: of the same scene, perhaps under another setting

    Lengths are m, times s, forces N; arrays are numpy's, float64, spheres in the order of their ids.
    """

    def __init__(self, scene: Scene, set: Changes = None, threads: int = 0,
                 out: str | os.PathLike | None = None, force: bool = False, state: bytes | None = None) -> None:
        read(scene, lambda path, text: super(Simulation, self).__init__(
            path, text, overrides(set), threads, None if out is None else os.fspath(out), force))
        if state is not None:
            self.restore(state)
        self._warn()

    def _warn(self):
        for sentence in self._take_warnings():
            warnings.warn(sentence, StepWarning, stacklevel=3)

    def __repr__(self):
        return f"<Simulation '{self.name}': {self.count} spheres, t = {self.time:.6g} s>"

    def __enter__(self) -> Simulation:
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    # Steps

    def step(self) -> _core.StepReport:
        """Makes one step. Raises Incident where it must not go on."""
        self._step()
        self._warn()
        return self.report

    def run(self, until: float | None = None, every: float | None = None,
            call: Callable[[Simulation], Any] | None = None) -> bool:
        """Makes steps until a time [s], by default the scene's duration, and returns True; `call(simulation)` is called
        every so often [s], or after every step, and ends it with something true: then returns False.

        Ctrl-C ends it between two steps, after which all can go on. Raises Incident.
        """
        until = self.duration if until is None else until
        if not math.isfinite(until):
            raise ValueError(f"until is {until}: give a time in seconds")
        if every is not None and not 0 < every < math.inf:
            raise ValueError(f"every is {every}: give a time in seconds above 0, or None for every step")
        while self.time < until - 1e-3 * self.step_length:
            if call is None:
                self._run_until(until)
            elif every is None:
                self._step()
            else:
                due = every * (math.floor(self.time / every * (1 + 1e-9)) + 1)
                self._run_until(min(due, until))
            self._warn()
            if call is not None and call(self):
                return False
        return True

    # What there is, as copies in the order of ids

    def positions(self) -> numpy.ndarray:
        """Centres, (n, 3) [m]."""
        return self._copy("positions")

    def velocities(self) -> numpy.ndarray:
        """Of the centres, (n, 3) [m/s]."""
        return self._copy("velocities")

    def angular_velocities(self) -> numpy.ndarray:
        """(n, 3) [rad/s]."""
        return self._copy("angular_velocities")

    def radii(self) -> numpy.ndarray:
        """(n,) [m]."""
        return self._copy("radii")

    def masses(self) -> numpy.ndarray:
        """(n,) [kg]."""
        return self._copy("masses")

    def materials(self) -> numpy.ndarray:
        """Indices into material_names, (n,)."""
        return self._copy("materials")

    def ids(self) -> numpy.ndarray:
        """(n,), rising: 0, 1, … in the order in which spheres came in."""
        return self._copy("ids")

    def forces(self) -> numpy.ndarray:
        """The own forces that were set, (n, 3) [N]."""
        return self._copy("own_forces")

    @property
    def view(self) -> View:
        """The same without a copy, as they are now, read only, in storage order; later steps leave the arrays alone."""
        return View(self)

    def wall(self, name: str) -> _core.Wall:
        """A wall: its force, torque and position; its velocity or load may be set. Raises KeyError."""
        return self._wall(name)

    def sensor(self, name: str) -> dict[str, float]:
        """The latest sample of a sensor, by quantity; it takes one every time.metrics_interval. Raises KeyError."""
        latest = {quantity: value for sensor, quantity, value, _, _ in self._measured(True) if sensor == name}
        if not latest:
            raise KeyError(f"there is no sensor '{name}'; there is {', '.join(self.sensors()) or 'none'}")
        return latest

    def sensors(self) -> dict[str, dict[str, Measurement]]:
        """The results of all sensors so far: sensor → quantity → (value, spread, unit)."""
        results: dict[str, dict[str, Measurement]] = {}
        for sensor, quantity, value, spread, unit in self._measured(False):
            results.setdefault(sensor, {})[quantity] = Measurement(value, spread, unit)
        return results

    def summary(self) -> dict[str, Any]:
        """What summary.json has of a run: sensors, ledger, error of the run, times; as far as it has come."""
        return json.loads(self._summary())

    # Changes between steps, which checkpoints keep and the summary tells ("touched")

    def set_force(self, ids: int | Iterable[int], force: Any) -> None:
        """From now on this force acts on these spheres besides gravity and contacts: (3,) or (n, 3) [N]."""
        ids = numpy.atleast_1d(numpy.asarray(ids, dtype=numpy.int64))
        self._set_forces(ids.tolist(), numpy.broadcast_to(numpy.asarray(force, dtype=float), (len(ids), 3)))

    def add(self, positions: Any, diameter: float, material: str, velocity: Any = (0.0, 0.0, 0.0)) -> numpy.ndarray:
        """Puts spheres in at (3,) or (n, 3) [m], and returns their ids, (n,). Nothing looks whether there is room."""
        places = numpy.atleast_2d(numpy.asarray(positions, dtype=float))
        return numpy.array([self._add(place, diameter, material, velocity) for place in places])

    def copy(self, set: Changes = None, threads: int = 0) -> Simulation:
        """Another simulation of the scene as it is now, perhaps under another setting. Sensors begin anew."""
        return Simulation(self.resolved, set, threads, state=self.state())
