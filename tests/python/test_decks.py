# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes as decks for LAMMPS and LIGGGHTS: what stands in them, what they cannot say, and `talus export`."""
import math
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy
import talus

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "postprocess"))
from decks.basis import Basis
from decks.lammps import lammps_deck
from decks.liggghts import liggghts_deck
from decks.mesh_parts import plates, round_parts
from decks.shared import head, spheres_file
from read_run import RunError

TALUS = os.path.abspath(os.environ["TALUS"])

# A box with a gate in its floor that opens after 0.2 s, and two kinds of beads of two materials that are poured in.
POURED = """
[time]
duration = 1.0
[materials.glass]
density = 2500.0
[materials.steel]
density = 7800.0
[[contact]]
between = ["glass", "glass"]
friction = 0.5
restitution = 0.5
[[contact]]
between = ["glass", "steel"]
friction = 0.3
[[contact]]
between = ["steel", "steel"]
friction = 0.2
[[pour]]
name = "rain"
count = 800
rate = 2000.0
velocity = [0, 0, -1]
region = { shape = "box", min = [-0.04, -0.04, 0.2], max = [0.04, 0.04, 0.25] }
[[pour.species]]
material = "glass"
diameter = { distribution = "uniform", min = 0.004, max = 0.006 }
share = 1
[[pour.species]]
material = "steel"
diameter = 0.005
share = 1
[[wall]]
name = "box"
shape = "box"
min = [-0.05, -0.05, 0]
max = [0.05, 0.05, 0.3]
open = ["z+", "z-"]
material = "steel"
[[wall]]
name = "gate"
shape = "disk"
radius = 0.08
material = "glass"
remove_at = 0.2
[[outlet]]
name = "below"
region = { shape = "box", min = [-0.2, -0.2, -0.2], max = [0.2, 0.2, -0.1] }
"""

# Over a plane; tests add more tables.
ONE_BEAD = """
[materials.glass]
[[contact]]
between = ["glass", "glass"]
[[fill]]
arrangement = "single"
position = [0, 0, 0.1]
velocity = [1, 2, 3]
diameter = 0.01
material = "glass"
[[wall]]
name = "floor"
shape = "plane"
material = "glass"
"""

BALL = """[[fill]]
material = "glass"
count = 200
diameter = 0.001
region = { shape = "box", min = [-0.02, -0.02, 0], max = [0.02, 0.02, 0.02] }
"""

PISTON = """[[wall]]
name = "lid"
shape = "disk"
radius = 0.1
center = [0, 0, 0.3]
material = "glass"
mass = 1
guide = [0, 0, -1]
[[sensor]]
name = "load"
kind = "wall_force"
wall = "floor"
"""


def basis_of(text):
    return Basis(talus.Simulation(text, threads=1), talus._core._stl_text)


def decks_of(text):
    basis = basis_of(text)
    return lammps_deck(basis), liggghts_deck(basis)


class DeckTest(unittest.TestCase):
    def assert_in_order(self, text, *parts):
        self.assertRegex(text, re.compile(".*".join(map(re.escape, parts)), re.S))

    def assert_note(self, deck, part):
        self.assertTrue(any(part in note for note in deck.notes), deck.notes)


