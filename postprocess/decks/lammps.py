# SPDX-License-Identifier: GPL-3.0-or-later
"""The deck for LAMMPS: contacts by pair_style granular, walls as the surfaces of regions, pours by fix pour."""
import math
from collections import defaultdict
from itertools import combinations_with_replacement, pairwise

import numpy
from numpy.linalg import norm

from decks.basis import POISSON, attracts, box_words, deck_id, plain, region_words, unit, words
from decks.mesh_parts import plates, round_parts
from decks.shared import (OUTLET_INTERVAL, Deck, boundary_words, common_notes, motion_commands, output_commands,
                          room_commands, run_commands)
from read_run import RunError

ADHESION = {"dmt": 0.5, "jkr": 0.375}  # the surface energy γ that pulls as w does, with 4πγR*, by w
DENSEST = 0.3  # share of a region that fills at random, at once
X, Y, Z = range(3)


def lammps_deck(basis):
    """The deck without its head. Raises RunError where LAMMPS has no such cohesion."""
    deck, timeline = Deck(notes=common_notes(basis)), defaultdict(str, {0.0: ""})
    deck.text = f"""
units si
atom_style sphere
{boundary_words(basis)}
newton off
comm_modify vel yes
{room_commands(basis)}
{pair_commands(basis, deck.notes)}
{motion_commands(basis)}
"""
    add_walls(basis, deck, timeline)
    for pour in basis.pours:
        add_pour(basis, pour, deck, timeline)
    deck.text += "\n" + output_commands(basis, deck.notes)
    for id, region, _ in basis.outlets:
        if region:
            deck.text += (f"variable look equal ceil({OUTLET_INTERVAL}/${{step}})\n"
                          f"fix {id} all evaporate ${{look}} 100000000 {id} 4711\n")
    deck.text += "\n" + run_commands(basis, timeline)
    return deck


def surface_energy(contact):
    """γ of two materials that attract each other [J/m²], else 0."""
    cohesion = contact["cohesion"]
    if not attracts(contact):
        return 0.0
    if cohesion["law"] not in ADHESION:
        raise RunError("the scene has cohesion of a law other than dmt and jkr, which LAMMPS does not have, so there is "
                       "no deck of it")
    return ADHESION[cohesion["law"]] * cohesion["work_of_adhesion"]


def contact_words(basis, one, other):
    """A contact of two materials in the words of `pair_style granular` and `wall/gran`."""
    contact = basis.contact(one, other)
    energy, law = surface_energy(contact), f"${{modulus}} {plain(contact['restitution'])} {POISSON}"
    normal = f"dmt {law} {energy:.10g}" if energy > 0 else f"hertz/material {law}"
    text = f"{normal} tangential mindlin NULL 1.0 {plain(contact['friction'])} damping tsuji"
    if basis.rolling:
        text += f" rolling sds ${{rolling_stiffness}} ${{rolling_damping}} {plain(contact['rolling_friction'])}"
    return text


def pair_commands(basis, notes):
    """Commands for the contacts between spheres. Adds what is different to the notes."""
    text = ""
    if basis.rolling:
        diameter = basis.built["diameters"][1]
        mass = next(iter(basis.materials.values()))["density"] * math.pi / 6.0 * diameter**3
        # The spring is 0.4 times as stiff as the normal contact of two mean spheres at an overlap of 1 % of a diameter.
        text += (f"variable rolling_stiffness equal 0.04*{diameter:.6g}*${{modulus}}/(2*(1-{POISSON}^2))\n"
                 f"variable rolling_damping equal 0.6*sqrt(0.5*{mass:.6g}*v_rolling_stiffness)\n")
        notes.append("rolling friction is LAMMPS' spring, dashpot and slider (rolling sds): the same largest torque, which "
                     "it reaches only after some rolling")
    if basis.attraction:
        notes.append("adhesion is LAMMPS' dmt: the same force while two overlap, and none beyond")
    pairs = combinations_with_replacement(enumerate(basis.type_materials, 1), 2)
    return text + "pair_style granular\n" + "".join(
        f"pair_coeff {a} {b} {contact_words(basis, one, other)}\n" for (a, one), (b, other) in pairs)


