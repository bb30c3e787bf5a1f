# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies, as `talus study` makes them: what they measure, that they go on where they were, and what they refuse."""
import csv
import json
import math
import os
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

import numpy
import talus

TALUS = os.path.abspath(os.environ["TALUS"])

BED = """title = "A small bed"
[time]
duration = 0.35
[materials.glass]
[[contact]]
between = ["glass", "glass"]
[[fill]]
material = "glass"
count = 150
diameter = { distribution = "uniform", min = 0.009, max = 0.011 }
region = { shape = "box", min = [0, 0, 0], max = [0.05, 0.05, 0.25] }
[[wall]]
name = "box"
shape = "box"
max = [0.05, 0.05, 0.3]
open = ["z+"]
material = "glass"
[[sensor]]
name = "floor"
kind = "wall_force"
wall = "box"
from = 0.25
"""  # shaken down already when the studies below begin

# Two sizes in a square shaft, eight diameters wide: no scene that a study shipped with Talus has.
SHAFT = """title = "Two sizes in a shaft"
[time]
duration = 0.9
[materials.glass]
[materials.steel]
[[contact]]
between = ["glass", "glass"]
friction = 0.6
restitution = 0.3
[[contact]]
between = ["glass", "steel"]
friction = 0.4
[[fill]]
material = "glass"
count = 450
diameter = { distribution = "uniform", min = 0.007, max = 0.013 }
region = { shape = "box", min = [0, 0, 0], max = [0.08, 0.08, 0.4] }
[[wall]]
name = "shaft"
shape = "box"
max = [0.08, 0.08, 0.4]
open = ["z+"]
material = "steel"
[[sensor]]
name = "floor"
kind = "wall_force"
wall = "shaft"
from = 0.5
"""


