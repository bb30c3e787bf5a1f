#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures the rows of tests/RESULTS.md, each by the command that it names, and writes that page.

    tests/results/write.py                 all rows; see --list for how long they take
    tests/results/write.py pile drum       those with one of these words in their name
    tests/results/write.py --list          the rows, their commands, and about how long each takes
    tests/results/write.py --page          only writes the pages again, from results.json

The rows are in rows.py. Their figures are kept in results.json, each with the commit, the date and the command that it
was measured with. Rows that are not asked for, or whose command fails, keep what they have. Runs go to build/results.

Exit codes: 0 done; 1 a command failed or did not say what was looked for; 2 the call is wrong.
"""
import argparse
import datetime
import json
import os
import re
import shlex
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from rows import ROOT, ROWS, TABLES, ResultsError, Row, Run, Table

STORE = ROOT / "tests/results/results.json"
PAGE = ROOT / "tests/RESULTS.md"
SOURCES = ["core", "scenarios", "io", "app", ":!*.md"]


class Programs:
    """Runs commands, each only once."""

    def __init__(self, talus):
        self.talus = talus
        self.done = {}

    def argv(self, command, folder):
        """A command of this page, as it is run: with the programs that are asked for, and its output out of the way."""
        program, *rest = shlex.split(command)
        if program.endswith(".py"):
            return [sys.executable, ROOT / program, *rest, "--talus", self.talus]
        if program == "tests/run":
            return [ROOT / program, *rest]
        argv = [self.talus.parent / Path(program).name, *rest]
        if (program, rest[0]) == ("build/talus", "run"):
            argv += ["-o", folder, "--force", "--quiet"]
        if Path(program).name.startswith("test_"):
            argv += ["-r", "compact"]  # else lines are broken, in numbers too
        if not Path(argv[0]).exists():
            raise ResultsError(f"{argv[0]} is not there; build it with cmake --build build --target {argv[0].name}")
        return argv

    def __call__(self, name, command):
        if command not in self.done:
            self.done[command] = self.run(name, command)
        return self.done[command]

    def run(self, name, command):
        folder = ROOT / "build/results" / name
        folder.parent.mkdir(parents=True, exist_ok=True)
        argv = self.argv(command, folder)
        environment = dict(os.environ, GOMP_SPINCOUNT="2000")  # idle threads leave the processor to others
        environment.pop("OMP_NUM_THREADS", None)
        began = datetime.datetime.now()
        with tempfile.TemporaryFile("w+", encoding="utf-8") as output:
            process = subprocess.Popen(list(map(str, argv)), stdout=output, stderr=output, cwd=ROOT, env=environment)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            output.seek(0)
            printed = output.read()
        if process.returncode:
            raise ResultsError(f"{command} ended with {process.returncode}: {printed[-500:]}")
        seconds = (datetime.datetime.now() - began).total_seconds()
        return Run(printed, folder, seconds, 1024.0 * usage.ru_maxrss)


def measure(row, programs):
    """The figures of a row, and the seconds that its runs took."""
    if not row.seeds:
        run = programs(row.name, row.command)
        return {name: read(run) for name, read in row.figures.items()}, run.seconds
    runs = [programs(f"{row.name}_{seed}", f"{row.command} --set seed={seed}") for seed in row.seeds]
    figures = {}
    for name, read in row.figures.items():
        values = [read(run) for run in runs]
        figures[name] = statistics.mean(values)
        figures[name + "_error"] = statistics.stdev(values) / len(values) ** 0.5
        figures[name + "_of_seeds"] = values
    return figures, sum(run.seconds for run in runs)


def git(*arguments):
    return subprocess.run(["git", *arguments], cwd=ROOT, capture_output=True, text=True, check=True).stdout.strip()


def commit_of(talus):
    """The commit that the programs are of: this one, with a + where sources have changed since."""
    newest = int(git("log", "-1", "--format=%ct", "--", *SOURCES))
    if talus.stat().st_mtime < newest:
        raise ResultsError(f"{talus} is older than the sources: build it, or name its commit with --commit")
    changed = git("status", "--porcelain", "--", *SOURCES)
    return git("rev-parse", "--short", "HEAD") + ("+" if changed else "")


def machine():
    """Processors that this process may use, and their name."""
    names = re.findall(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text())
    return f"{len(os.sched_getaffinity(0))} × {names[0] if names else 'an unknown processor'}"


def measure_all(rows, tables, talus, commit, store):
    """Returns how many failed. The store is written after every row, so that little is lost when this is broken off."""
    programs, failed = Programs(talus), 0
    for item in [*rows, *tables]:
        print(f"{item.name}: {item.command}", flush=True)
        try:
            if isinstance(item, Row):
                figures, seconds = measure(item, programs)
                told = item.shown.format(**figures)
            else:
                for command in item.before:
                    programs(item.name, command)
                run = programs(item.name, item.command)
                rows = [line for line in run.text.splitlines() if line.startswith("|")]
                if len(rows) < 3:
                    raise ResultsError(f"{item.command} printed no table: {run.text[-500:]}")
                figures, seconds, told = {"table": "\n".join(rows)}, run.seconds, "done"
        except (ResultsError, OSError, KeyError, TypeError, ValueError, StopIteration) as error:
            print(f"  failed: {error}", flush=True)
            failed += 1
            continue
        command = item.command + (" --set seed=N" if getattr(item, "seeds", ()) else "")
        store[item.name] = {"figures": figures, "command": command, "commit": commit, "machine": machine(),
                            "date": datetime.date.today().isoformat(), "seconds": round(seconds, 1)}
        text = json.dumps(dict(sorted(store.items())), indent=1, ensure_ascii=False)
        STORE.write_text(text + "\n", encoding="utf-8")
        print(f"  {told}", flush=True)
    return failed


HEAD = """# Results

