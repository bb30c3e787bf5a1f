# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes pages and data: whole or not at all, not over what somebody else wrote, and JSON without numbers that it has no
word for."""
import math
import os

from read_run import RunError


def refuse_foreign(path):
    """Raises RunError where the file is there and holds something that is no page of Talus."""
    if path.is_file() and b'<meta name="generator" content="Talus">' not in path.read_bytes()[:2000]:
        raise RunError(f"{path} is there already and is no page of Talus; --force replaces it.")


def strict(data):
    """The same without what JSON has no word for: numbers that are not finite become null."""
    if isinstance(data, dict):
        return {key: strict(value) for key, value in data.items()}
    if isinstance(data, (list, tuple)):
        return [strict(value) for value in data]
    return None if isinstance(data, float) and not math.isfinite(data) else data


def write_whole(path, content):
    """Writes text or bytes to a file that is there whole or not at all. Raises OSError where it cannot be written."""
    beside = path.with_name(path.name + ".tmp")
    try:
        beside.write_bytes(content if isinstance(content, bytes) else content.encode())
        os.replace(beside, path)
    except OSError:
        beside.unlink(missing_ok=True)
        raise
