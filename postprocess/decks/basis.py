# SPDX-License-Identifier: GPL-3.0-or-later
"""A scene as the decks for LAMMPS (tried: 29 Sep 2021) and LIGGGHTS (3.8) need it, and how both write numbers, names and
regions. Numbers are SI."""
import math
import re
import tomllib
from dataclasses import dataclass

import numpy
from numpy.linalg import norm

from read_run import RunError

POISSON = 0.25  # of all materials
LEAST_MODULUS = 5e6  # Pa, which LIGGGHTS asks for
MODULUS_BY_PRESSURE = 500.0  # at which a bed's mean overlap is about one percent of a diameter
SIZE_CLASSES, IN_A_CLASS = 8, 1000
NO_CONTACT = {"friction": 0.0, "restitution": 0.0, "rolling_friction": 0.0, "cohesion": {"law": "none"}}
STRENGTH_OF_COHESION = {"constant": "force", "dmt": "work_of_adhesion", "jkr": "work_of_adhesion",
                        "bond_number": "bond_number", "liquid": "surface_tension"}


def plain(number):
    """The shortest text that reads back as the number."""
    return repr(float(number)).removesuffix(".0")


def words(numbers):
    return " ".join(f"{number:.10g}" for number in numbers)


def unit(vector):
    return numpy.array(vector, dtype=float) / norm(vector)


def deck_id(kind, index, name):
    """The name of something in a deck: "wall0_gate"."""
    return f"{kind}{index}" + ("_" + re.sub(rb"[^0-9A-Za-z]", b"_", name.encode()).decode() if name else "")


def along_axis(base, direction):
    """The axis (0, 1, 2) along which a direction lies, and "z 0.1 0.2" with the other coordinates of `base`; None where
    it lies along none."""
    axis = int(numpy.argmax(numpy.abs(direction)))
    if abs(unit(direction)[axis]) < 1.0 - 1e-12:
        return None
    return axis, "xyz"[axis] + " " + words(numpy.delete(base, axis))


def box_words(low, high):
    return "block " + words(number for pair in zip(low, high) for number in pair)


def region_words(region):
    """A region of a scene as both programs call it; None where they have none such."""
    shape = region["shape"]
    if shape == "box":
        return box_words(region["min"], region["max"])
    if shape == "sphere":
        return f"sphere {words([*region['center'], region['radius']])}"
    if shape == "mesh" or not (placed := along_axis(region["base"], region["axis"])):
        return None
    d, place = placed
    ends = [region["base"][d], region["base"][d] + region["height"] * unit(region["axis"])[d]]
    if shape == "cylinder":
        return f"cylinder {place} {words([region['radius'], *sorted(ends)])}"
    (low, low_radius), (high, high_radius) = sorted(zip(ends, (region["base_radius"], region["top_radius"])))
    return f"cone {place} {words([low_radius, high_radius, low, high])}"


def attracts(contact):
    law = contact["cohesion"]["law"]
    return law != "none" and contact["cohesion"][STRENGTH_OF_COHESION[law]] > 0


