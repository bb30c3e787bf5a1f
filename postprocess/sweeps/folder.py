# SPDX-License-Identifier: GPL-3.0-or-later
"""The folder of a sweep.

    sweep.json      which sweep it is: version of Talus, scene, its files with their checksums, titles
    cases.csv       a row for each case: its number, its keys
    scene/          copies of the scene and of the files that it names, so that later changes do not mix into the sweep
    cases/0001/     the run of a case, or refused.txt, which says why its scene was refused
    drivers/        how queues run the cases
    results.csv, costs.csv, results.parquet, sweep.html        what was gathered
"""
import csv
import io
import json
import os
import shlex
import shutil
import subprocess
import tomllib
import zlib
from pathlib import Path

from read_run import RunError, is_locked
from run_page.writing import write_whole
from sweeps.design import cases_of
from sweeps.setting_text import setting_text

MARK = "sweep.json"
OWN = (MARK, "cases.csv", "scene", "cases", "drivers", "results.csv", "costs.csv", "results.parquet", "sweep.html")
DRIVERS = Path(__file__).resolve().parent / "drivers"
ARRAY = 1000  # Slurm's usual limit on the tasks of an array


class SweepFolder:
    """What is in the folder of a sweep.

    Raises RunError where the folder holds none.
    """

    def __init__(self, path):
        self.path = Path(path)
        try:
            self.about = json.loads((self.path / MARK).read_text(encoding="utf-8"))
        except (FileNotFoundError, NotADirectoryError) as error:
            raise RunError(f"{self.path} holds no sweep, which 'talus sweep' makes.") from error
        except ValueError as error:
            raise RunError(f"{self.path / MARK} is damaged: {error}.") from error

    def cases(self):
        """The settings of each case as text, by its number."""
        path = self.path / "cases.csv"
        if not path.is_file():
            raise RunError(f"{path} is not there; give 'talus sweep' again.")
        with path.open(newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        return {int(row.pop("case")): row for row in rows}

    def run_of(self, number):
        return self.path / "cases" / f"{number:04}"

    def identity_of(self, settings):
        """What `talus run DIR --case N` notes of a case in its folder: settings and files, a line each."""
        lines = [f"{key}={value}" for key, value in settings.items() if value]
        return "".join(line + "\n" for line in [*lines, *(f"{name} {one}" for name, one in sorted(self.about["files"].items()))])

    def varied(self):
        """The keys that are not the same in all cases, the seed last."""
        cases = list(self.cases().values())
        keys = [key for key in cases[0] if len({case[key] for case in cases}) > 1] if cases else []
        return sorted(keys, key=lambda key: key == "seed")


def make_folder(sweep, path, talus, force):
    """The folder of a sweep: a new one, or the one that is there, with cases that are new added at its end.

    Raises RunError where the folder holds something else, or the scene is refused.
    """
    path = Path(path)
    files, version = look_at_scene(sweep, talus)
    if path.is_dir() and any(path.iterdir()) and not (path / MARK).is_file():
        raise RunError(f"{path}: the folder is not empty and holds no sweep; choose another with --out.")
    if force and path.is_dir():
        remove_sweep(path)
    cases = [{key: setting_text(value) for key, value in case.items()} for case in cases_of(sweep)]
    about = {"version": version, "name": sweep.name, "title": sweep.title, "scene": "scene/" + files.scene, "files": files.sums,
             "keys": list(cases[0]), "threads": sweep.threads, "reports": sweep.reports}
    if (path / MARK).is_file():
        cases = joined(SweepFolder(path), about, cases)
    path.mkdir(parents=True, exist_ok=True)
    write_whole(path / MARK, json.dumps(about, indent=2, ensure_ascii=False) + "\n")  # first, so that what is begun is known to be a sweep
    files.copy_into(path / "scene")
    write_cases(path / "cases.csv", cases)
    write_drivers(path, talus, about, len(cases))
    return SweepFolder(path)


def joined(there, about, cases):
    """The cases that a folder has, and after them those that are new. Raises RunError where the folder is of another sweep."""
    def refuse(reason):
        raise RunError(f"{there.path}: the folder holds another sweep: {reason}; --force begins it anew, --out chooses another folder.")

    for key, what in (("version", "of Talus {there}, and this is {here}"), ("files", "its scene, or a file that this names, is another one"),
                      ("keys", "its cases have the keys {there}, and those asked for {here}")):
        here, before = about[key], there.about.get(key)
        if here != before:
            refuse(what.format(here=here if isinstance(here, str) else ", ".join(here), there=before if isinstance(before, str) else ", ".join(before or [])))
    if not (there.path / "cases.csv").is_file():
        return cases
    old = there.cases()
    wanted = [tuple(case.values()) for case in cases]
    for number, case in old.items():
        if tuple(case.values()) not in wanted:
            refuse(f"case {number}, {', '.join(f'{key} = {case[key]}' for key in case)}, is no longer asked for")
    known = {tuple(case.values()) for case in old.values()}
    return [*old.values(), *(case for case in cases if tuple(case.values()) not in known)]


def write_cases(path, cases):
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["case", *cases[0]])
    writer.writerows([number, *case.values()] for number, case in enumerate(cases, 1))
    write_whole(path, text.getvalue())


