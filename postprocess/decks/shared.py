# SPDX-License-Identifier: GPL-3.0-or-later
"""What both decks say in the same words: spheres as they lie, the room, outlets, sensors of mass flow, frames. Contacts are
springs there: Hertz and Mindlin, damped as the restitution asks, with one Young's modulus that is the deck's own."""
import math
import textwrap
from dataclasses import dataclass, field

import numpy
from numpy.linalg import norm

from decks.basis import POISSON, box_words, deck_id, unit, words

OUTLET_INTERVAL = 0.02  # s, between looks at outlets
GRAIN_WEIGHT = 1e6  # of grains of walls, so that a sphere feels something that does not give way


@dataclass
class Deck:
    """A deck as it is put together: its commands, its other files by name, and what it cannot say."""

    text: str = ""
    files: dict = field(default_factory=dict)
    notes: list = field(default_factory=list)


def head(basis, origin, command, notes):
    """The beginning of a deck: what it is and what it cannot say."""
    text = f"""# {basis.scene['title']}
# {origin}; SI units. To be run in this folder: {command}
#
# Contacts are springs here: Hertz and Mindlin, damped as the restitution asks. A larger modulus makes
# overlaps smaller and steps shorter: -var modulus 5e7. A step is a fifth of Rayleigh's time.
"""
    if notes:
        text += "#\n# Not, or not quite, as in Talus:\n"
    broken = textwrap.TextWrapper(101, "#  - ", "#    ", break_long_words=False, break_on_hyphens=False)
    return text + "".join(f"{broken.fill(note)}\n" for note in notes)


def spheres_file(basis):
    """The spheres and grains at the start as a data file of atom style sphere."""
    one, materials = basis.simulation, list(basis.materials.values())
    rows = [(kind + 1, [2.0 * radius, materials[kind]["density"], *place], [*velocity, *spin])
            for kind, radius, place, velocity, spin in zip(
                one.materials().tolist(), one.radii().tolist(), one.positions().tolist(), one.velocities().tolist(),
                one.angular_velocities().tolist())]
    for kind, k in enumerate(basis.grain_walls, len(materials) + 1):
        wall, centers = basis.walls[k], basis.built["walls"][k]["corners"]
        density = GRAIN_WEIGHT * basis.materials[wall["material"]]["density"]
        rows += [(kind, [wall["diameter"], density, *center], [0] * 6) for center in centers.tolist()]
    text = f"Spheres by id\n\n{len(rows)} atoms\n{len(basis.type_materials)} atom types\n\n"
    text += "".join(f"{words(basis.room[:, d])} {axis}lo {axis}hi\n" for d, axis in enumerate("xyz"))
    text += "\nAtoms\n\n" + "".join(f"{id} {kind} {words(numbers)}\n" for id, (kind, numbers, _) in enumerate(rows, 1))
    velocities = "".join(f"{id} {words(motion)}\n" for id, (*_, motion) in enumerate(rows, 1))
    return text + (f"\nVelocities\n\n{velocities}" if rows else "")


def boundary_words(basis):
    return "boundary" + "".join(" p" if periodic else " f" for periodic in basis.periodic)


def room_commands(basis):
    """The room with its spheres, the variables `modulus`, `step` and `t`, and a group for each material that moves."""
    least, mean, largest = basis.built["diameters"]
    if basis.simulation.count or basis.grain_walls:
        text = "read_data spheres.data\n"
    else:
        text = f"region room {box_words(*basis.room)} units box\ncreate_box {len(basis.type_materials)} room\n"
    # Lists take long where a sphere reaches over many: there they are made to last.
    skin = min(max(0.1 * largest, 0.2 * mean), mean)
    pages = " page 2000000 one 20000" if largest > 3.0 * least else ""
    density = min(basis.materials[material]["density"] for material in basis.moving)
    text += f"""neighbor {skin:.4g} bin
neigh_modify delay 0{pages}

variable modulus index {basis.modulus:.4g}
variable step equal 0.2*PI*{0.5 * least:.6g}*sqrt({density:.6g}*2*(1+{POISSON})/${{modulus}})/(0.1631*{POISSON}+0.8766)
timestep ${{step}}
variable t equal step*${{step}}
"""
    return text + "".join(f"group {basis.group(material)} type {basis.type(material)}\n" for material in basis.moving)


