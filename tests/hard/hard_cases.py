# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs single hard cases and reads what they found."""
import hashlib
import os
import pathlib
import subprocess


def case_names(program):
    # Catch2 returns the number of tests as exit code.
    listing = subprocess.run([program, "--list-test-names-only"], capture_output=True, text=True).stdout
    return [line.strip() for line in listing.splitlines() if line.strip()]


def checksum_of(program):
    """Of the program, of the one that some cases run, and of all scenes and meshes that cases read."""
    root = pathlib.Path(__file__).resolve().parents[2]
    folders = [root / "scenarios", root / "tests/hard/scenes", root / "tests/validation/scenes"]
    scenes = [path for folder in folders for path in sorted(folder.iterdir()) if path.suffix in {".toml", ".stl", ".vtu"}]
    digest = hashlib.sha256()
    for path in [program, program.resolve().parent / "talus", *scenes]:
        digest.update(path.read_bytes())
    return digest.hexdigest()


def run_case(program, results, name, checksum):
    """The rows of one case, and whether it was run now."""
    table, mark = results / f"{name}.tsv", results / f"{name}.program"
    if table.exists() and mark.exists() and mark.read_text() == checksum:
        return rows_of(table), False
    table.unlink(missing_ok=True)
    # Idle threads must not spin: the case that runs 16 would keep the processors from all others.
    environment = dict(os.environ, TALUS_HARD_RESULTS=str(results), OMP_NUM_THREADS="1", GOMP_SPINCOUNT="2000")
    with open(results / f"{name}.log", "w") as log:
        done = subprocess.run([program, name.replace(",", "\\,").replace("[", "\\[")], env=environment, stdout=log,
                              stderr=subprocess.STDOUT)
    rows = rows_of(table) if table.exists() else []
    if not rows:
        rows.append([name, "has results", f"exit code {done.returncode}", "FAILED", "0"])
    if done.returncode and all(row[3] != "FAILED" for row in rows):
        rows.append([name, "comes to its end", f"exit code {done.returncode}", "FAILED", "0"])
    else:
        mark.write_text(checksum)
    return rows, True


def rows_of(table):
    return [line.split("\t") for line in table.read_text().splitlines()]
