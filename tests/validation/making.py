# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes runs of Talus, LAMMPS and LIGGGHTS where they are not there yet."""
import hashlib
import shutil
import subprocess
from pathlib import Path

from case import scene_file
from deck import DeckRun, run_deck
from read_run import Run

ROOT = Path(__file__).resolve().parents[2]


class RunFailed(Exception):
    """A run that did not come to its end; the text is one sentence."""


def checksum_of(talus, run):
    """Of the program and of all that a run is made from."""
    digest = hashlib.sha256(talus.read_bytes())
    path = Path(scene_file(run.scene))
    digest.update((path if path.suffix else ROOT / f"scenarios/{run.scene}.toml").read_bytes())
    digest.update(repr(run[1:]).encode())
    return digest.hexdigest()


def call(talus, verb, run, folder, *others):
    """Raises RunFailed."""
    settings = [word for key, value in run.settings.items() for word in ("--set", f"{key}={value}")]
    command = [talus, verb, scene_file(run.scene), "--seed", run.seed, *settings, *others, "--force", "--quiet", "-o",
               folder]
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    if done.returncode:
        raise RunFailed(f"{' '.join(map(str, command))} ended with {done.returncode}: {done.stderr[-500:]}")


def make(talus, run):
    """Makes a run in build/validation, if it is not there, and reads it.

    Raises RunFailed.
    """
    folder = ROOT / "build/validation" / run.name
    mark, checksum = folder.with_name(f"{run.name}.made_of"), checksum_of(talus, run)
    if not (mark.is_file() and mark.read_text() == checksum):
        folder.parent.mkdir(parents=True, exist_ok=True)
        if run.program:
            if run.scene.endswith(f".{run.program}"):
                shutil.rmtree(folder, ignore_errors=True)
                folder.mkdir()
                shutil.copy(scene_file(run.scene), folder / f"in.{run.program}")
                variables = dict(run.settings, seed=run.seed)
            else:
                call(talus, "export", run, folder, "--format", run.program)
                variables = {"modulus": run.modulus} if run.modulus else {}
            code = run_deck(run.program, folder, variables)
            if code:
                raise RunFailed(f"{run.program} ended with {code} in {folder}, see said.txt there.")
        else:
            call(talus, "run", run, folder, "--threads", 1)
        mark.write_text(checksum)
        print(f"{run.name} made", flush=True)
    return DeckRun(folder) if run.program else Run(folder)
