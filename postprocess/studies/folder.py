# SPDX-License-Identifier: GPL-3.0-or-later
"""The folder of a study.

    study.resolved.toml     which study it is: version of Talus, checksum of its scene, every key
    start_of_seed_N.state   the states that runs begin with
    rows.jsonl              a line for each run as soon as it is done
    study.csv, study.html   what came of it
"""
import json
import math
import shutil
from pathlib import Path

from read_run import RunError
from run_page.writing import strict, write_whole

MARK, ROWS, LOCK = "study.resolved.toml", "rows.jsonl", "talus.lock"
ROW_KEYS = ("setting", "seed", "status", "cpu_s_per_s", "contact_updates_per_s", "memory_B", "findings", "profile")


def make_folder(path):
    """Makes the folder of a study, which may be there: empty, or with a study. Raises RunError where it is something else."""
    path = Path(path)
    if path.exists() and not path.is_dir():
        raise RunError(f"{path}: is a file, not a folder for a study")
    if path.is_dir() and not (path / MARK).exists() and any(one.name != LOCK for one in path.iterdir()):
        raise RunError(f"{path}: the folder is not empty and holds no study")
    path.mkdir(parents=True, exist_ok=True)


def take_folder(path, identity, force):
    """Makes a folder, which no other process writes into, that of a study. Raises RunError where it is of another one."""
    mark = Path(path) / MARK
    if mark.exists() and force:
        remove_study(Path(path))
    elif mark.exists():
        if mark.read_text(encoding="utf-8") != identity:
            raise RunError(f"{path}: the folder holds another study, or one of the scene as it was; --force replaces it")
        return
    write_whole(mark, identity)


def remove_study(path):
    """Takes away what a study wrote; other files in its folder stay."""
    for one in path.iterdir():
        if one.name in (ROWS, "study.csv", "study.html", MARK) or one.name.startswith("start_of_seed_"):
            shutil.rmtree(one) if one.is_dir() and not one.is_symlink() else one.unlink()


def with_nan(value):
    return math.nan if value is None else value


def row_text(row):
    """A row as one line of JSON, without its end; what is not a number is null."""
    return json.dumps(strict({key: row[key] for key in ROW_KEYS}), separators=(",", ":"), ensure_ascii=False)


def read_row(line):
    """Reads a line back. Raises RunError where it is none."""
    try:
        row = json.loads(line)
        row = {key: with_nan(row[key]) for key in ROW_KEYS}
        row["findings"] = [{"name": m["name"], "value": with_nan(m["value"]), "spread": with_nan(m["spread"]), "unit": m["unit"]} for m in row["findings"]]
        row["profile"] = [with_nan(force) for force in row["profile"]]
    except (ValueError, KeyError, TypeError) as error:
        raise RunError(f"not a row of a study: {error!r}") from error
    return row


class Rows:
    """The rows of a study, in its folder. A last line that was cut off is not gone on with."""

    def __init__(self, folder):
        self.path = Path(folder) / ROWS
        whole = self.path.read_text(encoding="utf-8").split("\n")[:-1] if self.path.exists() else []
        self.all = []
        for number, line in enumerate(whole, 1):
            try:
                self.all.append(read_row(line))
            except RunError as error:
                raise RunError(f"{self.path}:{number}: {error}") from error
        write_whole(self.path, "".join(line + "\n" for line in whole))

    def add(self, row):
        self.all.append(row)
        with self.path.open("a", encoding="utf-8") as file:
            file.write(row_text(row) + "\n")

    def has(self, setting, seed):
        return any(row["setting"] == setting and row["seed"] == seed for row in self.all)
