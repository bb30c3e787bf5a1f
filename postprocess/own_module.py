# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python module of Talus, for scripts that make simulations."""
import os
import sys
from pathlib import Path

MISSING = ("{verb}: the Python module of Talus is not there ({reason}): apt install python3-talus; where Talus is built "
           "from source, apt install pybind11-dev python3-dev python3-numpy and build again.")


def find_module(program, verb):
    """The module that belongs to the program, of its build folder, or installed beside it. Where there is none, ends the
    script, which is called as `verb`, with a sentence."""
    folder = Path(os.path.realpath(program)).parent
    for place in (folder.parent / "lib" / "python3" / "dist-packages", folder / "python"):
        if list(place.glob("talus/_core.*.so")):
            sys.path.insert(0, str(place))
    try:
        import talus
        talus.Simulation  # noqa: B018  raises where the compiled half is not there
    except ImportError as error:
        print(MISSING.format(verb=verb, reason=error), file=sys.stderr)
        sys.exit(2)
    return talus