class Spheres(DeckTest):
    def test_classes_of_a_mixture_have_its_number_its_mass_and_its_materials(self):
        pour, = basis_of(POURED).pours
        self.assertAlmostEqual(sum(kind.number for kind in pour.kinds), 1.0)
        self.assertEqual([(kind.material, len(kind.diameters)) for kind in pour.kinds], [("glass", 8), ("steel", 1)])
        for kind in pour.kinds:
            volume = math.pi / 6.0 * numpy.mean(numpy.power(kind.diameters, 3))
            # of 8000 draws, whose volumes vary by a third: their mean by 0.4 %
            self.assertLess(abs(volume / kind.mean_volume - 1), 0.015)
        glass, steel = (kind.number * kind.mean_volume for kind in pour.kinds)
        self.assertAlmostEqual(2500 * glass, 7800 * steel)  # equal shares by mass
        self.assertAlmostEqual(steel / pour.kinds[1].number, math.pi / 6.0 * 0.005**3)

    def test_the_data_file_has_every_sphere_and_grains_of_walls_as_types_of_their_own(self):
        basis = basis_of(ONE_BEAD + """[[wall]]
name = "bed"
shape = "grains"
min = [-0.02, 0, 0.01]
max = [0.02, 0, 0.01]
diameter = 0.008
material = "glass"
""")
        grains = len(basis.built["walls"][1]["corners"])
        self.assertGreater(grains, 2)
        text = spheres_file(basis)
        for line in (f"{grains + 1} atoms", "2 atom types", "1 1 0.01 2500 0 0 0.1", "1 1 2 3 0 0 0", "2 0 0 0 0 0 0"):
            self.assertIn(f"\n{line}\n", text)
        self.assertIn("\n2 2 0.008 ", text)
        # only what moves is integrated
        lammps, liggghts = lammps_deck(basis).text, liggghts_deck(basis).text
        self.assertIn("group grains1_glass type 1", lammps)
        self.assertNotIn("fix motion2", lammps)
        self.assertIn("neigh_modify exclude type 2 2", liggghts)

    def test_lists_of_neighbours_last_where_a_sphere_reaches_over_many(self):
        self.assertIn("\nneighbor 0.002 bin\n", decks_of(ONE_BEAD)[0].text)  # a fifth of a diameter
        for deck in decks_of(ONE_BEAD + BALL):
            self.assertIn("\nneighbor 0.001 bin\n", deck.text)  # a tenth of the ball


class Commands(DeckTest):
    def test_a_gate_is_there_until_its_time(self):
        lammps, liggghts = decks_of(POURED)
        self.assert_in_order(lammps.text, "fix wall1_gate_1 grains1_glass wall/gran/region",
                             "variable until equal ceil(0.2/${step})", "run ${until} upto", "unfix wall1_gate_1",
                             "variable until equal ceil(1/${step})", "run ")
        self.assert_in_order(liggghts.text, "fix wall1_gate all mesh/surface", "meshes wall0_box wall1_gate",
                             "run ${until} upto", "unfix contacts", "unfix wall1_gate", "n_meshes 1 meshes wall0_box",
                             "run ")

    def test_each_kind_of_sphere_has_its_own_law_at_a_wall(self):
        lammps, liggghts = decks_of(POURED)
        for kind, group, friction in ((1, "grains1_glass", 0.3), (2, "grains2_steel", 0.2)):  # the box is of steel
            self.assertIn(f"fix wall0_box_{kind} {group} wall/gran/region granular hertz/material ${{modulus}} 0 0.25 "
                          f"tangential mindlin NULL 1.0 {friction} damping tsuji region wall0_box", lammps.text)
        self.assertIn("region wall0_box block -0.05 0.05 -0.05 0.05 0 0.3 open 6 open 5", lammps.text)
        # by pair of types: glass-glass has 0.5, the others the least that LIGGGHTS takes
        self.assertIn("coefficientRestitution peratomtypepair 2 0.5 0.051 0.051 0.051", liggghts.text)

    def test_pours_let_all_spheres_in(self):
        lammps, liggghts = decks_of(POURED)
        self.assertIn("nparticles 800 particlerate 2000", liggghts.text)
        self.assertIn("vel constant 0 0 -1", liggghts.text)
        # in the group that is moved, which is one of the spheres that were there before
        self.assertIn("fix pour0_rain_size0 grains1_glass particletemplate/sphere", liggghts.text)
        counts = re.findall(r"^fix pour0_rain_\d+ \w+ pour (\d+) ", lammps.text, re.M)
        self.assertEqual((len(counts), sum(map(int, counts))), (2, 800))

    def test_spheres_in_an_outlet_are_taken_out(self):
        lammps, liggghts = decks_of(POURED)
        self.assertIn("region outlet0_below block -0.2 0.2 -0.2 0.2 -0.2 -0.1 units box", lammps.text)
        self.assertIn("fix outlet0_below all evaporate ${look}", lammps.text)
        self.assertIn('every ${look} "delete_atoms region outlet0_below compress no"', liggghts.text)

    def test_walls_move_in_lammps_by_formulas_of_time_in_liggghts_from_one_moment_to_another(self):
        lammps, liggghts = decks_of(ONE_BEAD + """[[wall]]
name = "plate"
shape = "disk"
radius = 0.1
center = [0, 0, 0.2]
material = "glass"
[[wall.motion]]
kind = "turn"
axis = [0, 0, 1]
rate = -2.0
[[wall.motion]]
kind = "translate"
velocity = [0, 0, -0.5]
from = 0.1
to = 0.3
""")
        self.assertIn("variable wall1_plate_z equal -0.5*((v_t>0.1)*(v_t-0.1)-(v_t>0.3)*(v_t-0.3))", lammps.text)
        self.assertIn("variable wall1_plate_angle equal -2*((v_t>0)*(v_t-0))", lammps.text)
        self.assertIn("move NULL NULL v_wall1_plate_z rotate v_wall1_plate_angle 0 0 0 0 0 1", lammps.text)
        self.assert_in_order(liggghts.text, "fix wall1_plate_move0 all move/mesh mesh wall1_plate rotate",
                             "axis -0 -0 -1 period 3.14159", "ceil(0.1/",
                             "fix wall1_plate_move1 all move/mesh mesh wall1_plate linear 0 0 -0.5", "ceil(0.3/",
                             "unfix wall1_plate_move1")

    def test_a_tilted_plane_is_cut_to_the_room_for_liggghts(self):
        basis = basis_of(ONE_BEAD + '[[wall]]\nname = "chute"\nshape = "plane"\nnormal = [1, 0, 1]\nmaterial = "glass"\n')
        stl = liggghts_deck(basis).files["wall1_chute.stl"]
        corners = numpy.array(re.findall(r"vertex (\S+) (\S+) (\S+)", stl), dtype=float)
        numpy.testing.assert_allclose(corners[:, 0], -corners[:, 2], atol=1e-9)
        low, high = basis.room
        self.assertTrue(((corners > low - 1e-9) & (corners < high + 1e-9)).all())
        self.assertLess(numpy.abs(numpy.ptp(corners[:, 1]) - (high - low)[1]), 1e-9)


