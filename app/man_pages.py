#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the manual pages from what the program says of itself.

    app/man_pages.py TALUS FOLDER       talus.1.gz, talus-run.1.gz … from `talus VERB --help`; talus-scene.5.gz from
                                        `talus keys`
"""
import gzip
import re
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

COLUMN = 30  # in which the program's help begins to tell what an option means

EXIT_STATUS = [
    ("0", "done"),
    ("1", "talus solve: the tolerance was not met; the result is written all the same. talus calibrate: runs are missing"),
    ("2", "wrong usage, a wrong scene or a wrong problem, told in one sentence"),
    ("3", "a sphere escaped, is not a number, blew up or is jammed"),
    ("4", "a file cannot be written"),
    ("70", "a fault of Talus, or too little memory"),
    ("128 + N", "signal N stopped the run, after a checkpoint"),
]


class Help(NamedTuple):
    """The parts of `talus VERB --help`."""
    purpose: str
    usage: str
    lists: dict  # heading: [(name, meaning), …]
    footer: list  # lines


def ask(talus, *arguments):
    return subprocess.run([talus, *arguments], check=True, capture_output=True, text=True).stdout


def read_list(lines):
    """Entries `  name   meaning`, in which the meaning may stand on a line of its own, further in."""
    entries = []
    for line, following in zip(lines, [*lines[1:], ""]):
        if line.startswith(" " * COLUMN):
            entries[-1][1] = line.strip()
        else:
            split = len(line) if following.startswith(" " * COLUMN) else COLUMN
            entries.append([line[:split].strip(), line[split:].strip()])
    return entries


def read_help(text):
    paragraphs = [paragraph.split("\n") for paragraph in text.strip().split("\n\n")]
    purpose, usage = paragraphs[0][:2]
    lists = {lines[0].rstrip(":"): read_list(lines[1:]) for lines in paragraphs[1:] if lines[0].endswith(":")}
    footer = [line for lines in paragraphs[1:] if not lines[0].endswith(":") for line in lines]
    return Help(purpose, usage.removeprefix("Usage: "), lists, footer)


def tidy(name):
    """An option as manuals write it: what CLI11 says of types and excluded options is left out."""
    name = re.sub(r" (REQUIRED|Excludes: \S+)", "", name)
    name = re.sub(r":INT in \[(\d+) - (\d+)\]", "", name)
    return name.replace(",--", ", --").replace(" ...", "")


def escaped(text):
    return re.sub(r"^([.'])", r"\\&\1", text.replace("\\", r"\e").replace("-", r"\-"))


def section(name, *lines):
    return f".SH {name}\n" + "\n".join(lines)


def tagged(entries):
    return [f".TP\n\\fB{escaped(tidy(name))}\\fR\n{escaped(meaning)}" for name, meaning in entries]


def page(name, number, version, purpose, *sections):
    head = f'.TH {name.upper()} {number} "" "Talus {version}" "Talus"'
    return "\n".join([head, section("NAME", f"{name} \\- {escaped(purpose)}"), *sections]) + "\n"


def sentence_case(text):
    return text[0].lower() + text[1:].rstrip(".")


def verb_page(talus, version, verb, verbs):
    told = read_help(ask(talus, verb, "--help"))
    sections = [section("SYNOPSIS", escaped(told.usage)), section("DESCRIPTION", escaped(told.purpose) + ".")]
    example = [line for line in told.footer if line.startswith("Example: ")]
    notes = [line for line in told.footer if not line.startswith("Example: ")]
    sections += [f".PP\n{escaped(note)}" for note in notes]
    sections += [section("ARGUMENTS", *tagged(told.lists["Positionals"]))] if "Positionals" in told.lists else []
    sections.append(section("OPTIONS", *tagged(told.lists["Options"])))
    sections.append(section("EXIT STATUS", *tagged(EXIT_STATUS)))
    sections.append(section("EXAMPLE", ".EX", *(escaped(line.removeprefix("Example: ")) for line in example), ".EE"))
    others = [f".BR talus\\-{other} (1)" for other in verbs if other != verb]
    sections.append(section("SEE ALSO", ",\n".join([".BR talus (1)", *others, ".BR talus\\-scene (5)"]).replace(
        "),", "),")))
    return page(f"talus-{verb}", 1, version, sentence_case(told.purpose), *sections)


def main_page(told, version):
    verbs = [(f"talus {verb}", meaning) for verb, meaning in told.lists["Subcommands"]]
    references = ",\n".join(f".BR talus\\-{verb} (1)" for verb, _ in told.lists["Subcommands"])
    return page("talus", 1, version, sentence_case(told.purpose),
                section("SYNOPSIS", ".B talus", "VERB [OPTIONS]"),
                section("DESCRIPTION", escaped(
                    "Talus runs a scene, a TOML file of spheres, walls and sensors, and writes frames for ParaView, "
                    "tables of metrics and a summary. What it does is said by a verb:"), *tagged(verbs)),
                section("OPTIONS", *tagged(told.lists["Options"])),
                section("EXIT STATUS", *tagged(EXIT_STATUS)),
                section("ENVIRONMENT", *tagged([("OMP_NUM_THREADS", "threads, unless --threads says so")])),
                section("FILES", *tagged([("share/talus/scenarios", "the scenes of talus list"),
                                          ("share/talus/postprocess", "scripts for pictures, plots and films")])),
                section("EXAMPLE", ".EX", *(escaped(line.removeprefix("Example: ")) for line in told.footer), ".EE"),
                section("SEE ALSO", references + ",\n.BR talus\\-scene (5)"))


def keys_page(keys, version):
    sections = [section("DESCRIPTION", escaped(
        "A scene is a TOML file of numbers in SI units; a text may carry another unit, \"5 mm\". These are all its "
        "keys, table by table. Tables that are lists are written [[wall]], those with a name [materials.glass]."))]
    for table in keys.strip().split("\n\n"):
        name, *lines = table.split("\n")
        entries = []
        for line in lines:
            if line.startswith("    "):
                entries[-1][1] += f"\n.br\n{escaped(line.strip())}"
            else:
                key, _, rule = line.strip().partition(" ")
                entries.append([key, escaped(rule.strip())])
        sections.append(section(name.upper() if name == "a scene" else escaped(name),
                                *(f".TP\n\\fB{escaped(key)}\\fR\n{text}" for key, text in entries)))
    return page("talus-scene", 5, version, "keys of a scene file of Talus", *sections,
                section("SEE ALSO", ".BR talus (1),\n.BR talus\\-keys (1)"))


def write(path, text):
    path.write_bytes(gzip.compress(text.encode(), mtime=0))


def main():
    if len(sys.argv) != 3:
        print(__doc__, file=sys.stderr)
        sys.exit(2)
    talus, folder = sys.argv[1], Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    version = ask(talus, "--version").split()[1]
    told = read_help(ask(talus, "--help"))
    verbs = [verb for verb, _ in told.lists["Subcommands"]]
    write(folder / "talus.1.gz", main_page(told, version))
    write(folder / "talus-scene.5.gz", keys_page(ask(talus, "keys"), version))
    for verb in verbs:
        write(folder / f"talus-{verb}.1.gz", verb_page(talus, version, verb, verbs))


if __name__ == "__main__":
    main()