class Basis:
    """Tables of a scene, what was built of them, and its spheres by id.

    Atom types are counted from 1: first the materials, then the walls of grains, which are spheres that do not move.
    Raises RunError where the scene has what decks cannot say.
    """

    def __init__(self, simulation, stl_text):
        """`stl_text` writes corners and triangles as an STL file."""
        self.simulation, self.stl_text = simulation, stl_text
        self.scene, self.built = tomllib.loads(simulation.resolved), simulation._built(SIZE_CLASSES * IN_A_CLASS)
        self.materials, self.contacts, self.walls = (self.scene.get(key, []) for key in ("materials", "contact", "wall"))
        if any(contact["twisting_friction"] > 0 for contact in self.contacts):
            raise RunError("the scene has twisting_friction, which decks do not write: set it to 0")
        self.contact_of = {frozenset(contact["between"]): contact for contact in self.contacts}
        self.rolling = any(contact["rolling_friction"] > 0 for contact in self.contacts)
        self.attraction = any(map(attracts, self.contacts))
        self.duration, self.gravity = self.scene["time"]["duration"], simulation.gravity
        self.periodic = [axis in self.scene["world"]["periodic"] for axis in "xyz"]
        self.outlets = [(deck_id("outlet", k, table["name"]), region_words(table["region"]), table["name"])
                        for k, table in enumerate(self.scene.get("outlet", []))]
        self.pours = [Pour(self, k, table) for k, table in enumerate(self.scene.get("pour", []))]
        self.grain_walls = [k for k, wall in enumerate(self.walls) if wall["shape"] == "grains"]
        names = list(self.materials)
        self.type_materials = names + [self.walls[k]["material"] for k in self.grain_walls]
        of_spheres = {names[k] for k in set(simulation.materials().tolist())}
        of_spheres.update(kind.material for pour in self.pours for kind in pour.kinds)
        self.moving = [name for name in names if name in of_spheres]
        self.room = self.find_room()
        self.greatest_modulus = max(filter(math.isfinite, map(self.contact_modulus, self.contacts)), default=math.inf)
        self.modulus = self.find_modulus()

    def type(self, material):
        return self.type_materials.index(material) + 1

    def group(self, material):
        """The name of the group of the spheres of a material."""
        return deck_id("grains", self.type(material), material)

    def contact(self, one, other):
        """How two materials meet."""
        return self.contact_of.get(frozenset((one, other)), NO_CONTACT)

    def find_room(self):
        """The world, which is without end where nothing bounds it, cut off at a distance there."""
        contents, world, limits = self.built["contents"], self.built["world"], self.scene["world"]
        far = 0.5 * numpy.ptp(contents, axis=0).max() + 5.0 * self.built["diameters"][2]
        room = numpy.where(numpy.isfinite(world), world, contents + [[-far], [far]])
        return numpy.where(self.periodic, [limits["min"], limits["max"]], room)

    def contact_modulus(self, contact):
        """E* of two materials, infinite where they are rigid [Pa]."""
        one, other = (list(self.materials).index(name) for name in contact["between"])
        return self.built["moduli"][one, other]

    def find_modulus(self):
        """Young's, of the materials; where they have none, stiff enough for the spheres to lie on each other as high as
        they do at the start [Pa]."""
        if math.isfinite(self.greatest_modulus):
            return 2.0 * (1.0 - POISSON**2) * self.greatest_modulus
        down = numpy.where(self.periodic, 0.0, self.gravity)
        up = -unit(down) if norm(down) > 0 else numpy.array([0.0, 0.0, 1.0])
        heights = self.simulation.positions() @ up if self.simulation.count else numpy.zeros(1)
        density = max(material["density"] for material in self.materials.values())
        wanted = MODULUS_BY_PRESSURE * density * norm(self.gravity) * numpy.ptp(heights)
        if wanted <= LEAST_MODULUS:
            return LEAST_MODULUS
        digit = 10.0 ** (math.floor(math.log10(wanted)) - 1)
        return math.ceil(wanted / digit) * digit


@dataclass
class Kind:
    """The spheres of one material in a pour: their share of it by number, their mean volume [m³], and the diameters of up to
    eight classes of equal number, each with the mean volume of its spheres [m]."""

    material: str
    number: float
    mean_volume: float
    diameters: list


class Pour:
    """Spheres that come in: the table of the scene, their kinds, how many there are and how many a second."""

    def __init__(self, basis, index, table):
        self.table, self.index, self.name = table, index, table["name"] or f"pour {index}"
        self.id, self.region = deck_id("pour", index, self.name), region_words(table["region"])
        self.kinds = [Kind(one["material"], built["number"], built["mean_volume"], size_classes(built["drawn"]))
                      for one, built in zip(table.get("species") or [table], basis.built["pours"][index])]
        mean_mass = sum(kind.number * basis.materials[kind.material]["density"] * kind.mean_volume for kind in self.kinds)
        self.count = table["count"] or table["mass"] / mean_mass
        self.rate = table["rate"] or table["mass_rate"] / mean_mass


def size_classes(drawn):
    """The diameters of classes of equal number, of so many that were drawn, rising."""
    if drawn[0] == drawn[-1]:
        return drawn[:1]
    return numpy.cbrt((numpy.reshape(drawn, (SIZE_CLASSES, IN_A_CLASS)) ** 3).mean(axis=1)).tolist()