class Notes(DeckTest):
    def test_what_a_deck_cannot_say_is_reported_and_nothing_is_left_out_in_silence(self):
        for deck in decks_of(ONE_BEAD + PISTON):
            self.assert_note(deck, "the wall 'lid' of finite mass stands still")
            self.assert_note(deck, "the sensor 'load' of kind wall_force is left out")
        tilted = basis_of(ONE_BEAD + """[[wall]]
name = "chute"
shape = "cylinder"
axis = [1, 0, 1]
radius = 0.1
height = 0.2
material = "glass"
""")
        deck = lammps_deck(tilted)
        self.assert_note(deck, "the wall 'chute' is left out")
        self.assertFalse(any("chute" in note for note in liggghts_deck(tilted).notes))
        swung, _ = decks_of(ONE_BEAD + """[[wall]]
name = "arm"
shape = "box"
min = [1, 0, 0]
max = [2, 1, 1]
open = ["z+"]
material = "glass"
[[wall.motion]]
kind = "translate"
velocity = [1, 0, 0]
[[wall.motion]]
kind = "turn"
axis = [0, 0, 1]
rate = 1
""")
        self.assert_note(swung, "the wall 'arm' stands still")
        # the head has each note, perhaps broken into lines
        told = head(tilted, "s of Talus 0", "lmp", deck.notes)
        self.assertIn("the wall 'chute' is left out", told)
        unbroken = " ".join(line.removeprefix("#").strip() for line in told.splitlines())
        for note in deck.notes:
            self.assertIn(note, unbroken)

    def test_what_would_be_another_scene_is_refused(self):
        def with_contact(words):
            return ONE_BEAD.replace('["glass", "glass"]', f'["glass", "glass"]\n{words}')

        with self.assertRaisesRegex(RunError, "twisting_friction"):
            basis_of(with_contact("twisting_friction = 0.1"))
        constant = basis_of(with_contact('cohesion = { law = "constant", force = 1e-3 }'))
        for make in (lammps_deck, liggghts_deck):
            with self.assertRaisesRegex(RunError, "there is no deck of it"):
                make(constant)
        adhesive = basis_of(with_contact('cohesion = { law = "jkr", work_of_adhesion = 0.08 }'))
        self.assertIn("dmt ${modulus} 0 0.25 0.03 ", lammps_deck(adhesive).text)
        self.assertRaises(RunError, liggghts_deck, adhesive)


