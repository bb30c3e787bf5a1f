# SPDX-License-Identifier: GPL-3.0-or-later
"""The deck for LIGGGHTS: contacts by pair_style gran, walls as triangles in STL files, pours by fix insert/rate/region."""
import math
from collections import defaultdict
from dataclasses import astuple, dataclass
from itertools import count, pairwise

import numpy

from decks.basis import POISSON, along_axis, deck_id, plain, unit, words
from decks.shared import (OUTLET_INTERVAL, Deck, boundary_words, common_notes, motion_commands, output_commands,
                          room_commands, run_commands)
from read_run import RunError

LEAST_RESTITUTION = 0.051  # LIGGGHTS takes none up to 0.05
AT_ONCE = 5.0  # spheres of a pour: some, or they would hardly be a mixture; but not so many that they find no room
ROUND = ("cylinder", "cone", "disk")


@dataclass
class Moment:
    """What is done at a moment, in the order in which LIGGGHTS can do it."""

    end_contacts: str = ""
    end_motions: str = ""
    end_walls: str = ""
    begin_walls: str = ""
    begin_contacts: str = ""
    begin_rest: str = ""


def liggghts_deck(basis):
    """The deck without its head. Raises RunError where the scene has cohesion."""
    if basis.attraction:
        raise RunError("the scene has cohesion; LIGGGHTS has none whose force is a given one (its sjkr goes with the area "
                       "of the overlap), so there is no deck of it")
    deck = Deck(notes=common_notes(basis) + notes_on_contacts(basis))
    moments, seeds = defaultdict(Moment, {0.0: Moment()}), primes_after(100000)
    deck.text = f"""
atom_style granular
atom_modify map array
{boundary_words(basis)}
newton off
communicate single vel yes
units si
{room_commands(basis)}
{property_commands(basis)}\
pair_style {model_words(basis)}
pair_coeff * *

{motion_commands(basis)}
"""
    add_walls(basis, deck, moments)
    for pour in basis.pours:
        add_pour(basis, pour, seeds, deck, moments)
    deck.text += "\n" + output_commands(basis, deck.notes)
    every = "".join(f" \"delete_atoms region {id} compress no\"" for id, region, _ in basis.outlets if region)
    if every:
        deck.text += f"variable look equal ceil({OUTLET_INTERVAL}/${{step}})\n"
        every = " every ${look}" + every
    deck.text += "\n" + run_commands(basis, {time: "".join(astuple(moment)) for time, moment in moments.items()}, every)
    return deck


def primes_after(number):
    """Prime numbers: LIGGGHTS takes no other seeds."""
    return (one for one in count(number + 1) if all(one % divisor for divisor in range(2, math.isqrt(one) + 1)))


def notes_on_contacts(basis):
    notes = []
    if any(contact["restitution"] < LEAST_RESTITUTION for contact in basis.contacts):
        notes.append(f"restitutions below {LEAST_RESTITUTION} are {LEAST_RESTITUTION}: LIGGGHTS takes none up to 0.05")
    if basis.rolling:
        notes.append("rolling friction is LIGGGHTS' spring and slider (epsd2): the same largest torque, which it reaches "
                     "only after some rolling")
    return notes


def property_commands(basis):
    """Properties of materials and of their pairs, in the one form that LIGGGHTS reads."""
    names = basis.type_materials
    text = (f"fix modulus all property/global youngsModulus peratomtype{' ${modulus}' * len(names)}\n"
            f"fix poisson all property/global poissonsRatio peratomtype{f' {POISSON}' * len(names)}\n")

    def pairs(fix, name, value):
        values = "".join(f" {plain(value(basis.contact(one, other)))}" for one in names for other in names)
        return f"fix {fix} all property/global {name} peratomtypepair {len(names)}{values}\n"

    text += pairs("rebound", "coefficientRestitution", lambda contact: max(contact["restitution"], LEAST_RESTITUTION))
    text += pairs("rubbing", "coefficientFriction", lambda contact: contact["friction"])
    if basis.rolling:
        text += pairs("rolling", "coefficientRollingFriction", lambda contact: contact["rolling_friction"])
    return text


def model_words(basis):
    """The words for the model of contacts."""
    return "gran model hertz tangential history" + (" rolling_friction epsd2" if basis.rolling else "")


def add_walls(basis, deck, moments):
    meshes = []  # walls that come as triangles, each with its name in the deck
    for k, (wall, built) in enumerate(zip(basis.walls, basis.built["walls"])):
        if wall["shape"] == "grains":
            continue  # they are in the data file
        id, kind = deck_id("wall", k, wall["name"]), basis.type(wall["material"])
        begin, end = wall["appear_at"], wall["remove_at"]
        if primitive := primitive_words(wall):
            moments[begin].begin_rest += f"fix {id} all wall/{model_words(basis)} primitive type {kind} {primitive}\n"
            moments[end].end_contacts += f"unfix {id}\n"
            continue
        deck.files[f"{id}.stl"] = basis.stl_text(*surface_of(wall, built, basis.room))
        meshes.append((wall, id))
        moments[begin].begin_walls += f"fix {id} all mesh/surface file {id}.stl type {kind}\n"
        add_motion(wall, id, min(end, basis.duration), moments, deck.notes)
        moments[end].end_walls += f"unfix {id}\n"
    add_contacts(basis, meshes, moments, deck.notes)
    if any(wall["shape"] in ROUND for wall, _ in meshes):
        deck.notes.append("round walls have 64 flat sides")


def primitive_words(wall):
    """"zplane 0.1" for a plane that stands still across an axis, which LIGGGHTS has without triangles; else None."""
    if wall["shape"] != "plane" or wall["motion"]:
        return None
    placed = along_axis(wall["point"], wall["normal"])
    return placed and f"{'xyz'[placed[0]]}plane {wall['point'][placed[0]]:.10g}"