This page is written by `tests/results/write.py` from `tests/results/results.json`; nothing on it is typed by hand.
`tests/results/write.py WORD` measures the rows with that word in their name again. Figures are from `summary.json` and
`metrics.csv` of a run, or from what a test prints. ± is a standard error: of the sensor over time, or over the seeds
where a row says so. d is the mean diameter. Scenes have the automatic step and the standard tolerance.

What only holds or fails is checked by tests and has no row here: the same bits for any number of threads, the kernel's
velocities against those of the general solver, the convergence rate of a column. More results: [hard
cases](results/hard_cases.md), [local solves](results/local_solves.md), [Siconos](results/siconos.md), [LAMMPS and
LIGGGHTS on the same axes](studies/README.md#other-codes-on-the-same-axes)."""


def page(store):
    lines = [HEAD]
    for section in dict.fromkeys(row.section for row in ROWS):
        lines += ["", f"## {section}", "", "| row | what | Talus | to compare with |", "| --- | --- | --- | --- |"]
        for row in (row for row in ROWS if row.section == section):
            shown, reference = "not measured yet", re.sub(r": \{\w+:[^}]*\}", "", row.reference)
            if row.name in store:
                figures = store[row.name]["figures"]
                try:
                    shown, reference = row.shown.format(**figures), row.reference.format(**figures)
                except KeyError:
                    shown = "to be measured again"
            lines.append(f"| {row.name} | {row.what} | {shown} | {reference} |".replace("|  |", "| |"))
    measured = [item for item in [*ROWS, *TABLES] if item.name in store]
    lines += ["", "## Runs", "", "| row | command | commit | date | seconds |", "| --- | --- | --- | --- | ---: |"]
    for item in measured:
        run = store[item.name]
        seconds = f"{run['seconds']:.0f}" if run["seconds"] else ""  # not noted by every earlier run
        lines.append(f"| {item.name} | `{run['command']}` | {run['commit']} | {run['date']} | {seconds} |")
    lines += ["", "Seconds were taken on shared machines:", ""]
    for name in sorted({store[item.name]["machine"] for item in measured}):
        lines.append(f"- {name}: " + ", ".join(item.name for item in measured if store[item.name]["machine"] == name))
    return "\n".join(lines) + "\n"


def write_pages(store):
    PAGE.write_text(page(store), encoding="utf-8")
    for table in TABLES:
        if table.name not in store:
            continue
        run = store[table.name]
        told = f"Measured by `{run['command']}` at commit {run['commit']} on {run['date']}."
        text = table.page.read_text(encoding="utf-8")
        begin, end = f"<!-- {table.name} begin -->\n", f"<!-- {table.name} end -->"
        head, rest = text.split(begin)
        now = f"{head}{begin}{run['figures']['table']}\n\n{told}\n{rest[rest.index(end):]}"
        table.page.write_text(now, encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("words", nargs="*", metavar="WORD")
    parser.add_argument("--talus", type=Path, default=ROOT / "build/talus", metavar="PROGRAM",
                        help="the programs of tests are taken from its folder [build/talus]")
    parser.add_argument("--commit", help="what the programs were built from [the present one]")
    parser.add_argument("--list", action="store_true", help="names the rows and runs nothing")
    parser.add_argument("--page", action="store_true", help="writes the pages and runs nothing")
    arguments = parser.parse_args()

    items = [item for item in [*ROWS, *TABLES] if not arguments.words or any(w in item.name for w in arguments.words)]
    if not items:
        parser.error("no row has one of these words in its name; see --list")
    if arguments.list:
        for item in items:
            print(f"{item.name:22} {item.minutes:4.1f} min  {item.command}")
        print(f"{'all':22} {sum(item.minutes for item in items):4.1f} min")
        return 0
    store = json.loads(STORE.read_text(encoding="utf-8")) if STORE.exists() else {}
    failed = 0
    if not arguments.page:
        talus = arguments.talus.resolve()
        if not talus.exists():
            parser.error(f"{arguments.talus} is not there; tests/run builds it")
        try:
            commit = arguments.commit or commit_of(talus)
        except ResultsError as error:
            parser.error(str(error))
        failed = measure_all([item for item in items if isinstance(item, Row)],
                             [item for item in items if isinstance(item, Table)], talus, commit, store)
    write_pages(store)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
