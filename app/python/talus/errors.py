# SPDX-License-Identifier: GPL-3.0-or-later
"""What can go wrong, each as one sentence."""
from __future__ import annotations

import json
import re

PLACE = re.compile(r"(?P<file>[^\n]*?):(?P<line>\d+):(?P<column>\d+): (?P<rest>.*)", re.S)


class SceneError(ValueError):
    """A scene, or what was to be set in it, is wrong.

    `file`, `line` and `column` say where; they are None where the scene is a dict, or it is no matter of a line.
    """

    file: str | None = None
    line: int | None = None
    column: int | None = None

    def __init__(self, sentence: str) -> None:
        super().__init__(sentence)
        if place := PLACE.match(sentence):
            self.file, self.line, self.column = place["file"], int(place["line"]), int(place["column"])


class Incident(RuntimeError):
    """A sphere escaped, blew up, is not a number, or bodies are pressed together without a solution.

    `incidents` has each of them as summary.json does: kind, id, position [m], speed [m/s], last_wall, sentence.
    """

    def __init__(self, sentence: str, incidents: str) -> None:
        super().__init__(sentence)
        self.incidents: list[dict] = json.loads(incidents)

    def __reduce__(self):
        return Incident, (str(self), json.dumps(self.incidents))


class StepWarning(UserWarning):
    """A scene asks for what it hardly means, or its step is too long for what happens."""