class StudyTest(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = Path(place.name)
        self.write("bed.toml", BED)
        self.write("shaft.toml", SHAFT)

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")

    def talus(self, words, code=0):
        """What `talus` prints, and its complaints; it must end with that exit code."""
        ended = subprocess.run([TALUS, *words.split()], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(ended.returncode, code, ended.stderr)
        return ended.stdout, ended.stderr

    def rows(self):
        text = (self.folder / "study/rows.jsonl").read_text(encoding="utf-8")
        return [json.loads(line) for line in text.splitlines()]

    def table(self):
        """study.csv: numbers and words by setting and column."""
        with (self.folder / "study/study.csv").open(newline="", encoding="utf-8") as file:
            return {row["setting"]: row for row in csv.DictReader(file)}


class Findings(StudyTest):
    def test_more_sweeps_less_error_and_the_reference_is_the_dearest(self):
        # No step stops for its residual: the least number of sweeps is what it makes.
        self.write("study.toml", """start = 0.2
settle = 0.05
set = ["solver.tolerance=1.0", "solver.pressure_scaling=false"]
[[vary]]
key = "solver.stabilisation"
values = ["projected"]
[[vary]]
key = "solver.min_sweeps"
values = ["1", "6", "40"]
[[vary]]
key = "wall.box.material"
values = ["cheese"]
""")
        sweeps = [f"projected, min_sweeps={n}" for n in (1, 6, 40)]
        columns = ("velocity_error", "residual", "contact_updates_per_s")
        sums = {name: [0.0] * len(sweeps) for name in columns}
        for seed in (1, 2, 3):  # of one bed the error is as much its own as the sweeps'
            reported, _ = self.talus(f"study bed.toml --settings study.toml -o study --threads 2 --force --set seed={seed}")
            self.assertIn("For no more overlap_95 than the default's", reported)
            table = self.table()
            self.assertEqual(len(table), 7)
            for name in columns:
                sums[name] = [sum_ + float(table[setting][name]) for sum_, setting in zip(sums[name], sweeps)]
        for name, falls in zip(columns, (True, True, False)):
            self.assertEqual(sums[name], sorted(set(sums[name]), reverse=falls), name)
        for setting, row in table.items():
            if setting != "reference" and row["status"] == "done":
                self.assertLess(float(row["contact_updates_per_s"]), float(table["reference"]["contact_updates_per_s"]))
        self.assertLess(float(table["default"]["momentum_error"]), 1e-9)
        self.assertLess(float(table["default"]["floor_force_z"]), 0.01)
        self.assertIn("cheese", table["projected, material=cheese"]["status"])
        page = (self.folder / "study/study.html").read_text(encoding="utf-8")
        self.assertIn("A small bed", page)
        self.assertIn('"logUp":true', page.replace(" ", ""))

    def test_a_row_has_what_steps_made_by_hand_show(self):
        self.write("study.toml", "start = 0.2\nsettle = 0.05\nend = 0.3\nreference = ['solver.min_sweeps=10']\ncross = []\nvary = []\n")
        self.talus("study bed.toml --settings study.toml -o study --threads 1 --quiet")
        row = next(row for row in self.rows() if row["setting"] == "reference")
        found = {m["name"]: m["value"] for m in row["findings"]}
        simulation = talus.Simulation(self.folder / "bed.toml", set={"solver.min_sweeps": 10}, threads=1)
        simulation.restore((self.folder / "study/start_of_seed_1.state").read_bytes())
        simulation.run(until=0.25)
        before, began = simulation.positions(), simulation.time
        d = talus.check(self.folder / "bed.toml")["diameters"][1]
        errors, residuals, updates = [], [], 0
        for part in (1, 2, 3):
            until = 0.25 + part * (0.3 - 0.25) / 3
            state = simulation.state()
            exact = talus.Simulation(self.folder / "bed.toml", threads=1, state=state,
                                     set={"solver.min_sweeps": 10, "solver.tolerance": 1e-12, "solver.max_sweeps": 20000})
            usual = talus.Simulation(self.folder / "bed.toml", threads=1, state=state, set={"solver.min_sweeps": 10})
            exact.step(), usual.step()
            errors.append(math.sqrt(((exact.velocities() - usual.velocities()) ** 2).sum() / simulation.count))
            while simulation.time < until - 1e-3 * simulation.step_length:
                report = simulation.step()
                residuals.append(report.residual)
                updates += report.contacts * report.sweeps
        window = simulation.time - began
        creep = numpy.linalg.norm(simulation.positions() - before, axis=1)
        self.assertAlmostEqual(found["residual"] / numpy.mean(residuals), 1, places=9)
        self.assertAlmostEqual(row["contact_updates_per_s"] * window / updates, 1, places=9)
        self.assertAlmostEqual(found["velocity_error"] / (numpy.mean(errors) / math.sqrt(9.81 * d)), 1, places=6)
        self.assertTrue(creep.min() < found["creep"] * d * window < creep.max())
        median = numpy.sort(creep)[len(creep) // 2]  # of an even number Talus takes the higher one of the middle two
        self.assertAlmostEqual(found["creep"] * d * window / median, 1, places=6)
        self.assertAlmostEqual(row["profile"][0], 1, delta=0.1, msg="the walls do not carry the weight")

    def test_the_velocity_error_is_measured_without_a_trace(self):
        measured, left_alone = (talus.Simulation(self.folder / "bed.toml", threads=1) for _ in range(2))
        for simulation in (measured, left_alone):
            simulation.run(until=0.2)
        error = talus.Findings(measured).velocity_error()
        self.assertTrue(1e-12 < error < 0.1, error)
        for simulation in (measured, left_alone):
            simulation.run(until=0.22)
        for kind in ("positions", "velocities", "angular_velocities"):
            numpy.testing.assert_array_equal(getattr(measured, kind)(), getattr(left_alone, kind)())
        solved = measured.copy(set={"solver.tolerance": 1e-10, "solver.max_sweeps": 5000}, threads=1)
        self.assertLess(talus.Findings(solved).velocity_error(), 1e-3 * error)


class Accuracy(StudyTest):
    def test_what_was_asked_for_holds_in_a_scene_that_no_study_has_seen(self):
        self.write("study.toml", "start = 0.4\nsettle = 0.2\nend = 0.8\ncross = []\n[[vary]]\nkey = 'accuracy'\nvalues = ['10%', '3%', '1%']\n")
        self.talus("study shaft.toml --settings study.toml -o study --threads 2")
        table = self.table()
        def number(setting, column):
            return float(table[setting][column])
        self.assertEqual(table["accuracy=3%"]["status"], "the same run as default")
        self.assertLess(number("accuracy=10%", "contact_updates_per_s"), 0.9 * number("default", "contact_updates_per_s"))
        self.assertLess(number("accuracy=1%", "overlap_95"), 0.5 * number("default", "overlap_95"))
        for setting, promised in (("accuracy=10%", 0.10), ("default", 0.03), ("accuracy=1%", 0.01)):
            self.assertEqual(table[setting]["status"], "done")
            for error in ("velocity_error", "overlap_95", "creep", "floor_force_z"):
                self.assertLessEqual(number(setting, error), promised, f"{error} with {setting}")

    def test_the_reference_is_as_fine_whatever_the_accuracy_of_its_scene(self):
        self.write("study.toml", "start = 0\nsettle = 0\nend = 0.02\ncross = []\nvary = []\n")
        def findings(changes):
            self.talus(f"study shaft.toml --force --settings study.toml -o study {changes}")
            return {row["setting"]: row["findings"] for row in self.rows()}
        usual, coarse = findings(""), findings("--set accuracy=100%")
        self.assertEqual(usual["reference"], coarse["reference"])
        self.assertNotEqual(usual["default"], coarse["default"])


class Folder(StudyTest):
    def begin(self, words):
        process = subprocess.Popen([TALUS, *words.split()], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.wait)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.kill)
        return process

    def wait_for(self, process, is_so):
        while not is_so():
            self.assertIsNone(process.poll(), "the study is over already")
            time.sleep(0.01)

    def test_a_study_that_was_stopped_goes_on_where_it_was(self):
        self.write("study.toml", "start = 0.25\nsettle = 0\nreference = ['solver.min_sweeps=10']\ncross = []\n"
                                 "[[vary]]\nkey = 'solver.min_sweeps'\nvalues = ['3', '4', '5', '6', '7', '8']\n")
        words = "study bed.toml --settings study.toml -o study --threads 1"
        rows = self.folder / "study/rows.jsonl"
        process = self.begin(words)
        self.wait_for(process, lambda: rows.is_file() and "min_sweeps=3" in rows.read_text())
        process.send_signal(signal.SIGINT)
        told = process.communicate()[1]
        self.assertEqual(process.returncode, 130, told)
        self.assertIn("to go on: the same command again", told)
        before = rows.read_text(encoding="utf-8")
        with rows.open("a", encoding="utf-8") as file:
            file.write('{"setting": "half')  # a power cut
        self.talus(words)
        after = rows.read_text(encoding="utf-8")
        self.assertTrue(after.startswith(before))
        self.assertEqual(after.count("\n"), 8)
        self.assertLess(before.count("\n"), 8)
        whole = {row["setting"]: row["findings"] for row in self.rows()}
        self.talus(words + " --force --quiet")
        self.assertEqual(whole, {row["setting"]: row["findings"] for row in self.rows()})

    def test_a_study_owns_its_folder_and_its_processes_die_with_it(self):
        self.write("long.toml", BED.replace("duration = 0.35", "duration = 1e3"))
        process = self.begin("study long.toml -o study --threads 1")
        self.wait_for(process, lambda: (self.folder / "study/study.resolved.toml").is_file() and workers(process.pid))
        for words in ("study long.toml -o study --threads 1", "study long.toml -o study --threads 1 --force"):
            self.assertIn("study: process ", self.talus(words, code=2)[1])
        worker = workers(process.pid)[0]
        process.kill()
        process.wait()
        for _ in range(500):
            if not Path(f"/proc/{worker}").exists():
                break
            time.sleep(0.01)
        self.assertFalse(Path(f"/proc/{worker}").exists(), "a process computes on for a study that was killed")

    def test_what_a_study_cannot_be_is_refused_in_one_sentence(self):
        self.write("late.toml", "start = 5.0\n")
        self.write("good.toml", "settle = 0.05\n")
        self.write("odd.toml", "[[vary]]\nkey = \"a\"\nvalue = 3\n")
        self.write("mine", "ten years of work")
        (self.folder / "full").mkdir()
        self.write("full/thesis.tex", "years")
        for words, sentence in (
                ("--settings late.toml", "talus study: the study must end after 5.2 s, when its settings have settled, not at 0.35 s\n"),
                ("--settings odd.toml", "talus study: odd.toml:3: unknown key 'value' in [vary]; allowed are key, values.\n"),
                ("--settings none.toml", "talus study: none.toml: there is no such file.\n"),
                ("--settings good.toml -o full", "talus study: full: the folder is not empty and holds no study\n"),
                ("--settings good.toml -o mine", "talus study: mine: is a file, not a folder for a study\n"),
                ("--set wall.box.material=cheese", "")):
            told = self.talus(f"study bed.toml {words}", code=2)[1]
            self.assertEqual(told.count("\n"), 1, told)
            self.assertTrue(not sentence or told == sentence, told)
        self.assertEqual((self.folder / "full/thesis.tex").read_text(), "years")
        self.assertFalse((self.folder / "out").exists())

    def test_one_of_a_scene_that_was_edited_is_another_and_force_replaces_it_and_nothing_else(self):
        self.write("study.toml", "settle = 0.05\nreference = [\"solver.min_sweeps=10\"]\nvary = []\n")
        words = "study bed.toml --settings study.toml -o study --quiet"
        self.talus(words)
        self.write("study/thesis.tex", "years")
        self.talus(words)  # nothing to do
        self.write("bed.toml", BED.replace("[materials.glass]", "[materials.glass]\ndensity = 2600.0"))
        self.assertEqual(self.talus(words, code=2)[1],
                         "talus study: study: the folder holds another study, or one of the scene as it was; --force replaces it\n")
        self.talus(words + " --force")
        self.assertEqual((self.folder / "study/thesis.tex").read_text(), "years")
        self.assertEqual(len(self.rows()), 2)

    def test_without_the_module_it_says_what_to_install(self):
        script = Path(__file__).resolve().parents[2] / "postprocess/study.py"
        environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
        ended = subprocess.run(["/usr/bin/python3", script, "--talus", self.folder / "nowhere/talus", "bed.toml"], cwd=self.folder, capture_output=True,
                               text=True, env=environment)
        if ended.returncode == 0:
            self.skipTest("the module is installed on this machine")
        self.assertEqual(ended.returncode, 2)
        self.assertIn("apt install python3-talus", ended.stderr)
        self.assertEqual(ended.stderr.count("\n"), 1)

    def test_its_keys_are_listed(self):
        self.assertIn("  settle                 a number of at least 0 [s]; default 0.2\n", self.talus("keys study")[0])


def workers(study):
    """The processes that a study has begun."""
    children = Path(f"/proc/{study}/task/{study}/children")
    return children.read_text().split() if children.exists() else []


if __name__ == "__main__":
    unittest.main()