class SceneFiles:
    """A scene file and the files that it names, as they lie to each other.

    named: as the scene names them; those with an absolute path stay where they are.
    sums: checksum (CRC-32) of each by its path in `scene/`, or its absolute path.
    """

    def __init__(self, scene, named):
        scene = Path(os.path.abspath(scene))
        beside = sorted({Path(os.path.abspath(scene.parent / one)) for one in named if not os.path.isabs(one)})
        self.root = Path(os.path.commonpath([one.parent for one in (scene, *beside)]))
        self.copied = [scene, *beside]
        self.scene = str(scene.relative_to(self.root))
        outside = sorted({Path(one) for one in named if os.path.isabs(one)})
        self.sums = {name: f"{zlib.crc32(one.read_bytes()):08x}" for name, one in sorted(
            [(str(one.relative_to(self.root)), one) for one in self.copied] + [(str(one), one) for one in outside])}

    def copy_into(self, folder):
        for one in self.copied:
            copy = folder / one.relative_to(self.root)
            if not copy.is_file():
                copy.parent.mkdir(parents=True, exist_ok=True)
                beside = copy.with_name(copy.name + ".tmp")
                shutil.copyfile(one, beside)
                os.replace(beside, copy)


def look_at_scene(sweep, talus):
    """Asks the program whether it takes the first case. Returns the SceneFiles and the version of Talus.

    Raises RunError with what the program says where it refuses.
    """
    scene = Path(sweep.scene)
    if not scene.is_file():
        scene = Path(__file__).resolve().parents[2] / "scenarios" / f"{sweep.scene}.toml"
    first = cases_of(sweep)[0]
    words = [word for key, value in first.items() for word in ("--set", f"{key}={setting_text(value)}")]
    told = subprocess.run([talus, "check", sweep.scene, *words], capture_output=True, text=True, check=False)
    if told.returncode != 0:
        raise RunError(told.stderr.strip().removeprefix("talus: "))
    named = [*named_files(tomllib.loads(scene.read_text(encoding="utf-8"))), *set_files(sweep)]
    if missing := [one for one in named if not (scene.parent / one).is_file()]:
        raise RunError(f"{scene.parent / missing[0]}: there is no such file.")
    version = subprocess.run([talus, "--version"], capture_output=True, text=True, check=True).stdout.split()[1]
    return SceneFiles(scene, named), version


def named_files(value):
    """The files that a scene names."""
    if isinstance(value, list):
        for one in value:
            yield from named_files(one)
    elif isinstance(value, dict):
        for key, one in value.items():
            if key in ("mesh", "file") and isinstance(one, str):
                if one:
                    yield one
            else:
                yield from named_files(one)


def set_files(sweep):
    """The files that the settings of cases name."""
    for case in cases_of(sweep):
        yield from (value for key, value in case.items() if key.rsplit(".", 1)[-1] in ("mesh", "file"))


def write_drivers(path, talus, about, count):
    """The drivers, with the names of this sweep."""
    words = {"TALUS": shlex.quote(str(talus)), "FOLDER": shlex.quote(str(path.resolve())), "NAME": shlex.quote(about["name"]), "CASES": str(count),
             "TASKS": str(min(count, ARRAY)), "THREADS": str(about["threads"]), "TALUS_WORD": repr(str(talus)), "FOLDER_WORD": repr(str(path.resolve()))}
    folder = path / "drivers"
    folder.mkdir(exist_ok=True)
    for driver in sorted(DRIVERS.iterdir()):
        text = driver.read_text(encoding="utf-8")
        for word, value in words.items():
            text = text.replace(f"@{word}@", value)
        write_whole(folder / driver.name, text)
        if text.startswith("#!"):
            (folder / driver.name).chmod(0o755)


def remove_sweep(path):
    """Takes away what a sweep wrote; other files in its folder stay."""
    for case in sorted((path / "cases").glob("*/")):
        if is_locked(case):
            raise RunError(f"{case}: the case is being run; wait until it is done, or stop it.")
    for name in OWN[1:] + (MARK,):  # the mark last: what is left half removed is still known to be a sweep
        one = path / name
        if one.is_dir() and not one.is_symlink():
            shutil.rmtree(one)
        else:
            one.unlink(missing_ok=True)
