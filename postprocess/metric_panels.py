# SPDX-License-Identifier: GPL-3.0-or-later
"""Which columns of metrics.csv belong into one chart, and what they are called."""
import re
from typing import NamedTuple


class Panel(NamedTuple):
    """A chart over time."""

    title: str
    label: str  # of the axis: a unit, or what is counted
    scale: str  # linear or log
    columns: dict  # of metrics.csv, with the name of each curve


RUN_PANELS = [
    Panel("Grains", "number", "linear", {"inserted": "inserted", "spheres": "inside", "left": "left"}),
    Panel("Contacts", "number", "linear", {"contacts": "contacts"}),
    Panel("Residual", "relative", "log", {"residual": "residual"}),
    Panel("Error of the solver, at looks", "share of mean force, of what contacts change", "log",
          {"force_error": "contact forces", "velocity_error_of_contacts": "velocities"}),
    Panel("Sweeps of a step", "number", "linear", {"sweeps": "sweeps"}),
    Panel("Overlap", "share of a diameter", "log", {"worst_overlap_d": "worst", "mean_overlap_d": "mean"}),
    Panel("Energy of motion and of contacts", "J", "log", {"kinetic_energy_J": "kinetic", "contact_energy_J": "contacts"}),
    Panel("Potential energy", "J", "linear", {"potential_energy_J": "potential"}),
]
# Unit by the end of a column's name, longer ends first; other columns are plain numbers.
UNITS = {"_m2_per_s2": "m²/s²", "_kg_per_s": "kg/s", "_m_per_s": "m/s", "_N_m": "N m", "_rad_per_s": "rad/s",
         "_deg": "degrees", "_kg": "kg",
         "_Pa": "Pa", "_m": "m", "_N": "N"}
COMPONENT = re.compile(r"_([xyz]{1,2})$")


def split_unit(column):
    """A column's name without its unit, and the unit."""
    ending = next((ending for ending in UNITS if column.endswith(ending)), "")
    return column.removesuffix(ending), UNITS.get(ending, "number")


def sensor_panels(run, columns):
    """One panel for each quantity of the sensors of the scene, whose columns are <sensor>_<quantity>_<unit>; the
    components of a vector or tensor, _x or _yz, go into one."""
    names = tuple(f"{sensor['name']}_" for sensor in run.scene().get("sensor", []))
    panels = {}
    for column in columns:
        if column.startswith(names):
            quantity, unit = split_unit(column)
            component = COMPONENT.search(quantity)
            title = COMPONENT.sub("", quantity).replace("_", " ")
            curves = panels.setdefault((title, unit), {})
            curves[column] = component[1] if component else title
    return [Panel(title, unit, "linear", curves) for (title, unit), curves in panels.items()]
