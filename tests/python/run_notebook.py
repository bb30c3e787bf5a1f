#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs every cell of the notebook with the module that was built: run_notebook.py PACKAGES [HTML]

Every one must end well, and the pictures must be there. With HTML it is kept as a page, to be looked at.
"""
import os
import sys
from importlib.util import find_spec
from pathlib import Path

NOTEBOOK = Path(__file__).resolve().parents[2] / "app" / "python" / "hopper.ipynb"
PICTURES = 4


def main():
    packages, *page = sys.argv[1:]
    missing = [name for name in ("nbconvert", "ipykernel", "matplotlib") if not find_spec(name)]
    if missing or not list(Path(packages).glob("talus/_core.*.so")):
        print(f"skipped: {', '.join(missing) or 'the Python module'} not installed or built "
              "(Debian: python3-nbconvert python3-ipykernel python3-matplotlib pybind11-dev)")
        return
    import nbformat
    from nbconvert import HTMLExporter
    from nbconvert.preprocessors import ExecutePreprocessor

    os.environ |= {"PYTHONPATH": packages, "PYDEVD_DISABLE_FILE_VALIDATION": "1"}
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    ExecutePreprocessor(timeout=600, kernel_name="python3").preprocess(notebook)
    if page:
        Path(page[0]).write_text(HTMLExporter().from_notebook_node(notebook)[0])
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    pictures = [output for output in outputs if "image/png" in output.get("data", {})]
    told = [output["text"] for output in outputs if output.get("name") == "stderr"]
    print(f"{len(notebook.cells)} cells, {len(pictures)} pictures", *told, sep="\n")
    sys.exit(len(pictures) != PICTURES or bool(told))


if __name__ == "__main__":
    main()
