#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Gathers the results of a sweep into tables and a page: what `talus gather` calls.

    postprocess/gather.py out/frictions          results.csv, costs.csv and sweep.html in that folder

It works on a sweep that is still going on, or was killed, as far as it came.
Exit codes: 0 done, 2 wrong arguments or something missing, 4 a file cannot be written.
"""
import argparse

from sweep import explained
from sweeps.folder import SweepFolder
from sweeps.gathering import gather


def main():
    parser = argparse.ArgumentParser(prog="talus gather", description="Gathers the results of a sweep into tables and a page.")
    parser.add_argument("folder", metavar="DIR", help="the folder of a sweep")
    print(gather(SweepFolder(parser.parse_args().folder)))


if __name__ == "__main__":
    explained(main)
