#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts bugs into a copy of Talus, one at a time, and says which test sees each.

    tests/mutants/run.py [WORD…]        with words only the mutants whose name has one of them

The copy lies in build/mutants and is built like the default tests; a mutant takes some minutes, one in a script, which
needs no build, about one. mutants.toml lists the bugs: a file, a text that stands there once, and what is put in its
place. What comes out is written to tests/results/mutants.md after each; rows of mutants that are not asked for stay
there as they are. Without words, those that were put into this very commit are left out: a run that was broken off goes
on where it was.

Exit codes: 0 every mutant was seen, 1 one was not, 2 there is nothing to learn: a text is not there once, something
cannot be built, or a test fails without any mutant.
"""
import datetime
import html
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
COPY = ROOT / "build" / "mutants"
PAGE = ROOT / "tests" / "results" / "mutants.md"
TESTS = ["core", "physics", "scenarios", "io", "app", "validation"]
OF_SCRIPTS = ["validation_analysis", "references", "gate_verdicts", "plot", "render_run", "render", "export", "paraview", "report_run",
              "report", "viewer", "sweep", "sweep_parallel", "calibration", "sweep_page", "python", "notebook", "decks", "site"]


def give_up(sentence):
    print(f"run.py: {sentence}", file=sys.stderr)
    sys.exit(2)


def git(*arguments):
    return subprocess.run(["git", *arguments], cwd=ROOT, check=True, capture_output=True, text=True).stdout.strip()


def prepare():
    """Brings the copy up to date; files that are the same stay untouched, and are not built again."""
    listed = git("ls-files", "--cached", "--others", "--exclude-standard").split("\n")
    for name in listed:
        source, copy = ROOT / name, COPY / name
        if source.is_file() and not (copy.is_file() and copy.read_bytes() == source.read_bytes()):
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source, copy)
    for copy in COPY.rglob("*"):
        name = copy.relative_to(COPY)
        if copy.is_file() and name.parts[0] != "build" and not (ROOT / name).is_file():
            copy.unlink()
    subprocess.run(["cmake", "-S", COPY, "-B", COPY / "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release"], check=True,
                   stdout=subprocess.DEVNULL)


def first_failure(test, which):
    """The name of the first test case that fails, or nothing. One that uses up an hour of CPU time has failed too."""
    environment = dict(os.environ, GOMP_SPINCOUNT="2000")  # as ctest does
    output = subprocess.run(["prlimit", "--cpu=3600:3660", COPY / "build" / f"test_{test}", which, "--abort", "-r", "xml"],
                            env=environment, capture_output=True, text=True, errors="replace")
    if output.returncode == 0:
        return None
    begun = re.findall(r'<TestCase name="([^"]*)"', output.stdout)
    return html.unescape(begun[-1]) if begun else "before any test"


def killer(room):
    """The program and the name of the first test that fails, beginning with the tests of the room; or nothing.

    A test that fails must fail again alone: on a busy machine one may fail for lack of time.
    """
    for test in sorted(TESTS, key=lambda name: name != room):
        build(f"test_{test}")
        for _ in range(3):
            name = first_failure(test, "~[slow]")
            if name is None:
                break
            if first_failure(test, re.sub(r"([,\[\\])", r"\\\1", name)):
                return f"`{test}`: {name}"
    return None


def build(*targets):
    built = subprocess.run(["ninja", "-C", COPY / "build", "-j", str(os.cpu_count()), *targets], capture_output=True, text=True)
    if built.returncode != 0:
        give_up(f"it cannot be built:\n{built.stdout[-3000:]}")


def failing_script_test():
    """The first test of scripts that fails, or nothing."""
    names = "|".join(OF_SCRIPTS)
    output = subprocess.run(["ctest", "--test-dir", COPY / "build", "-R", f"^({names})$", "--stop-on-failure", "-j", "2"],
                            capture_output=True, text=True, errors="replace")
    if output.returncode == 0:
        return None
    failed = re.findall(r"Test +#\d+: (\w+) \.*\*+Failed", output.stdout)
    return f"ctest: {failed[0]}" if failed else give_up(output.stdout[-2000:])


def write_page(mutants, rows):
    text = PAGE.read_text()
    begin, end = "<!-- mutants begin -->\n", "<!-- mutants end -->"
    head, rest = text.split(begin)
    kept = {line.split(" | ")[0][2:]: line for line in rest.split("\n") if line.startswith("| ")}
    table = [kept["mutant"], kept["---"]]
    for mutant in mutants:
        if line := rows.get(mutant["name"], kept.get(mutant["name"])):
            table.append(line)
    PAGE.write_text(head + begin + "\n".join(table) + "\n" + rest[rest.index(end):])


def is_script(file):
    return not file.endswith((".cpp", ".hpp"))


def is_asked_for(name, words, commit):
    if words:
        return any(word in name for word in words)
    return not any(line.startswith(f"| {name} |") and f"| {commit} |" in line and "SURVIVES" not in line
                   for line in PAGE.read_text().split("\n"))


def main():
    mutants = tomllib.loads((pathlib.Path(__file__).parent / "mutants.toml").read_text())["mutant"]
    words = sys.argv[1:]
    changed = git("status", "--porcelain", "--", ".", ":!tests/results")
    commit = git("rev-parse", "--short", "HEAD") + ("+" if changed else "")
    prepare()
    for mutant in mutants:
        count = (COPY / mutant["file"]).read_text().count(mutant["old"])
        if count != 1:
            give_up(f"{mutant['name']}: its text stands {count} times in {mutant['file']}")
    asked = [mutant for mutant in mutants if is_asked_for(mutant["name"], words, commit)]
    in_script = [mutant["name"] for mutant in asked if is_script(mutant["file"])]
    if in_script:
        build("talus", "talus_python")
    if failing := (failing_script_test() if in_script else None) or (killer("core") if len(in_script) < len(asked) else None):
        give_up(f"without any mutant a test fails: {failing}")

    rows = {}
    for mutant in asked:
        name, path = mutant["name"], COPY / mutant["file"]
        text = path.read_text()
        path.write_text(text.replace(mutant["old"], mutant["new"]))
        seen = failing_script_test() if name in in_script else killer(mutant["file"].split("/")[0])
        path.write_text(text)
        print(f"{name}: {seen or 'SURVIVES'}", flush=True)
        rows[name] = f"| {name} | {seen or 'SURVIVES'} | {commit} | {datetime.date.today().isoformat()} |"
        write_page(mutants, rows)
    sys.exit(any("SURVIVES" in row for row in rows.values()))


if __name__ == "__main__":
    main()
