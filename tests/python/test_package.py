# SPDX-License-Identifier: GPL-3.0-or-later
"""The package around the module: its stubs tell what there is, and without the module it still reads runs."""
import ast
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import talus

PACKAGE = Path(talus.__file__).parent


def names_in(body):
    return {getattr(node, "name", None) or getattr(node, "target", node).id
            for node in body if isinstance(node, (ast.FunctionDef, ast.ClassDef, ast.AnnAssign))}


class Stubs(unittest.TestCase):
    def test_they_have_what_the_module_has(self):
        stub = ast.parse((PACKAGE / "_core.pyi").read_text())
        module = {name for name in vars(talus._core) if not name.startswith("__") or name == "__version__"}
        self.assertEqual(names_in(stub.body), module)
        for node in stub.body:
            if isinstance(node, ast.ClassDef):
                there = {name for name in vars(getattr(talus._core, node.name))
                         if not name.startswith("__") and not name.startswith("_pybind11")}
                self.assertEqual({name for name in names_in(node.body) if not name.startswith("__")}, there, node.name)

    def test_everything_public_has_words(self):
        for one in (talus.Simulation, talus.Run):
            for name, member in vars(one).items():
                if not name.startswith("_"):
                    self.assertTrue(member.__doc__, f"{one.__name__}.{name}")
        for name in talus.__all__:
            self.assertTrue(getattr(talus, name).__doc__, name)


class WithoutTheModule(unittest.TestCase):
    def test_runs_can_be_read(self):
        with tempfile.TemporaryDirectory() as folder:
            shutil.copytree(PACKAGE, Path(folder) / "talus", ignore=shutil.ignore_patterns("_core*", "__pycache__"))
            for words, ends in (("talus.Run('nowhere')", "holds no run of Talus"),
                                ("talus.Simulation('hopper')", "needs the compiled module")):
                told = subprocess.run([sys.executable, "-c", f"import talus; {words}"], cwd=folder, text=True,
                                      capture_output=True, env={"PYTHONPATH": folder})
                self.assertEqual(told.returncode, 1)
                self.assertIn(ends, told.stderr)


if __name__ == "__main__":
    unittest.main()