def add_walls(basis, deck, timeline):
    for k, (wall, built) in enumerate(zip(basis.walls, basis.built["walls"])):
        if wall["shape"] == "grains":
            continue  # they are in the data file
        name, id = wall["name"], deck_id("wall", k, wall["name"])
        regions = wall_regions(wall, built, 1e-3 * basis.built["diameters"][1], deck.notes)
        if not regions:
            deck.notes.append(f"the wall '{name}' is left out: LAMMPS has " + (
                "no walls of triangles, and it is neither round an axis x, y or z nor of rectangles with a level edge"
                if wall["shape"] == "mesh" else "round walls along x, y and z only"))
            continue
        if wall["shape"] == "box" and not wall["open"]:
            deck.notes.append(f"the box '{name}' is felt from inside only")
        motion = motion_words(wall, id, deck)
        for r, region in enumerate(regions):
            part = f"{id}_part{r}" if len(regions) > 1 else id
            deck.text += f"region {part} {region}{motion} units box\n"
            for material in basis.moving:
                fix, law = f"{part}_{basis.type(material)}", contact_words(basis, material, wall["material"])
                timeline[wall["appear_at"]] += (
                    f"fix {fix} {basis.group(material)} wall/gran/region granular {law} region {part}\n")
                timeline[wall["remove_at"]] += f"unfix {fix}\n"


def wall_regions(wall, built, thickness, notes):
    """The regions whose surface a wall is; none where there are no such. An open region is a thin wall with two sides, and
    with rims; what is flat becomes a body of this thickness [m]."""
    shape, ends = wall["shape"], " open 1 open 2"
    if shape == "plane":
        return [f"plane {words([*wall['point'], *unit(wall['normal'])])}"]
    if shape == "box":
        faces = "".join(f" open {2 * 'xyz'.index(face[0]) + (2 if face[1] == '+' else 1)}" for face in wall["open"])
        return [box_words(wall["min"], wall["max"]) + faces]
    if shape == "mesh":
        return mesh_regions(wall, built, thickness, notes)
    if shape == "disk":
        # A plate is the outside of a cylinder that is nearly flat. A ring is no region, but a cone that is nearly flat is
        # one; near its axis LAMMPS would take it for a sharp tip.
        shape, ends = ("cone", ends) if wall["hole_radius"] > 0 else ("cylinder", " side out")
        wall = {"base": wall["center"] - 0.5 * thickness * unit(wall["normal"]), "axis": wall["normal"], "height": thickness,
                "base_radius": wall["hole_radius"], "top_radius": wall["radius"], "radius": wall["radius"]}
    elif shape == "cone" and wall["base_radius"] == wall["top_radius"]:
        shape, wall = "cylinder", wall | {"radius": wall["top_radius"]}
    text = region_words(wall | {"shape": shape})
    return [text + ends] if text else []


def mesh_regions(wall, built, thickness, notes):
    parts, sag = round_parts(built["corners"], built["triangles"])
    if parts:
        notes.append(f"the mesh '{wall['name']}' is round: the circles through its corners, which lie up to {1e3 * sag:.2g} "
                     "mm outside its triangles")
        return [region for part in parts for region in wall_regions(part, None, thickness, notes)]
    regions = [plate_words(*plate, thickness) for plate in plates(built["corners"], built["triangles"])]
    return regions if all(regions) else []


def plate_words(corner, level, other, thickness):
    """A plate as a flat parallelepiped, of which LAMMPS wants the first edge along x and the second across z; None where
    no edge is level."""
    small = 1e-6 * max(norm(level), norm(other))
    is_level = max(abs(level[Z]), abs(other[Z])) < small
    to_vanish = Y if is_level else Z
    if abs(level[to_vanish]) >= small:
        level, other = other, level
    if abs(level[to_vanish]) >= small:
        return None
    along_x = abs(level[Y]) < small
    corner, level = forward(corner, level, X if along_x else Y)
    corner, other = forward(corner, other, Y if is_level else Z)
    across = Z if is_level else Y if along_x else X
    thin = numpy.zeros(3)
    thin[across] = thickness / abs(unit(numpy.cross(level, other))[across])
    a, b, c = numpy.insert([level, other], across, thin, axis=0)
    x, y, z = corner - 0.5 * thin
    return f"prism {words([x, x + a[X], y, y + b[Y], z, z + c[Z], b[X], c[X], c[Y]])} side out"


def forward(corner, edge, d):
    """Where an edge begins, and the edge: at its other end where it goes back along the axis."""
    return (corner, edge) if edge[d] > 0 else (corner + edge, -edge)


def elapsed(begin, end):
    """How long a part of a motion has gone on, as a formula of `t`."""
    since = "(v_t>{0:.10g})*(v_t-{0:.10g})".format
    return f"({since(begin)}-{since(end)})" if math.isfinite(end) else f"({since(begin)})"


