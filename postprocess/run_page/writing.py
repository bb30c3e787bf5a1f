# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes pages: whole or not at all, and not over what somebody else wrote."""
import os

from read_run import RunError


def refuse_foreign(path):
    """Raises RunError where the file is there and holds something that is no page of Talus."""
    if path.is_file() and b'<meta name="generator" content="Talus">' not in path.read_bytes()[:2000]:
        raise RunError(f"{path} is there already and is no page of Talus; --force replaces it.")


def write_whole(path, page):
    """Writes a file that is there whole or not at all. Raises OSError where it cannot be written."""
    beside = path.with_name(path.name + ".tmp")
    try:
        beside.write_text(page, encoding="utf-8")
        os.replace(beside, path)
    except OSError:
        beside.unlink(missing_ok=True)
        raise
