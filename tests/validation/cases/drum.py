# SPDX-License-Identifier: GPL-3.0-or-later
"""7. Rotating drum: the angle of the surface against the Froude number; power in = dissipation.

Laws: half filled and at Froude numbers ω²R/g of 1e-4 to 1e-2 a bed flows without end under a flat surface ("rolling";
Oba & Otsuki 2024, arXiv 2407.19466), at an angle that rises with the Froude number. When it is slow the angle lies
between that at which beads come to rest and that at which they avalanche, 22 ± 0.5° and 27.4 ± 0.5° for glass beads
(Lajeunesse, Mangeney-Castelnau & Vilotte 2004, Phys. Fluids 16, 2371, as quoted by Kumar 2015, thesis, Cambridge). Exact
are: the torque on the drum is weight times the horizontal offset of the centre of mass; torque times rate is the work
that the wall does; in a steady state that is what the beads dissipate.

Parameters: drum 40 beads wide, 11 long and periodic, friction 0.5, restitution 0.5; averages over 0.2, 0.6 and 2 rad.
It was half as long first, where the angle at 1e-3 swung by 1.08 ± 0.20°: surges of a second average out along the drum.

Tolerances, fixed before the runs:
- angle at 1e-4 and 1e-3: from 21.5 to 27.9°. At 1e-2: 22 to 30°, from memory. It rises from 1e-4 to 1e-2.
- scatter of the angle at 1e-3, one sample to the other: below 1°, from memory.
- torque / (weight × offset): 1 ± 1 %, for frames only every 0.05 s. Torque × rate / work, whole run: 1 ± 0.5 %.
- dissipation / power in, at 1e-2, where the drum turns by a third of a turn while it is averaged: 1 ± 2 %.
"""
import math
from typing import NamedTuple

import numpy

from case import Row, over_seeds
from deck import spheres_of
from measures import volumes

TITLE = "rotating drum"
FINDINGS = ""
RADIUS, GRAVITY, DENSITY = 0.1, 9.81, 2500.0  # as in scenes/turning_drum.toml
FAST, BEGIN, SLOW = 1.0, 0.3, 0.8  # rad/s, s: the first turn, and from when to when
WINDOWS = {1e-4: (2.0, 4.0), 1e-3: (1.5, 3.5), 1e-2: (2.0, 4.0)}  # s
LAJEUNESSE = "22 to 27.4 (glass beads, Lajeunesse et al. 2004)"


class Steady(NamedTuple):
    """What a run has in its window."""
    angle: numpy.ndarray  # of each sample [degree]
    balance: float  # torque / (weight × offset of the centre of mass)
    dissipation: float  # / (torque × rate)
    work: float  # torque × rate / work of the wall, of the whole run


def rate(froude):
    return math.sqrt(froude * GRAVITY / RADIUS)


def turned_at(froude):
    begin, end = WINDOWS[froude]
    return over_seeds(f"drum_{froude:g}", "turning_drum",
                      {"wall.drum.motion.1.rate": rate(froude), "time.duration": end, "sensor.surface.from": begin,
                       "sensor.drive.from": begin})


RUNS = [run for froude in WINDOWS for run in turned_at(froude)]


def offset_moment(spheres):
    """Weight times the offset of the centre of mass, upwards on the side that the drum lifts [N m]."""
    return -GRAVITY * DENSITY * float(volumes(spheres.radii) @ spheres.positions[:, 0])


def steady(run, froude):
    metrics = run.metrics()
    time, torque = metrics["time_s"], -metrics["drive_torque_y_N_m"]
    energy = sum(metrics[f"{kind}_energy_J"] for kind in ("kinetic", "potential", "contact"))
    begin = WINDOWS[froude][0]
    inside = time >= begin
    power = torque[inside].mean() * rate(froude)
    stored = (energy[-1] - energy[inside][0]) / (time[-1] - time[inside][0])
    steps = numpy.diff(time, prepend=0)
    middle = time - 0.5 * steps  # a torque is the mean since the sample before
    rates = numpy.where(middle > SLOW, rate(froude), numpy.where(middle > BEGIN, FAST, 0.0))
    moments = [offset_moment(spheres) for spheres in spheres_of(run) if spheres.time >= begin]
    return Steady(metrics["surface_angle_deg"][inside], torque[inside].mean() / numpy.mean(moments),
                  1 - stored / power,
                  float(torque @ (rates * steps)) / run.summary()["error"]["energy"]["put_in"])


def judge(runs):
    found = {froude: [steady(runs[run.name], froude) for run in turned_at(froude)] for froude in WINDOWS}
    angles = {froude: [float(one.angle.mean()) for one in found[froude]] for froude in WINDOWS}
    for froude, source, low, high in ((1e-4, LAJEUNESSE, 21.5, 27.9), (1e-3, LAJEUNESSE, 21.5, 27.9),
                                      (1e-2, "22 to 30 (from memory)", 22.0, 30.0)):
        yield Row(f"Froude number {froude:g}: angle [°]", source, f"{low:g} to {high:g}", low, high,
                  tuple(angles[froude]))
    yield Row("angle at 0.01 less that at 0.0001 [°]", "above 0", "above 0", 0.0, math.inf,
              tuple(fast - slow for fast, slow in zip(angles[1e-2], angles[1e-4])))
    yield Row("Froude number 0.001: standard deviation of the angle [°]", "below 1 (from memory)", "up to 1", 0.0, 1.0,
              tuple(float(one.angle.std()) for one in found[1e-3]))
    for froude in WINDOWS:
        yield Row(f"Froude number {froude:g}: torque / (weight × offset of the centre of mass)", "1", "± 1 %", 0.99, 1.01,
                  tuple(one.balance for one in found[froude]))
    yield Row("Froude number 0.01: torque × rate / work of the drum", "1", "± 0.5 %", 0.995, 1.005,
              tuple(one.work for one in found[1e-2]))
    yield Row("Froude number 0.01: dissipation / (torque × rate)", "1", "± 2 %", 0.98, 1.02,
              tuple(one.dissipation for one in found[1e-2]))


def draw(figure, runs):
    left, right = figure.subplots(1, 2)
    left.axhspan(22, 27.4, color="0.9", zorder=0, label="glass beads: rest, avalanche")
    for froude, colour in zip(WINDOWS, ("C0", "C2", "C3")):
        for run in turned_at(froude):
            angle = steady(runs[run.name], froude).angle
            left.errorbar(froude, angle.mean(), angle.std(), fmt="C3.", capsize=3)
        metrics = runs[turned_at(froude)[0].name].metrics()
        right.plot(metrics["time_s"], metrics["surface_angle_deg"], colour, linewidth=0.7, label=f"{froude:g}")
        right.axvline(WINDOWS[froude][0], color=colour, linewidth=0.5)
    left.set(xscale="log", xlabel="Froude number", ylabel="angle of the surface [°]", ylim=(18, 32), xlim=(5e-5, 2e-2))
    left.legend(loc="upper left", fontsize="small")
    right.set(xlabel="time [s]", ylabel="angle of the surface [°]", xlim=(0, None), ylim=(0, 35))
    right.legend(title="Froude number", fontsize="small", loc="lower right")
