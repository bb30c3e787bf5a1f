# SPDX-License-Identifier: GPL-3.0-or-later
"""8. Rough incline: arrest, steady flow and acceleration; Bagnold's profile; μ(I) by the slope.

Laws: on a rough bed a layer comes to rest below θ1, flows steadily between θ1 and θ2, and accelerates above; steady
flows have Bagnold's profile u ∝ h^{3/2} − (h − z)^{3/2} and the same solid fraction at all depths (Silbert et al. 2001,
Phys. Rev. E 64, 051302; spheres of friction 0.5 and restitution 0.88, as here). Then the inertial number is the same
at all depths too, I = 3/2 A d/√(φ g cos θ) for u = A (h^{3/2} − (h − z)^{3/2}), and the slope is the friction:

    tan θ = μ(I) = μ_s + (μ_2 − μ_s)/(I0/I + 1)    (Jop, Forterre & Pouliquen 2006, Nature 441, 727)

with μ_s = 0.382, μ_2 = 0.643, I0 = 0.279 for glass beads; the same constants stand in the examples of Basilisk by
Lagrée, Staron & Popinet (2011, J. Fluid Mech. 686, 378). By depth ū/√(g h) = β h/h_stop(θ) (Pouliquen 1999, Phys.
Fluids 11, 542), h_stop/d = B (tan θ2 − tan θ)/(tan θ − tan θ1); of spheres like these θ1 = 17.6°, θ2 = 32.3°, B = 3.8,
β = 0.19 (Weinhart, Thornton, Luding & Bokhove 2012, Granular Matter 14, 531; from memory).

Parameters: beads ± 5 %, 12 diameters deep, cell 12 × 8 diameters. For 5 s, averaged over the last 2; at 15° for 4 s,
at 28° for 10.

Tolerances, fixed before the runs:
- 15°: mean speed at the end up to 1e-3 √(g d). 33°: acceleration above 0.02 g sin θ. 24 and 28°: 0 ± 0.02 g sin θ.
- Bagnold's profile, A and a slip at the bed fitted, from one diameter above the bed to two below the surface: R² above
  0.98. Solid fraction from two above the bed to three below the surface: standard deviation up to 0.01.
- tan θ less μ(I): ± 0.04, glass beads for spheres of friction 0.5. β at 24°: 0.12 to 0.26, since from memory.
"""
import math
from typing import NamedTuple

import numpy

from case import Row, over_seeds, told
from measures import volumes

TITLE = "rough incline"
FINDINGS = """At 28° the flow gains speed for more than five seconds; from the eighth to the tenth it hardly does. At
both slopes spheres of friction 0.5 are a little weaker than glass beads."""
GRAVITY, DIAMETER, AREA = 9.81, 0.01, 0.12 * 0.08  # as in scenes/rough_incline.toml
TIMES = {15: (3.0, 4.0), 24: (3.0, 5.0), 28: (8.0, 10.0), 33: (3.0, 5.0)}  # from when to when, s
STEADY = (24, 28)  # degrees
MU_S, MU_2, I0 = 0.382, 0.643, 0.279  # glass beads, Jop et al. 2006
THETA_1, THETA_2, B = math.radians(17.6), math.radians(32.3), 3.8  # Weinhart et al. 2012
JOP = "0 (glass beads, Jop et al. 2006)"


class Flow(NamedTuple):
    """What a flow has in its window."""
    z: numpy.ndarray  # middles of the bins from one diameter above the bed to two below the surface [m]
    velocity: numpy.ndarray  # there [m/s]
    fitted: numpy.ndarray  # Bagnold's profile there [m/s]
    height: float  # [m]
    fraction: float  # of solid, in the core
    fraction_scatter: float
    inertial_number: float
    mean_velocity: float  # of the whole depth [m/s]

    @property
    def r2(self):
        return 1 - numpy.var(self.velocity - self.fitted) / numpy.var(self.velocity)


def tilted(angle):
    begin, end = TIMES[angle]
    theta = math.radians(angle)
    return over_seeds(f"incline_{angle}", "rough_incline", {
        "world.gravity": f"[{GRAVITY * math.sin(theta):.5f}, 0, {-GRAVITY * math.cos(theta):.5f}]",
        "time.duration": end, "sensor.flow.from": begin, "sensor.depth.from": begin})


RUNS = [run for angle in TIMES for run in tilted(angle)]


def mu_of(inertial_number):
    """The friction of glass beads by Jop et al. 2006."""
    return MU_S + (MU_2 - MU_S) / (I0 / inertial_number + 1)


def h_stop(angle):
    """[d], by Weinhart et al. 2012."""
    slope = math.tan(math.radians(angle))
    return B * (math.tan(THETA_2) - slope) / (slope - math.tan(THETA_1))


def bagnold(z, velocity, height):
    """A and the slip of slip + A (h^{3/2} − (h − z)^{3/2}) by least squares, and that profile."""
    shape = height**1.5 - (height - z) ** 1.5
    a, slip = numpy.polyfit(shape, velocity, 1)
    return a, slip, slip + a * shape


