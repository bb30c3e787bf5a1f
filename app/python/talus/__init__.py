# SPDX-License-Identifier: GPL-3.0-or-later
"""Talus: granular dynamics, many spheres in contact with Coulomb friction.

    import talus
    sim = talus.Simulation("hopper", set={"contact.glass-glass.friction": 0.3}, threads=2)
    sim.run(until=0.5)
    print(sim.positions().shape, sim.sensors())

`Run(folder)` reads what a run left. Numbers are SI.
"""
import os as _os
from pathlib import Path as _Path

from .errors import Incident, SceneError, StepWarning
from .run import Measurement, Run, RunError, read_frame

# Idle threads of GCC's OpenMP spin, on a processor that others may need, unless they are told when they are made.
if "OMP_WAIT_POLICY" not in _os.environ:
    _os.environ.setdefault("GOMP_SPINCOUNT", "2000")

__all__ = ["Incident", "Measurement", "Run", "RunError", "SceneError", "StepWarning", "read_frame"]

try:
    from . import _core
except ImportError as _error:
    _reason = str(_error)

    def __getattr__(name):
        if name in ("Findings", "Simulation", "check", "keys", "resume", "scenes", "__version__"):
            raise ImportError(f"talus.{name} needs the compiled module, which is not here ({_reason}): build it with "
                              "app/setup all; talus.Run works without")
        raise AttributeError(f"module 'talus' has no attribute '{name}'")
else:
    # Scenes lie in share/talus beside lib/python3/dist-packages, where it is installed, else in the source tree.
    _share = _Path(_os.path.abspath(_core.__file__)).parents[4] / "share" / "talus"
    _core.set_own_files(_share if (_share / "scenarios").is_dir() else _core.source_folder)
    from ._core import Findings, __version__, scenes
    from .simulation import Simulation, check, keys, resume

    __all__ += ["Findings", "Simulation", "check", "keys", "resume", "scenes"]
