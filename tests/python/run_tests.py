#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the tests of the Python module that was built: run_tests.py TALUS PACKAGES [PATTERN]"""
import os
import sys
import unittest
from pathlib import Path


def main():
    talus, packages, *pattern = sys.argv[1:]
    if not list(Path(packages).glob("talus/_core.*.so")):
        print("skipped: the Python module was not built (Debian: pybind11-dev)")
        return
    os.environ["TALUS"] = talus
    os.environ["OMP_NUM_THREADS"] = "1"  # threads that wait for each other crawl on a busy machine
    here = str(Path(__file__).parent)
    sys.path[:0] = [packages, here]
    tests = unittest.TestLoader()
    tests.testNamePatterns = [f"*{name}*" for name in pattern] or None
    sys.exit(not unittest.TextTestRunner(buffer=True).run(tests.discover(here)).wasSuccessful())


if __name__ == "__main__":
    main()
