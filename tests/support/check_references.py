#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What pages and lists say of the sources must stand there: the text that each mutant changes, once; every number of
the law in METHOD's table of thresholds, and every name of that table somewhere in the sources; files that core's README
names."""
import pathlib
import re
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
CORE = ROOT / "core"


def mutants():
    for mutant in tomllib.loads((ROOT / "tests/mutants/mutants.toml").read_text())["mutant"]:
        file = ROOT / mutant["file"]
        times = file.read_text().count(mutant["old"]) if file.is_file() else 0
        if times != 1:
            yield f"the text of the mutant '{mutant['name']}' stands {times} times in {mutant['file']}"


def thresholds():
    text = (CORE / "METHOD.md").read_text()
    table = text[text.index("## Thresholds"):text.index("## Limits")]
    listed = set(re.findall(r"`([a-z_]+)`", "\n".join(row.split("|")[1] for row in table.split("\n") if row.startswith("|"))))
    for name in re.findall(r"constexpr double (\w+)", (CORE / "law/thresholds.hpp").read_text()):
        if name not in listed:
            yield f"METHOD's table of thresholds lacks {name}"
    sources = "".join(file.read_text() for folder in (CORE, ROOT / "scenarios") for file in folder.rglob("*.?pp"))
    for name in listed:
        if not re.search(rf"\b{name}\b", sources):
            yield f"METHOD's table of thresholds names {name}, which is nowhere"


def files():
    text = (CORE / "README.md").read_text()
    for name in re.findall(r"`((?:base|world|law|packs|multibody|candidates|contacts|solver|deep_beds|step)/\w+)`", text):
        if not list(CORE.glob(name + ".?pp")):
            yield f"core/README.md names core/{name}, which is not there"


def main():
    wrong = [*mutants(), *thresholds(), *files()]
    print("\n".join(wrong) or "all there")
    return bool(wrong)


sys.exit(main())
