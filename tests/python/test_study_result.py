# SPDX-License-Identifier: GPL-3.0-or-later
"""What a study makes of its rows, of the keys of its file, and of processes that crash."""
import math
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "postprocess"))
import study as script
from read_run import RunError
from studies.folder import Rows, read_row, row_text
from studies.page import study_page
from studies.request import VARY, read_study, resolved_study, settings_of
from studies.result import advice, compare, front, study_csv
from sweeps.pool import run_processes


def row(setting, cpu, overlap, height, flow, spread=0.0, seed=1, profile=(1.0, 0.5), status="done", more=()):
    found = [("overlap_95", overlap, 0.0, "d"), ("height", height, 0.0, "d"), ("outlet mass_flow", flow, spread, "kg/s"), *more]
    return {"setting": setting, "seed": seed, "status": status, "cpu_s_per_s": cpu, "contact_updates_per_s": 0.0, "memory_B": 0.0,
            "findings": [dict(zip(("name", "value", "spread", "unit"), one)) for one in found], "profile": list(profile)}


def reference(**changes):
    return row("reference", 100.0, 1e-6, 8.0, 2.0, **changes)


FOUR = ["reference", "default", "fast", "slow"]


def error(result, point, name):
    return result.points[point].errors[[kind.name for kind in result.kinds].index(name)]