def flow(run, angle):
    rows = numpy.genfromtxt(run.folder / "profile_depth.csv", delimiter=",", names=True)
    z, velocity, fraction = rows["position_m"], rows["velocity_x_m_per_s"], rows["packing_fraction"]
    filled = fraction > 0
    mean_velocity = float(numpy.average(velocity[filled], weights=fraction[filled]))
    height = volumes(run.frame().radii).sum() / (AREA * fraction[(z > 0.02) & (z < 0.08)].mean())
    core = (z > 2 * DIAMETER) & (z < height - 3 * DIAMETER)
    inside = (z > DIAMETER) & (z < height - 2 * DIAMETER)
    a, _, fitted = bagnold(z[inside], velocity[inside], height)
    phi = float(fraction[core].mean())
    return Flow(z[inside], velocity[inside], fitted, height, phi, float(fraction[core].std()),
                1.5 * a * DIAMETER / math.sqrt(phi * GRAVITY * math.cos(math.radians(angle))), mean_velocity)


def acceleration(run, angle, times):
    """Of the beads between two and ten diameters above the bed, between two times, by g sin θ."""
    metrics = run.metrics()
    inside = (metrics["time_s"] >= times[0]) & (metrics["time_s"] <= times[1] + 1e-6)
    slope = numpy.polyfit(metrics["time_s"][inside], metrics["flow_velocity_x_m_per_s"][inside], 1)[0]
    return slope / (GRAVITY * math.sin(math.radians(angle)))


def judge(runs):
    yield Row("15°: mean speed at the end / √(g d)", "0, at rest (Silbert et al. 2001)", "up to 0.001", 0.0, 0.001,
              tuple(float(numpy.linalg.norm(runs[run.name].frame().velocities, axis=1).mean())
                    / math.sqrt(GRAVITY * DIAMETER) for run in tilted(15)))
    for angle in STEADY:
        yield Row(f"{angle}°: acceleration / (g sin θ)", "0, steady (Silbert et al. 2001)", "± 0.02", -0.02, 0.02,
                  tuple(acceleration(runs[run.name], angle, TIMES[angle]) for run in tilted(angle)))
    yield told("28°: acceleration / (g sin θ) from the third second to the fifth",
               (acceleration(runs[run.name], 28, (3.0, 5.0)) for run in tilted(28)))
    yield Row("33°: acceleration / (g sin θ)", "above 0 (Silbert et al. 2001)", "above 0.02", 0.02, math.inf,
              tuple(acceleration(runs[run.name], 33, TIMES[33]) for run in tilted(33)))
    found = {angle: [flow(runs[run.name], angle) for run in tilted(angle)] for angle in STEADY}
    for angle in STEADY:
        yield Row(f"{angle}°: R² of Bagnold's profile", "1 (Silbert et al. 2001)", "above 0.98", 0.98, 1.0,
                  tuple(one.r2 for one in found[angle]))
        yield Row(f"{angle}°: standard deviation of the solid fraction in depth", "0 (Silbert et al. 2001)",
                  "up to 0.01", 0.0, 0.01, tuple(one.fraction_scatter for one in found[angle]))
    for angle in STEADY:
        yield Row(f"{angle}°: tan θ less μ(I)", JOP, "± 0.04", -0.04, 0.04,
                  tuple(math.tan(math.radians(angle)) - mu_of(one.inertial_number) for one in found[angle]))
    yield Row("24°: β of ū/√(g h) = β h/h_stop", "0.19 (Weinhart et al. 2012, from memory)", "0.12 to 0.26", 0.12, 0.26,
              tuple(one.mean_velocity / math.sqrt(GRAVITY * one.height) * h_stop(24) * DIAMETER / one.height
                    for one in found[24]))


def draw(figure, runs):
    left, right = figure.subplots(1, 2)
    for angle, colour in zip(STEADY, ("C0", "C3")):
        for k, run in enumerate(tilted(angle)):
            one = flow(runs[run.name], angle)
            left.plot(one.velocity, one.z / DIAMETER, f"{colour}.", label=f"{angle}°" if k == 0 else None)
            left.plot(one.fitted, one.z / DIAMETER, colour, linewidth=0.7)
            right.plot(one.inertial_number, math.tan(math.radians(angle)), f"{colour}o", markersize=4)
    left.set(xlabel="velocity [m/s]", ylabel="height above the bed / d", xlim=(0, None), ylim=(0, None))
    left.legend(title="lines: Bagnold", fontsize="small")
    numbers = numpy.linspace(1e-3, 0.6, 200)
    right.plot(numbers, mu_of(numbers), "k", linewidth=1, label="glass beads, Jop et al. 2006")
    right.set(xlabel="inertial number I", ylabel="tan θ", xlim=(0, 0.6))
    right.legend(fontsize="small")
