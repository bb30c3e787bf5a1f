#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes a page that plays a run: one file, to be opened in a browser, without a network.

    postprocess/report.py out/hopper                      into out/hopper/report.html
    postprocess/report.py out/hopper --output page.html --frames 120

It works on a run that is still going on, or was killed, as far as it came.
Exit codes: 0 done, 2 wrong arguments or something missing, 4 a file of the run is damaged, or the page cannot be
written.
"""
import argparse
import sys
from pathlib import Path

try:
    import numpy  # noqa: F401  whether it is there
    import vtkmodules.vtkIOXML  # noqa: F401
except ImportError as error:
    print(f"report.py: {error}: apt install python3-vtk9 python3-numpy, and use /usr/bin/python3.", file=sys.stderr)
    sys.exit(2)

from read_run import Run, RunError
from run_page.page import RunPage, report_page
from run_page.writing import refuse_foreign, write_whole


def positive(argument):
    if not argument.isdecimal() or not 1 <= int(argument) <= 10000:
        raise argparse.ArgumentTypeError(f"'{argument}' is not a whole number from 1 to 10000")
    return int(argument)


def parse_arguments():
    parser = argparse.ArgumentParser(prog="report.py", description="Makes a page that plays a run.")
    parser.add_argument("run", metavar="OUT", help="the folder of a run")
    parser.add_argument("--output", type=Path, metavar="HTML", help="where to write the page (OUT/report.html)")
    parser.add_argument("--force", action="store_true", help="replace a file that is no page of Talus")
    parser.add_argument("--frames", type=positive, metavar="N", help="how many frames to play (60; fewer of over 33 000 spheres)")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    try:
        run = Run(arguments.run)
        path = arguments.output or run.folder / "report.html"
        if not arguments.force:
            refuse_foreign(path)
        write_whole(path, report_page(RunPage(run, arguments.frames)))
        print(path)
    except RunError as error:
        print(f"report.py: {error}", file=sys.stderr)
        sys.exit(error.exit_code)
    except OSError as error:
        print(f"report.py: {error.filename}: {error.strerror}.", file=sys.stderr)
        sys.exit(4)


if __name__ == "__main__":
    main()