class Export(DeckTest):
    """`talus export`, in a folder of its own."""

    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = Path(place.name)
        self.write("scene.toml", ONE_BEAD + PISTON)

    def write(self, name, text):
        (self.folder / name).parent.mkdir(exist_ok=True)
        (self.folder / name).write_text(text, encoding="utf-8")

    def read(self, name):
        return (self.folder / name).read_text(encoding="utf-8")

    def export(self, words, code=0):
        """What it prints, and its complaints; it must end with that exit code."""
        command = [TALUS, "export", "scene.toml", *words.split()]
        ended = subprocess.run(command, cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(ended.returncode, code, ended.stderr)
        return ended.stdout, ended.stderr

    def refused(self, words, code=2):
        """The one sentence with which it is refused."""
        out, error = self.export(words, code)
        self.assertEqual((out, error.count("\n")), ("", 1), error)
        return error

    def test_a_deck_says_what_it_leaves_out_on_the_terminal_and_in_the_deck(self):
        for program, command in (("lammps", "lmp"), ("liggghts", "liggghts")):
            out, error = self.export(f"--format {program} --until 0.3")
            self.assertIn("the wall 'lid' of finite mass stands still", error)
            self.assertEqual(out, f"out/scene-{program}; to run it: cd out/scene-{program} && {command} -in in.{program}\n")
            text = self.read(f"out/scene-{program}/in.{program}")
            self.assertIn("#  - the wall 'lid' of finite mass stands still", text)
            self.assertIn("ceil(0.3/${step})", text)
            files = sorted(path.name for path in (self.folder / f"out/scene-{program}").iterdir())
            self.assertEqual(["export.txt", *self.read(f"out/scene-{program}/export.txt").splitlines()[1:]], files)

    def test_it_is_of_the_scene_that_was_asked_for(self):
        self.export("--format lammps -o there --quiet --set world.gravity=[0,0,-3] --set materials.glass.density=1000")
        self.assertIn("gravity 3 vector 0 0 -1", self.read("there/in.lammps"))
        self.assertIn("\n1 1 0.01 1000 0 0 0.1\n", self.read("there/spheres.data"))
        self.write("scene.toml", ONE_BEAD + BALL)
        for seed in (1, 2):
            self.export(f"--format lammps -o of_seed_{seed} --quiet --seed {seed}")
        self.assertEqual(self.read("of_seed_1/in.lammps"), self.read("of_seed_2/in.lammps"))
        self.assertNotEqual(self.read("of_seed_1/spheres.data"), self.read("of_seed_2/spheres.data"))

    def test_it_keeps_out_of_folders_that_are_not_its_own_and_replaces_its_own_with_force(self):
        self.write("thesis/thesis.tex", "ten years of work")
        sentence = self.refused("--format lammps -o thesis --force")
        self.assertIn("thesis: the folder holds files that are not of an export", sentence)
        self.export("--format liggghts -o there --quiet")
        self.write("there/notes.txt", "mine")
        self.assertIn("there: the folder holds an export already; --force", self.refused("--format lammps -o there"))
        self.export("--format lammps -o there --force")
        self.assertEqual(sorted(path.name for path in (self.folder / "there").iterdir()),
                         ["export.txt", "in.lammps", "notes.txt", "spheres.data"])
        self.assertEqual(self.read("thesis/thesis.tex"), "ten years of work")
        self.assertIn("the deck is made from this file", self.refused("--format lammps -o ."))

    def test_a_scene_that_is_refused_leaves_an_earlier_deck_as_it_is(self):
        self.export("--format liggghts -o there --quiet")
        before = self.read("there/in.liggghts")
        sentence = self.refused("--format liggghts -o there --force --set contact.glass-glass.cohesion="
                                "{law='constant',force=1.0}")
        self.assertIn("there is no deck of it", sentence)
        self.assertEqual(self.read("there/in.liggghts"), before)

    def test_a_folder_that_cannot_be_made_ends_with_4(self):
        self.assertIn("scene.toml/deck", self.refused("--format lammps -o scene.toml/deck", code=4))


def funnel(axis, sides, share=1.0):
    """A funnel under a tube, round the line through (0.3, 0.1) along x, y or z, of so many sides; `share` of its way
    round."""
    angles = 2.0 * math.pi * numpy.arange(sides) / sides
    corners = numpy.empty((3 * sides, 3))
    for ring, (place, radius) in enumerate(((0.0, 0.02), (0.1, 0.08), (0.3, 0.08))):
        rows = corners[ring * sides:(ring + 1) * sides]
        rows[:, axis] = place
        rows[:, (axis + 1) % 3] = 0.3 + radius * numpy.cos(angles)
        rows[:, (axis + 2) % 3] = 0.1 + radius * numpy.sin(angles)
    triangles = []
    for ring in range(2):
        for k in range(round(share * sides)):
            a, b = ring * sides + k, ring * sides + (k + 1) % sides
            triangles += [(a, b, b + sides), (a, b + sides, a + sides)]
    return corners, numpy.array(triangles)


class MeshParts(unittest.TestCase):
    def test_a_round_mesh_is_cones_along_any_axis(self):
        for axis in range(3):
            (lower, upper), sag = round_parts(*funnel(axis, 32))
            for part, base, first, second, height in ((lower, 0.0, 0.02, 0.08, 0.1), (upper, 0.1, 0.08, 0.08, 0.2)):
                self.assertEqual(part["shape"], "cone")
                found = part["base_radius"], part["top_radius"], part["height"]
                numpy.testing.assert_allclose(found, [first, second, height])
                numpy.testing.assert_allclose(numpy.roll(part["base"], -axis), [base, 0.3, 0.1], atol=1e-12)
                numpy.testing.assert_array_equal(part["axis"], numpy.eye(3)[axis])
            self.assertAlmostEqual(sag, 0.08 * (1.0 - math.cos(math.pi / 32)))  # the middle of a chord

    def test_what_is_slit_has_few_sides_or_is_turned_is_not_round(self):
        self.assertEqual(round_parts(*funnel(2, 32, 0.75)), ([], 0.0))
        self.assertEqual(round_parts(*funnel(2, 6)), ([], 0.0))
        corners, triangles = funnel(2, 32)
        turn = [[1, 0, 0], [0, math.cos(0.1), -math.sin(0.1)], [0, math.sin(0.1), math.cos(0.1)]]
        self.assertEqual(round_parts(corners @ numpy.transpose(turn), triangles), ([], 0.0))

    def test_a_flat_ring_and_a_lid_are_disks(self):
        sides = 40
        angles = 2.0 * math.pi * numpy.arange(sides) / sides
        circle = numpy.column_stack([numpy.cos(angles), numpy.sin(angles), numpy.zeros(sides)])
        corners = numpy.vstack([numpy.zeros((1, 3)), 0.1 * circle, 0.2 * circle]) + [0, 0, 0.5]
        lid, ring = [], []
        for k in range(sides):
            a, b = 1 + k, 1 + (k + 1) % sides
            lid.append((0, a, b))
            ring += [(a, b, b + sides), (a, b + sides, a + sides)]
        # corners that no triangle has would count as well, so the lid has those of the small circle only
        for triangles, count, radius, hole in ((lid, 1 + sides, 0.1, 0.0), (ring, 1 + 2 * sides, 0.2, 0.1)):
            (disk,), _ = round_parts(corners[:count], numpy.array(triangles))
            self.assertEqual(disk["shape"], "disk")
            found = disk["radius"], disk["hole_radius"], disk["center"][2]
            numpy.testing.assert_allclose(found, [radius, hole, 0.5], atol=1e-12)

    def test_triangles_in_pairs_are_plates_and_a_single_one_is_none(self):
        corners = numpy.array([(0, 0, 0), (0, 2, 0), (1, 2, 1), (1, 0, 1), (3, 0, 1)], dtype=float)
        (corner, one, other), = plates(corners, numpy.array([(0, 1, 2), (2, 3, 0)]))
        self.assertAlmostEqual(numpy.linalg.norm(numpy.cross(one, other)), 2.0 * math.sqrt(2.0))
        places = [corner + s * one + t * other for s in (0, 1) for t in (0, 1)]
        box = numpy.min(places, axis=0), numpy.max(places, axis=0)
        numpy.testing.assert_allclose(box, [(0, 0, 0), (1, 2, 1)], atol=1e-12)
        self.assertEqual(plates(corners, numpy.array([(0, 1, 2), (2, 3, 0), (2, 3, 4)])), [])
