#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks sweeps: their cases, the pool, what is gathered, and that whatever is killed, the same bytes come out.

    tests/sweeps/check_sweep.py TALUS [--kills N]

Exit codes: 0 all is well, 1 it is not.
"""
import argparse
import contextlib
import csv
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from small_sweep import DONE, FAILED, SWEEP, call, expanded, gathered, local_run, processes_of, write_sweep

from sweeps.design import cases_of
from sweeps.request import read_sweep
from sweeps.results import state_of
from sweeps.setting_text import setting_text

HEAD = 'scene = "hopper"\n'


def rows_of(path):
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def check_designs(folder):
    """Grid, list, Latin hypercube, Sobol and seeds give the cases that they should."""
    def cases(text):
        return cases_of(read_sweep(write_sweep(folder, HEAD + text)))

    grid = cases("seeds = 2\n[vary]\na.x = [1, 2]\na.y = { from = 1, to = 100, steps = 3, scale = 'log' }\n")
    assert [(one["a.x"], one["a.y"], one["seed"]) for one in grid] == [(x, y, seed) for x in (1, 2) for y in (1.0, 10.0, 100.0) for seed in (1, 2)], grid
    listed = cases("seeds = [7]\n[design]\nkind = 'list'\n[vary]\na.x = [1, 2]\na.y = ['u', 'v']\n")
    assert listed == [{"a.x": 1, "a.y": "u", "seed": 7}, {"a.x": 2, "a.y": "v", "seed": 7}], listed
    for kind in ("latin-hypercube", "sobol"):
        sampled = "[design]\nkind = '{}'\nsamples = {}\n[vary]\na.x = {{ from = 2, to = 4 }}\na.n = {{ from = 10, to = 20, whole = true }}\na.w = ['u', 'v']\n"
        many = cases(sampled.format(kind, 16))
        assert len(many) == 32 and {one["a.w"] for one in many} == {"u", "v"}
        xs = sorted(one["a.x"] for one in many[::2])
        assert all(2 + k / 8 <= x < 2 + (k + 1) / 8 for k, x in enumerate(xs)), f"{kind} does not have one in each of 16 parts: {xs}"
        assert all(isinstance(one["a.n"], int) and 10 <= one["a.n"] <= 20 for one in many)
        if kind == "sobol":
            assert cases(sampled.format(kind, 8)) == many[:16], "a longer sequence does not begin with the shorter"


def check_texts(talus, folder):
    """Values come to the program as they were: it prints them again."""
    values = {"title": "a \"title\", with\\ commas", "solver.tolerance": 1e-05, "world.gravity": [0, 0, -9.81], "world.rotation": False, "fill.0.count": 3}
    words = [word for key, value in values.items() for word in ("--set", f"{key}={setting_text(value)}")]
    told = call(talus, "check", "hopper", "--resolved", *words, cwd=folder)
    for line in ('title = "a \\"title\\", with\\\\ commas"', "tolerance = 1e-05", "gravity = [0.0, 0.0, -9.81]", "rotation = false", "count = 3"):
        assert line in told, f"{line} is not in {told}"


def check_complaints(talus, folder):
    """What is wrong is reported in one sentence, and nothing is made."""
    for text, sentence in (
            ("[vary]\na.b = 3\n", f".toml:{HEAD.count(chr(10)) + 2}: 'a.b' must be a list of values or a range"),
            ("[vary]\na.b = { from = 1, to = 2 }\n", "needs 'steps'"),
            ("[vary]\na.b = { from = 2, to = 1, steps = 3 }\n", "from a smaller number to a larger one"),
            ("[vary]\na.b = [1]\n[design]\nkind = 'sobol'\n", "needs a key with a range"),
            ("[vary]\na.b = [1]\na.c = [1, 2]\n[design]\nkind = 'list'\n", "equally long"),
            ("[vary]\na.b = [1]\n[design]\nkinds = 'list'\n", "unknown key 'kinds' in [design]"),
            ("", "nothing varies"), ("seeds = [1, 1]\n", "different whole numbers"),
            ("seeds = 1000000000000\n", "up to 100000"),
            ("seeds = 3\n[vary]\na.b = { from = 1, to = 2, steps = 300 }\na.c = { from = 1, to = 2, steps = 300 }\n", "has 270000 cases; 100000 are allowed"), ("[vary\n", "is no TOML"),
            ("[vary]\ncontact.glass-glass.fricton = [0.1]\n", "did you mean 'friction'")):
        told = call(talus, "sweep", write_sweep(folder, HEAD + text), code=2, cwd=folder)
        assert sentence in told and told.count("\n") == 1, f"instead of '{sentence}': {told}"
    assert not (folder / "out").exists()
    occupied = folder / "occupied"
    occupied.mkdir()
    (occupied / "notes.txt").write_text("mine")
    assert "holds no sweep" in call(talus, "sweep", write_sweep(folder), "--out", occupied, "--force", code=2)
    assert "holds no sweep" in call(talus, "gather", occupied, code=2)
    assert "holds no sweep" in call(talus, "run", occupied, "--case", 1, code=2)
    call(talus, "run", occupied, "--case", 1, "--seed", 2, code=2)


def check_results(talus, folder):
    """Every case has its row: results with units, and why it failed."""
    wanted = local_run(talus, folder)
    rows = rows_of(folder / "local/results.csv")
    assert [row["status"] for row in rows].count("done") == DONE and len(rows) == DONE + FAILED
    for row in rows:
        if row["status"] == "done":
            assert float(row["outlet_mass_flow_kg_per_s"]) > 0 and float(row["simulated_time_s"]) >= 0.6 and float(row["error_mean_residual"]) > 0
        elif row["contact.glass-glass.friction"] == "-1":
            assert row["reason"].startswith("--set contact.glass-glass.friction=-1: "), row
        else:
            assert "left the world where there is no outlet" in row["reason"] and not row["outlet_mass_flow_kg_per_s"], row
    assert len({row["error_mean_residual"] for row in rows if row["status"] == "done"}) == DONE, "two cases are the same run"
    assert str(folder).encode() not in wanted, "the results name the folder that they were made in"
    costs = rows_of(folder / "local/costs.csv")
    assert not set(costs[0]) & set(rows[0]) - {"case"} and float(costs[0]["cpu_s"]) > 0, "what differs from run to run is among the results"
    page = (folder / "local/sweep.html").read_text(encoding="utf-8")
    assert "Sixty beads" in page and page.count("<tr data-case=") == DONE + FAILED
    return wanted


def check_cases(talus, folder):
    """A case that is settled stays as it is; one whose settings were changed is not mixed with what is there."""
    path = folder / "local"
    before = {one: one.stat().st_mtime_ns for one in sorted(path.rglob("summary.json"))}
    for case in (1, 7, 10):
        call(talus, "run", path, "--case", case, "--quiet")
    assert before == {one: one.stat().st_mtime_ns for one in sorted(path.rglob("summary.json"))}, "a case that was settled was run again"
    assert "no case 13 among its 12" in call(talus, "run", path, "--case", 13, code=2)
    other = expanded(talus, folder, "changed")
    call(talus, "run", other, "--case", 1, "--quiet")
    cases = (other / "cases.csv").read_text()
    (other / "cases.csv").write_text(cases.replace("1,60,", "1,61,", 1))
    assert "other settings" in call(talus, "run", other, "--case", 1, "--quiet", code=2)
    assert "1 of these left out, the first case 1" in call(talus, "gather", other)
    call(talus, "run", other, "--case", 1, "--quiet", "--force")
    assert "left out" not in call(talus, "gather", other)
    scene = next((other / "scene").glob("*.toml"))
    text = scene.read_text()
    scene.write_text(text + "# a word more\n")
    assert "not what it was when the sweep was made" in call(talus, "run", other, "--case", 2, "--quiet", code=2)
    scene.write_text(text)
    pair = [subprocess.Popen([talus, "run", other, "--case", "2", "--quiet"], stderr=subprocess.DEVNULL) for _ in range(2)]
    assert [one.wait() for one in pair] == [0, 0], "two that run the same case at once do not both end well"


def check_growth(talus, folder, wanted):
    """A sweep takes new cases at its end, and no others; what is not asked for any more, or another scene, is refused."""
    path = expanded(talus, folder, "grown", SWEEP.replace("seeds = 3", "seeds = 1"))
    few = (path / "cases.csv").read_text()
    expanded(talus, folder, "grown")
    assert (path / "cases.csv").read_text().startswith(few)
    told = call(talus, "sweep", write_sweep(folder, SWEEP.replace("0.5]", "0.6]")), "--out", path, code=2)
    assert "no longer asked for" in told, told
    call(talus, "sweep", write_sweep(folder, SWEEP.replace("0.5]", "0.6]")), "--out", path, "--force", "--quiet")
    scene = folder / "own.toml"
    call(talus, "new", scene, "--from", "hopper")
    text = SWEEP.replace('"hopper"', '"own.toml"')
    own = expanded(talus, folder, "own", text)
    scene.write_text(scene.read_text().replace("2500", "2600"))
    call(talus, "sweep", write_sweep(folder, text), "--out", own, code=2)
    scene.unlink()  # the sweep has its own copy
    call(talus, "run", own, "--case", 1, "--quiet")
    assert gathered(talus, own).splitlines()[1] == wanted.splitlines()[1]


def settled(path):
    """How many cases of a sweep have a result."""
    return sum(state_of(folder)[0] != "unfinished" for folder in path.glob("cases/*"))


def kill(number, victim):
    with contextlib.suppress(ProcessLookupError):
        os.kill(victim, number)


def check_kills(talus, folder, wanted, kills, seed):
    """Whatever is killed, and however often, the same command goes on to the same bytes."""
    chance = random.Random(seed)
    path, file = folder / "killed", write_sweep(folder)
    for k in range(kills):
        goal = settled(path) + chance.randrange(3)
        pool = subprocess.Popen([talus, "sweep", file, "--out", path, "--jobs", "2", "--quiet"], stderr=subprocess.DEVNULL)
        while pool.poll() is None and (settled(path) < goal or not any(path.glob("cases/*/talus.lock"))):
            time.sleep(0.01)
        time.sleep(chance.uniform(0, 0.4))
        victims = processes_of(path)
        chance.shuffle(victims)
        how = chance.choice([signal.SIGKILL, signal.SIGKILL, signal.SIGTERM])
        for victim in victims[:chance.randint(1, 3)]:
            kill(how, victim)
        if chance.random() < 0.7:
            kill(signal.SIGKILL, pool.pid)
        pool.wait()
        print(f"kill {k + 1} of {kills}, by {how.name}: {settled(path)} of {DONE + FAILED} cases settled, "
              f"{len(list(path.glob('cases/*/checkpoint.latest')))} have a checkpoint", flush=True)
        if settled(path) == DONE + FAILED:
            call(talus, "sweep", file, "--out", path, "--force", "--quiet")  # once more from the beginning
    call(talus, "sweep", file, "--out", path, "--jobs", 2, "--quiet")
    assert (path / "results.csv").read_bytes() == wanted, f"after kills with seed {seed} the results have other bytes"


def check_interrupt(talus, folder, wanted):
    """Ctrl-C stops the cases after checkpoints, and says how to go on."""
    path, file = folder / "stopped", write_sweep(folder)
    pool = subprocess.Popen([talus, "sweep", file, "--out", path, "--jobs", "2"], stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)
    while not any(path.glob("cases/*/checkpoint.latest")):
        time.sleep(0.02)
    pool.send_signal(signal.SIGINT)
    told = pool.communicate()[1]
    assert pool.returncode in (130, 0), f"{pool.returncode}: {told}"
    assert pool.returncode == 0 or "the same command goes on" in told
    assert not processes_of(path), "cases outlive their pool"
    call(talus, "sweep", file, "--out", path, "--jobs", 1, "--quiet")
    assert (path / "results.csv").read_bytes() == wanted


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("talus", type=Path)
    parser.add_argument("--kills", type=int, default=4)
    parser.add_argument("--seed", type=int, default=random.SystemRandom().randrange(10**6), help="of the kills")
    arguments = parser.parse_args()
    talus = arguments.talus.resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        check_designs(folder)
        check_texts(talus, folder)
        check_complaints(talus, folder)
        wanted = check_results(talus, folder)
        check_cases(talus, folder)
        check_growth(talus, folder, wanted)
        check_interrupt(talus, folder, wanted)
        check_kills(talus, folder, wanted, arguments.kills, arguments.seed)


if __name__ == "__main__":
    main()