def surface_of(wall, built, room):
    """Corners and triangles of a wall as it stands when it comes [m]."""
    corners, triangles = part_in(room, wall) if wall["shape"] == "plane" else (built["corners"], built["triangles"])
    return corners @ built["rotation"].T + built["shift"], triangles


def part_in(room, plane):
    """The part of a plane that lies in the room: LIGGGHTS loses triangles whose middle does not."""
    point, normal, center = plane["point"], unit(plane["normal"]), room.mean(axis=0)
    center = center - (center - point) @ normal * normal
    across = numpy.array([-normal[1], normal[0], 0.0] if normal[:2].any() else [0.0, -normal[2], 0.0])
    u = numpy.linalg.norm(room[1] - room[0]) * unit(across)
    v = numpy.cross(normal, u)
    polygon = [center - u - v, center + u - v, center + u + v, center - u + v]
    for axis in numpy.eye(3):
        polygon = cut(cut(polygon, room[0], axis), room[1], -axis)
    return numpy.reshape(polygon, (-1, 3)), [(0, k - 1, k) for k in range(2, len(polygon))]


def cut(polygon, point, normal):
    """The part of a polygon on the side of a plane to which its normal points."""
    inside = []
    for here, there in pairwise([*polygon, *polygon[:1]]):
        a, b = (here - point) @ normal, (there - point) @ normal
        if a >= 0:
            inside.append(here)
        if (a >= 0) != (b >= 0):
            inside.append(here + a / (a - b) * (there - here))
    return inside


def moves(part):
    """A part of a motion as `fix move/mesh` calls it: when each of its own begins and ends, and its words."""
    if part["kind"] == "table":
        return [(begin, end, f"linear {words(numpy.subtract(there, here) / (end - begin))}")
                for (begin, *here), (end, *there) in pairwise(part["table"])]
    if part["kind"] == "translate":
        move = f"linear {words(part['velocity'])}"
    elif part["kind"] == "shake":
        move = f"wiggle amplitude {words(part['amplitude'])} period {1.0 / part['frequency']:.10g}"
    elif rate := part["rate"]:
        axis = math.copysign(1.0, rate) * unit(part["axis"])
        move = f"rotate origin {words(part['point'])} axis {words(axis)} period {2.0 * math.pi / abs(rate):.10g}"
    else:
        return []
    return [(part["from"], part["to"], move)]


def add_motion(wall, id, gone, moments, notes):
    for k, (begin, end, move) in enumerate(one for part in wall["motion"] for one in moves(part)):
        since, until = max(begin, wall["appear_at"]), min(end, gone)
        if since >= until:
            continue
        moments[since].begin_rest += f"fix {id}_move{k} all move/mesh mesh {id} {move}\n"
        moments[until].end_motions = f"unfix {id}_move{k}\n" + moments[until].end_motions  # in the opposite order
        if move.startswith("wiggle") and since > begin:
            notes.append(f"the wall '{wall['name']}' begins to shake when it appears, not before")
    if len(wall["motion"]) > 1:
        notes.append(f"the parts of the motion of '{wall['name']}' are laid over each other as LIGGGHTS does it")


def add_contacts(basis, meshes, moments, notes):
    """One fix for the contacts of all walls of triangles that stand, which is all that LIGGGHTS has; anew whenever one comes
    or goes."""
    there = []
    for time, moment in sorted(moments.items()):
        if time >= basis.duration or not (moment.begin_walls or moment.end_walls):
            continue
        if there:
            moment.end_contacts += "unfix contacts\n"
            notes.append(f"at {time:.4g} s friction at the walls begins anew: LIGGGHTS has one fix for all that are made of "
                         "triangles")
        there = [id for wall, id in meshes if wall["appear_at"] <= time < wall["remove_at"]]
        if there:
            moment.begin_contacts = (f"fix contacts all wall/{model_words(basis)} mesh n_meshes {len(there)} "
                                     f"meshes {' '.join(there)}\n")


def add_pour(basis, pour, seeds, deck, moments):
    if not pour.region:
        deck.notes.append(f"the pour '{pour.name}' is left out: its region is none that LIGGGHTS knows")
        return
    deck.text += f"region {pour.id} {pour.region} units box\n"
    sizes = [(kind, diameter) for kind in pour.kinds for diameter in kind.diameters]
    shares = ""
    for k, (kind, diameter) in enumerate(sizes):
        density = plain(basis.materials[kind.material]["density"])
        deck.text += (f"fix {pour.id}_size{k} {basis.group(kind.material)} particletemplate/sphere {next(seeds)} atom_type "
                      f"{basis.type(kind.material)} density constant {density} radius constant {0.5 * diameter:.10g}\n")
        shares += f" {pour.id}_size{k} {kind.number / len(kind.diameters):.10g}"
    deck.text += f"fix {pour.id}_sizes all particledistribution/discrete/numberbased {next(seeds)} {len(sizes)}{shares}\n"
    deck.text += f"variable {pour.id}_every equal ceil({AT_ONCE / pour.rate:.6g}/${{step}})\n"
    velocity = " ".join(map(plain, pour.table["velocity"]))
    moments[pour.table["start"]].begin_rest += (
        f"fix {pour.id} all insert/rate/region seed {next(seeds)} distributiontemplate {pour.id}_sizes nparticles "
        f"{pour.count:.0f} particlerate {pour.rate:.10g} insert_every ${{{pour.id}_every}} overlapcheck yes all_in yes "
        f"vel constant {velocity} region {pour.id}\n")
    deck.notes.append(f"the pour '{pour.name}' lets other spheres in at other places, of up to eight sizes a kind, "
                      f"{AT_ONCE:.0f} at a time")