class Result(unittest.TestCase):
    def test_a_row_reads_back_with_what_is_not_a_number_in_it(self):
        made = row("projected, tolerance=fine", 2.5, 1e-4, 8.0, 1.25, math.nan, seed=7, status='t = 1 s: a "sentence"\nwith a line break')
        text = row_text(made)
        self.assertNotIn("\n", text)
        read = read_row(text)
        self.assertTrue(math.isnan(read["findings"][2].pop("spread")))
        made["findings"][2].pop("spread")
        self.assertEqual(read, made)
        for line in ("{}", "half a li"):
            self.assertRaises(RunError, read_row, line)

    def test_a_last_line_that_was_cut_off_does_not_count(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "rows.jsonl"
            whole = row_text(reference()) + "\n"
            path.write_text(whole + '{"setting": "half', encoding="utf-8")
            self.assertEqual(len(Rows(folder).all), 1)
            self.assertEqual(path.read_text(encoding="utf-8"), whole)
            path.write_text("{}\n" + whole, encoding="utf-8")
            with self.assertRaisesRegex(RunError, "rows.jsonl:1: not a row"):
                Rows(folder)

    def test_what_a_run_tells_of_itself_is_its_error_the_rest_is_compared(self):
        result = compare(FOUR, [reference(spread=0.04), row("default", 2.0, 1e-4, 8.0, 2.0), row("fast", 1.0, 3e-4, 7.5, 1.9, 0.03, profile=(0.9, 0.7))])
        self.assertEqual(error(result, 2, "overlap_95").value, 3e-4)
        self.assertEqual(error(result, 2, "height").value, 0.5)
        self.assertAlmostEqual(error(result, 2, "outlet mass_flow").value, 0.05)
        self.assertAlmostEqual(error(result, 2, "outlet mass_flow").spread, 0.025)
        self.assertAlmostEqual(error(result, 2, "force_profile").value, 0.2)
        self.assertEqual(error(result, 0, "height").value, 0.0)
        self.assertTrue(math.isnan(error(result, 2, "creep").value))
        self.assertEqual(result.points[3].status, "not run, or without a reference")

    def test_differences_are_averaged_over_seeds_before_their_sign_is_dropped(self):
        rows = [row(name, 1.0, 1e-4, 8.0 if name == "reference" else 8.1 if seed % 2 else 7.9, 1.0, seed=seed)
                for seed in range(1, 5) for name in ("reference", "default")]
        height = error(compare(["reference", "default"], rows), 1, "height")
        self.assertAlmostEqual(height.value, 0.0)
        self.assertAlmostEqual(height.spread, 0.1 * 2 / math.sqrt(3) / 2)  # s/√4 of ±0.1

    def test_one_seed_that_fails_makes_the_setting_fail_with_its_sentence(self):
        rows = [reference(), row("default", 2.0, 1e-4, 8.0, 2.0), row("fast", 1.0, 1e-3, 8.0, 2.0),
                row("fast", 1.0, 1e-3, 8.0, 2.0, seed=2, status="sphere 3 left the world")]
        result = compare(FOUR, rows)
        self.assertEqual(result.points[2].status, "sphere 3 left the world")
        self.assertIn('"fast","sphere 3 left the world"', study_csv(result))
        self.assertIn("sphere 3 left the world", study_page(result, "A title", ""))

    def test_the_front_has_no_setting_that_a_cheaper_one_beats_and_advice_names_the_cheapest(self):
        result = compare([*FOUR, "worse", "good"], [
            reference(), row("default", 2.0, 1e-4, 8.0, 1.99, 0.001), row("fast", 1.0, 3e-3, 8.0, 1.5), row("slow", 8.0, 1e-5, 8.0, 2.0),
            row("worse", 4.0, 2e-4, 8.0, 2.0), row("good", 1.5, 1e-4, 8.0, 1.995, 0.001)])
        self.assertEqual(front(result, [kind.name for kind in result.kinds].index("overlap_95")), [2, 5, 3])
        sentences = advice(result)
        self.assertIn("For no more overlap_95 than the default's 0.0001 d: use good: 1.3 × faster than the default.", sentences)
        self.assertIn("For 1 % in outlet mass_flow: use good: 1.3 × faster than the default.", sentences)

    def test_where_the_spread_is_too_large_no_setting_is_recommended(self):
        sentences = advice(compare(FOUR, [reference(), row("default", 2.0, 1e-4, 8.0, 2.01, 0.1)]))
        self.assertIn("No setting is sure to be within 1 % in outlet mass_flow (the default differs by 0.5 ± 9.8 %);", sentences[-1])

    def test_a_setting_that_costs_as_much_as_a_default_that_is_not_good_enough_is_named(self):
        sentences = advice(compare(FOUR, [reference(), row("default", 2.0, 1e-4, 8.0, 2.1), row("fast", 1.97, 1e-4, 8.0, 2.001, 1e-4)]))
        self.assertIn("For 1 % in outlet mass_flow: use fast: it takes as long as the default.", sentences)

    def test_measures_that_one_setting_is_right_for_stand_in_one_sentence_and_of_many_the_first(self):
        def sentences_with(spread):
            def many(of):
                return [(f"floor force_{k}", 5.0, of, "N") for k in range(9)]
            return advice(compare(FOUR, [reference(more=many(0.0)), row("default", 2.0, 1e-4, 8.0, 2.0, more=many(spread)),
                                         row("fast", 1.0, 1e-3, 8.0, 2.0, more=many(spread))]))
        self.assertIn("For 1 % in outlet mass_flow, floor force_0, floor force_1, floor force_2, floor force_3, floor force_4 and 4 more: "
                      "use fast: 2 × faster than the default.", sentences_with(0.0))
        unsure = sentences_with(0.5)
        self.assertEqual(sum(one.startswith("No setting is sure") for one in unsure), 1)
        self.assertIn("floor force_0 (the default differs by 0 ± 20 %)", unsure[-1])
        self.assertIn("and 3 more;", unsure[-1])

    def test_settings_that_came_to_the_same_run_are_one_with_the_mean_of_their_times(self):
        result = compare(FOUR, [reference(), row("default", 2.0, 1e-4, 8.0, 2.0), row("fast", 3.5, 1e-4, 8.0, 2.0), row("slow", 2.0, 1e-4, 8.0, 2.0)])
        self.assertAlmostEqual(result.standard().cpu, 2.5)
        self.assertEqual([point.status for point in result.points[2:]], ["the same run as default"] * 2)


class Settings(unittest.TestCase):
    def study(self, **changes):
        vary = [("solver.stabilisation", ["matched", "projected"]), ("solver.tolerance", ["draft", "fine"]), ("time.step", ["x0.5"])]
        return {**read_study(), "vary": [{"key": key, "values": values} for key, values in vary], **changes}

    def names(self, **changes):
        return [setting.name for setting in settings_of(self.study(**changes), 1e-3)]

    def test_one_key_is_varied_at_a_time_with_every_value_of_the_crossed_ones(self):
        self.assertEqual(self.names(), ["reference", "default", "matched", "projected", "matched, tolerance=draft", "matched, tolerance=fine",
                                        "projected, tolerance=draft", "projected, tolerance=fine", "matched, step=x0.5", "projected, step=x0.5"])

    def test_a_grid_has_every_combination_and_no_cross_only_single_changes(self):
        self.assertEqual(self.names(cross=["all"]), ["reference", "default", "matched, tolerance=draft, step=x0.5", "matched, tolerance=fine, step=x0.5",
                                                     "projected, tolerance=draft, step=x0.5", "projected, tolerance=fine, step=x0.5"])
        self.assertEqual(self.names(cross=[]), ["reference", "default", "matched", "projected", "tolerance=draft", "tolerance=fine", "step=x0.5"])

    def test_a_step_may_be_a_multiple_of_the_scenes(self):
        self.assertEqual(settings_of(self.study(), 2e-3)[-1].overrides, ["solver.stabilisation=projected", "time.step=0.001"])
        for wrong in ("xy", "x-1"):
            with self.assertRaisesRegex(RunError, "is not x and a number above 0"):
                settings_of(self.study(vary=[{"key": "time.step", "values": [wrong]}]), 2e-3)
        with self.assertRaisesRegex(RunError, "is not key=value"):
            settings_of(self.study(reference=["fine"]), 1e-3)

    def test_the_whole_study_reads_back(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "study.toml"
            path.write_text(resolved_study(read_study()), encoding="utf-8")
            self.assertEqual(read_study(path), read_study())
            self.assertEqual(read_study()["vary"], VARY)
            for text, sentence in (("settle = -1", "'settle' must be a number of at least 0"), ("seeds = true", "'seeds' must be a whole number"),
                                   ("set = [1]", "'set' must be an array of strings"), ("speed = 1", "unknown key 'speed'"),
                                   ("[[vary]]\nkey = 'a'\n", "'vary.values' is missing"), ("vary = 3", "'vary' must be a list of tables")):
                path.write_text(text, encoding="utf-8")
                with self.assertRaisesRegex(RunError, sentence):
                    read_study(path)


class Workers(unittest.TestCase):
    def test_one_that_crashes_takes_nothing_with_it(self):
        class Told(script.Worker):
            def __init__(self, code):
                self.code = code
                super().__init__("", {})

            def command(self, program):
                return [sys.executable, "-c", self.code]

        found = {}

        def ended(worker):
            found[worker.code] = worker.result()

        codes = ["import json; print(json.dumps('x' * 1000000))", "import os; os.kill(os.getpid(), 9)", "raise MemoryError", "print(1)"]
        run_processes(codes, 2, Told, ended)
        self.assertEqual([found[code] for code in codes],
                         [("x" * 1000000, ""), (None, "crashed: Killed"), (None, "ended without a result: MemoryError"), (1, "")])


if __name__ == "__main__":
    unittest.main()