def motion_commands(basis):
    """Gravity and integration."""
    gravity, style = norm(basis.gravity), "nve/sphere" if basis.scene["world"]["rotation"] else "nve"
    text = f"fix weight all gravity {gravity:.10g} vector {words(unit(basis.gravity))}\n" if gravity > 0 else ""
    text += "".join(f"fix motion{basis.type(material)} {basis.group(material)} {style}\n" for material in basis.moving)
    grains = range(len(basis.materials) + 1, len(basis.type_materials) + 1)
    return text + "".join(f"neigh_modify exclude type {kind} {kind}\n" for kind in grains)


def steps(basis, name, interval):
    """A variable with the steps in an interval, never longer than the run, so that it is a whole number even for inf."""
    return f"variable {name} equal ceil({min(interval, basis.duration):.10g}/${{step}})\n"


def output_commands(basis, notes):
    """Frames, regions of the outlets, sensors of mass flow. Adds what it leaves out to the notes."""
    text = f"""{steps(basis, "frame", basis.scene["time"]["frame_interval"])}\
dump frames all custom ${{frame}} frames.lammpstrj id type radius x y z vx vy vz omegax omegay omegaz
dump_modify frames sort id
thermo ${{frame}}
thermo_modify lost ignore
"""
    for id, region, name in basis.outlets:
        if region:
            text += f"region {id} {region} units box\n"
        else:
            notes.append(f"the outlet '{name}' is left out: its region is none that the program knows")
    flows = ""
    for k, sensor in enumerate(basis.scene.get("sensor", [])):
        if sensor["kind"] == "mass_flow":
            flows += flow_commands(basis, sensor, deck_id("flow", k, sensor["name"]), notes)
        else:
            notes.append(f"the sensor '{sensor['name']}' of kind {sensor['kind']} is left out: measure it on the frames")
    return text + (steps(basis, "sample", basis.scene["time"]["metrics_interval"]) if flows else "") + flows


def flow_commands(basis, sensor, id, notes):
    masses = "+".join(f"mass({basis.group(material)},{id})" for material in basis.moving)
    round_again = " or comes round along a periodic axis" if any(basis.periodic) else ""
    notes.append(f"the sensor '{sensor['name']}' is {id}.txt, with the mass that is still before its plane: the flow is "
                 f"minus its slope, but for what is poured in{round_again}")
    return f"""region {id} plane {words([*sensor["point"], *-unit(sensor["normal"])])} units box
variable {id} equal {masses}
fix {id} all print ${{sample}} "${{t}} ${{{id}}}" file {id}.txt screen no title "time_s mass_before_kg"
"""


def run_commands(basis, timeline, every=""):
    """Commands by the time at which they are due [s], up to the end of the run, with the runs in between, to each of which
    `every` is added."""
    times, text = sorted(time for time in timeline if time < basis.duration), ""
    for time, end in zip(times, [*times[1:], basis.duration]):
        text += (f"\n# t = {time:.6g} s\n" if time > 0 else "") + timeline[time]
        text += f"variable until equal ceil({end:.10g}/${{step}})\nrun ${{until}} upto{every}\n"
    return text


def common_notes(basis):
    """What neither program can say of the scene."""
    notes = [f"the stiffness {contact['stiffness']:.4g} N/m of the contact {'-'.join(contact['between'])} is left out: it "
             "is that of the modulus" for contact in basis.contacts if math.isfinite(contact["stiffness"])]
    if any(basis.contact_modulus(contact) < basis.greatest_modulus < math.inf for contact in basis.contacts):
        notes.append("all contacts have the modulus of the stiffest two materials")
    for wall in basis.walls:
        name, of_grains = wall["name"], wall["shape"] == "grains"
        if math.isfinite(wall.get("mass", math.inf)):
            notes.append(f"the wall '{name}' of finite mass stands still: forces do not move it")
        elif of_grains and wall["motion"]:
            notes.append(f"the wall '{name}' stands still: grains of a wall do not move in the deck")
        elif of_grains and (wall["appear_at"] > 0 or wall["remove_at"] < basis.duration):
            notes.append(f"the wall '{name}' is there all the time: grains of a wall neither come nor go in the deck")
    if not (numpy.isfinite(basis.built["world"]).all(axis=0) | basis.periodic).all():
        ends = ", ".join(f"{axis} {low:.4g} to {high:.4g}" for axis, low, high in zip("xyz", *basis.room))
        notes.append(f"the room ends at {ends} m, and what leaves it is gone")
    return notes