def shift_terms(part):
    """How far a part of a motion shifts a wall: vectors, each with the formula of time that it goes with."""
    if part["kind"] == "translate":
        return [(part["velocity"], elapsed(part["from"], part["to"]))]
    if part["kind"] == "shake":
        return [(part["amplitude"], f"sin(2*PI*{part['frequency']:.10g}*{elapsed(part['from'], part['to'])})")]
    return [(part["table"][0][1:], "1")] + [(numpy.subtract(there, here) / (end - begin), elapsed(begin, end))
                                            for (begin, *here), (end, *there) in pairwise(part["table"])]


def motion_words(wall, id, deck):
    """The end of the command of a region that moves: it turns, and then shifts. Its variables go to the deck's text."""
    turns = [part for part in wall["motion"] if part["kind"] == "turn"]
    if any(part["kind"] == "turn" for part in wall["motion"][1:]):
        deck.notes.append(f"the wall '{wall['name']}' stands still: LAMMPS turns a wall once, and shifts it after that")
        return ""
    terms = [term for part in wall["motion"] if part not in turns for term in shift_terms(part)]
    text, names = "", []
    for d, axis in enumerate("xyz"):
        formula = "+".join(f"{factor[d]:.10g}*{formula}" for factor, formula in terms if factor[d] != 0)
        names.append(f"v_{id}_{axis}" if formula else "NULL")
        deck.text += f"variable {id}_{axis} equal {formula}\n" if formula else ""
    if names != ["NULL"] * 3:
        text += f" move {' '.join(names)}"
    for turn in turns:
        deck.text += f"variable {id}_angle equal {turn['rate']:.10g}*{elapsed(turn['from'], turn['to'])}\n"
        text += f" rotate v_{id}_angle {words([*turn['point'], *unit(turn['axis'])])}"
    return text


def objection(pour, gravity):
    """Why `fix pour` cannot do a pour; nothing where it can."""
    region = pour.table["region"]
    if not (gravity[Z] < 0 and gravity[X] == gravity[Y] == 0):
        return "LAMMPS pours along -z only, and gravity is elsewhere"
    upright = region["shape"] == "cylinder" and abs(unit(region["axis"])[Z]) > 1.0 - 1e-12
    if not upright and region["shape"] != "box":
        return "LAMMPS pours into boxes and upright cylinders only"
    return "LAMMPS pours downwards only" if pour.table["velocity"][Z] > 0 else ""


def height_and_volume(region):
    """Of a box or an upright cylinder [m, m³]."""
    if region["shape"] == "cylinder":
        return region["height"], math.pi * region["radius"] ** 2 * region["height"]
    extent = numpy.subtract(region["max"], region["min"])
    return extent[Z], extent.prod()


def add_pour(basis, pour, deck, timeline):
    if why_not := objection(pour, basis.gravity):
        deck.notes.append(f"the pour '{pour.name}' is left out: {why_not}")
        return
    deck.text += f"region {pour.id} {pour.region} units box\n"
    (x, y, z), gravity, (height, room) = pour.table["velocity"], norm(basis.gravity), height_and_volume(pour.table["region"])
    burst = (math.sqrt(z * z + 2.0 * gravity * height) + z) / gravity  # in which a sphere falls through the region [s]
    for s, kind in enumerate(pour.kinds):
        rate = pour.rate * kind.number
        at_once = min(max(rate * burst, 1.0), max(1.0, math.floor(DENSEST * room / kind.mean_volume)))
        if abs(at_once / burst - rate) > 0.05 * rate:
            deck.notes.append(f"the pour '{pour.name}' comes in at {at_once / burst:.3g} spheres a second of "
                              f"{kind.material}, not at {rate:.3g}: LAMMPS lets a burst in whenever the last "
                              "has fallen through the region")
        sizes = " ".join(f"{diameter:.10g} {plain(1 / len(kind.diameters))}" for diameter in kind.diameters)
        type, density = basis.type(kind.material), plain(basis.materials[kind.material]["density"])
        share = (at_once + 0.5) * kind.mean_volume / room  # half a sphere more than wanted, as LAMMPS rounds down
        timeline[pour.table["start"]] += (
            f"fix {pour.id}_{s} {basis.group(kind.material)} pour {pour.count * kind.number:.0f} {type} "
            f"{4711 + 10 * pour.index + s} region {pour.id} diam poly {len(kind.diameters)} {sizes} "
            f"dens {density} {density} vol {share:.6g} 100 vel {plain(x)} {plain(x)} {plain(y)} {plain(y)} {plain(z)}\n")
    deck.notes.append(f"the pour '{pour.name}' comes in bursts of spheres at random places, of up to eight sizes a kind")
