# SPDX-License-Identifier: GPL-3.0-or-later
"""Values of keys as text: TOML, as --set takes it, with strings bare where they may be."""
import re

WORDS = ("true", "false", "inf", "nan")


def setting_text(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, str):
        bare = re.fullmatch(r"[A-Za-z_][\w-]*", value, re.ASCII) and value not in WORDS
        return value if bare else quoted(value)
    if isinstance(value, list):
        return "[" + ", ".join(inner_text(one) for one in value) + "]"
    return "{ " + ", ".join(f"{quoted(key)} = {inner_text(one)}" for key, one in value.items()) + " }"


def inner_text(value):
    return quoted(value) if isinstance(value, str) else setting_text(value)


def quoted(value):
    """A basic string of TOML."""
    escaped = value.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + re.sub(r"[\x00-\x1f\x7f]", lambda one: f"\\u{ord(one[0]):04x}", escaped) + '"'
