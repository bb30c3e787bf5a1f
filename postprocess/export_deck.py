#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes a scene as the input of LAMMPS or LIGGGHTS: what `talus export SCENE --format lammps|liggghts` calls.

Exit codes: 0 done; 2 the scene is wrong or has what decks cannot say, its folder is not free, or something is missing;
4 a file could not be written.
"""
import argparse
import sys
import warnings
from pathlib import Path

from own_module import find_module

COMMANDS = {"lammps": "lmp -in in.lammps", "liggghts": "liggghts -in in.liggghts"}


def parse_arguments():
    parser = argparse.ArgumentParser(prog="talus export", description="Writes a scene as a deck for another program.")
    parser.add_argument("scene", metavar="SCENE", help="a scene file, or the name of a scene")
    parser.add_argument("--talus", default="talus", metavar="PROGRAM", help="the program, whose Python module is used")
    parser.add_argument("--format", choices=COMMANDS, required=True, help="the program that the deck is for")
    parser.add_argument("--out", type=Path, required=True, metavar="DIR", help="where to")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="changes a key of the scene")
    parser.add_argument("--force", action="store_true", help="replace the files of an earlier export in that folder")
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors, and what the deck leaves out")
    return parser.parse_args()


def write_deck(talus, arguments):
    """Writes the deck. Returns what it cannot say, a sentence each."""
    from decks.basis import Basis
    from decks.lammps import lammps_deck
    from decks.liggghts import liggghts_deck
    from decks.shared import head, spheres_file
    warnings.simplefilter("ignore", talus.StepWarning)
    program = arguments.format
    simulation = talus.Simulation(arguments.scene, set=arguments.set, threads=1)
    basis = Basis(simulation, talus._core._stl_text)
    deck = {"lammps": lammps_deck, "liggghts": liggghts_deck}[program](basis)
    origin = f"The scene {simulation.name} of Talus {talus.__version__}"
    deck.files[f"in.{program}"] = head(basis, origin, COMMANDS[program], deck.notes) + deck.text
    deck.files["spheres.data"] = spheres_file(basis)
    what = f"{program} of the scene {simulation.name}"
    folder = talus._core._ExportFolder(arguments.out, what, sorted(deck.files), arguments.force)
    for name, text in sorted(deck.files.items()):
        folder.write(name, text)
    return deck.notes


def main():
    arguments = parse_arguments()
    talus = find_module(arguments.talus, "talus export")
    from read_run import RunError
    try:
        notes = write_deck(talus, arguments)
    except (RunError, talus.SceneError) as error:
        print(error, file=sys.stderr)
        return 2
    except OSError as error:
        print(error, file=sys.stderr)
        return 4
    for note in notes:
        print(note, file=sys.stderr)
    if not arguments.quiet:
        print(f"{arguments.out}; to run it: cd {arguments.out} && {COMMANDS[arguments.format]}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
