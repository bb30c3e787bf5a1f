# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes that are dictionaries, as TOML."""
from __future__ import annotations

import json
import numbers
import os
import re
from collections.abc import Mapping
from typing import Any


def toml_value(value: Any) -> str:
    """A value as TOML, on one line. Raises TypeError where a scene has no such values."""
    if hasattr(value, "tolist"):  # of numpy
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(os.fspath(value), ensure_ascii=False)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{toml_key(key)} = {toml_value(one)}" for key, one in value.items()) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml_value(one) for one in value) + "]"
    raise TypeError(f"a scene has numbers, texts, lists and dicts, not {type(value).__name__}")


def toml_key(key: str) -> str:
    return key if re.fullmatch(r"[A-Za-z0-9_-]+", key) else json.dumps(key, ensure_ascii=False)


def scene_text(scene: Mapping) -> tuple[str, list[str]]:
    """The TOML of a scene, and what each of its lines speaks of: "wall[2].radius"."""
    lines, keys = [], []

    def add(line, key):
        lines.append(line)
        keys.append(key)

    def add_table(header, table, path):
        add(header, path)
        for key, value in table.items():
            add(f"{toml_key(key)} = {toml_value(value)}", f"{path}.{key}")

    for key, value in scene.items():
        if not is_table(value) and not is_list_of_tables(value):
            add(f"{toml_key(key)} = {toml_value(value)}", key)
    for key, value in scene.items():
        if is_table(value):
            add_table(f"[{toml_key(key)}]", value, key)
        elif is_list_of_tables(value):
            for index, table in enumerate(value):
                add_table(f"[[{toml_key(key)}]]", table, f"{key}[{index}]")
    return "\n".join(lines) + "\n", keys


def is_table(value):
    return isinstance(value, Mapping)


def is_list_of_tables(value):
    return isinstance(value, (list, tuple)) and len(value) > 0 and all(map(is_table, value))
