# SPDX-License-Identifier: GPL-3.0-or-later
"""13. Single impacts: tests 1 to 4 and 6 of Chung & Ooi.

Law: Newton's restitution e and Coulomb's friction μ in one rigid impact, without restitution along the contact. With the
slip s = v_t − rω and the normal speed v_n before it, the impulses of a mass m are

    J_n = (1 + e) m v_n,    J_t = min(μ J_n, 2/7 m |s|)

so that the contact point sticks where |s| ≤ 7/2 μ (1 + e) v_n, and s is 0 then; that of elastic spheres is not, which
wind up and spring back while they touch.

Parameters (Chung & Ooi 2011, Granular Matter 13, 643; as Yade has them in its scripts of these tests):
- 1: two glass spheres of radius 10 mm, head-on at 10 m/s each, e = 1;
- 2: a sphere of radius 0.1 m on a plane at 0.2 m/s, e = 1;
- 3: one of 2.5 mm at 3.9 m/s, e from 0.2 to 1;
- 4: the same, oblique, with e = 0.98 and μ = 0.092, θ from the normal;
- 6: one of 0.1 m that spins, at 0.2 m/s with e = 0.5 and μ = 0.4 (as Kratos has them).

References: the curves of the paper for 4 (aluminium oxide) and 6 as digitised for Kratos, in its repository under
applications/DEMApplication/tests/DEM3D_chung_ooi_tests (test4_data/paper_data, paper_data_5_to_8/benchmark8_graph1.dat).

Tolerances, fixed before the runs: 1e-6 against the laws, the precision of the frames. Against the curves, for which some
pixels are reported: angular velocity 3 %, tangential restitution 0.01, rebound angle 2°, β 0.03; the same where the contact
sticks, though a rigid law cannot keep it there.

There is no chance in these runs: each is made once.
"""
import math

import numpy

from case import Row, Simulation

TITLE = "Chung & Ooi's tests"
FINDINGS = """Tests 1 and 2 are given by their force over the approach, which a rigid contact has not: only the speeds can
be compared. Where the contact slides to its end, Talus is on the curves. Where it sticks, from the normal to the bend
of the curves, it is on the rigid law and not on them: there an elastic contact winds up along the plane and gives back a
part of the slip, reversed, which a law without tangential restitution leaves out."""
SPEED = 3.9  # m/s, of tests 3 and 4
RESTITUTIONS = (0.2, 0.4, 0.6, 0.8, 1.0)
FRICTION_4, RESTITUTION_4, RADIUS_4 = 0.092, 0.98, 0.0025
FRICTION_6, RESTITUTION_6, RADIUS_6, NORMAL_6 = 0.4, 0.5, 0.1, 0.2
# θ [deg]: tangential restitution, angular velocity [rad/s] and rebound angle [deg] of the contact point
CURVES_4 = {5: (0.948, 19.3, 3.8), 10: (0.687, 213.0, -1.6), 15: (0.624, 377.8, -5.5), 20: (0.616, 510.6, -7.5),
            25: (0.634, 599.4, -7.5), 30: (0.684, 616.5, -3.5), 35: (0.737, 582.3, 3.4), 40: (0.781, 544.8, 11.6),
            50: (0.845, 457.0, 29.4), 60: (0.893, 357.5, 47.8), 70: (0.932, 246.2, 64.6), 80: (0.966, 126.3, 78.7),
            85: (0.983, 63.1, 84.5)}
# Angle of the slip from the normal [deg]: β, slip after over slip before, reversed
CURVE_6 = {85: -0.815, 80: -0.626, 75: -0.437, 70: -0.238, 65: -0.017, 60: 0.096, 55: 0.111, 50: 0.090, 45: 0.058,
           40: 0.006, 35: -0.049, 30: -0.103, 25: -0.139, 20: -0.162, 15: -0.204, 10: -0.259, 5: -0.339}


def impact(name, radius, tangential, normal, spin, friction, restitution):
    """A sphere that comes down on the plane with these velocities [m/s] and spin [rad/s]."""
    return Simulation(name, "impact", {
        "fill.0.diameter": 2 * radius, "fill.0.position": [0, 0, 1.1 * radius],
        "fill.0.velocity": [tangential, 0, -normal], "fill.0.angular_velocity": [0, spin, 0],
        "contact.0.friction": friction, "contact.0.restitution": restitution,
        "time.duration": 0.5 * radius / normal})


def oblique(angle):
    radians = math.radians(angle)
    return impact(f"chung_ooi_4_{angle}", RADIUS_4, SPEED * math.sin(radians), SPEED * math.cos(radians), 0,
                  FRICTION_4, RESTITUTION_4)


def spinning(angle):
    return impact(f"chung_ooi_6_{angle}", RADIUS_6, 0, NORMAL_6, -NORMAL_6 * math.tan(math.radians(angle)) / RADIUS_6,
                  FRICTION_6, RESTITUTION_6)


HEAD_ON = Simulation("chung_ooi_1", "head_on")
NORMAL = impact("chung_ooi_2", 0.1, 0, 0.2, 0, 0, 1)
PLASTIC = [impact(f"chung_ooi_3_{e}", RADIUS_4, 0, SPEED, 0, 0, e) for e in RESTITUTIONS]
RUNS = [HEAD_ON, NORMAL, *PLASTIC, *map(oblique, CURVES_4), *map(spinning, CURVE_6)]


def after(run):
    """Tangential and normal velocity [m/s] and spin [rad/s] after the impact."""
    spheres = run.frame()
    return float(spheres.velocities[0, 0]), float(spheres.velocities[0, 2]), float(spheres.angular_velocities[0, 1])


def found_4(run, angle):
    """What the curves of test 4 have."""
    tangential, normal, spin = after(run)
    slip = tangential - RADIUS_4 * spin
    return (tangential / (SPEED * math.sin(math.radians(angle))), spin, math.degrees(math.atan(slip / normal)))


def rigid_4(angle):
    """The same by the rigid law."""
    normal, slip = SPEED * math.cos(math.radians(angle)), SPEED * math.sin(math.radians(angle))
    change = min(FRICTION_4 * (1 + RESTITUTION_4) * normal, 2 / 7 * slip)  # J_t / m
    rest = max(slip - 3.5 * change, 0.0)
    return (1 - change / slip, 2.5 * change / RADIUS_4, math.degrees(math.atan(rest / (RESTITUTION_4 * normal))))


def found_6(run, angle):
    """β of test 6."""
    tangential, _, spin = after(run)
    return -(tangential - RADIUS_6 * spin) / (NORMAL_6 * math.tan(math.radians(angle)))


def slips(angle, friction, restitution):
    """Whether the contact slides to the end of the impact, by the rigid law."""
    return math.tan(math.radians(angle)) > 3.5 * friction * (1 + restitution)


def judge(runs):
    head_on = numpy.abs(runs[HEAD_ON.name].frame().velocities[:, 0]) / 10
    yield Row("test 1: speed after the impact / before", "1", "± 1e-6", 1 - 1e-6, 1 + 1e-6, (float(head_on.mean()),))
    yield Row("test 2: speed after the impact / before", "1", "± 1e-6", 1 - 1e-6, 1 + 1e-6,
              (after(runs[NORMAL.name])[1] / 0.2,))
    yield Row("test 3: largest deviation of the restitution", "0", "1e-6", 0, 1e-6,
              (max(abs(after(runs[run.name])[1] / SPEED - e) for run, e in zip(PLASTIC, RESTITUTIONS)),))

    found = {angle: found_4(runs[oblique(angle).name], angle) for angle in CURVES_4}
    yield Row("test 4: largest deviation of the tangential restitution from the rigid law", "0", "1e-6", 0, 1e-6,
              (max(abs(found[angle][0] - rigid_4(angle)[0]) for angle in CURVES_4),))
    for sliding, word in ((True, "sliding"), (False, "sticking")):
        angles = [angle for angle in CURVES_4 if slips(angle, FRICTION_4, RESTITUTION_4) == sliding]
        where = f"test 4, {word} (θ = {angles[0]} to {angles[-1]}°): largest deviation of"
        for k, (quantity, tolerance, high) in enumerate((("the tangential restitution", "0.01", 0.01),
                                                         ("the angular velocity / the curve's", "0.03", 0.03),
                                                         ("the rebound angle [deg]", "2", 2.0))):
            scale = {angle: CURVES_4[angle][k] if k == 1 else 1 for angle in angles}
            yield Row(f"{where} {quantity}", "0 (Chung & Ooi 2011)", tolerance, 0, high,
                      (max(abs((found[angle][k] - CURVES_4[angle][k]) / scale[angle]) for angle in angles),))
    for sliding, word in ((True, "sliding"), (False, "sticking")):
        yield Row(f"test 6, {word}: largest deviation of β", "0 (Chung & Ooi 2011)", "0.03", 0, 0.03,
                  (max(abs(found_6(runs[spinning(angle).name], angle) - beta) for angle, beta in CURVE_6.items()
                       if slips(angle, FRICTION_6, RESTITUTION_6) == sliding),))


def draw(figure, runs):
    panels = figure.subplots(2, 2).ravel()
    angles = list(CURVES_4)
    fine = numpy.linspace(1, 89, 200)
    labels = ("tangential restitution", "angular velocity [rad/s]", "rebound angle [deg]")
    for k, (axes, label) in enumerate(zip(panels, labels)):
        axes.plot(angles, [CURVES_4[angle][k] for angle in angles], "ks-", markerfacecolor="none", markersize=4,
                  linewidth=0.5, label="Chung & Ooi 2011")
        axes.plot(fine, [rigid_4(angle)[k] for angle in fine], "C0", linewidth=1, label="rigid law")
        axes.plot(angles, [found_4(runs[oblique(angle).name], angle)[k] for angle in angles], "C3.", label="runs")
        axes.set(xlabel="test 4: θ [deg]", ylabel=label)
    panels[2].legend(fontsize="small")
    limit = 3.5 * FRICTION_6 * (1 + RESTITUTION_6)
    places = [limit / math.tan(math.radians(angle)) for angle in CURVE_6]
    panels[3].plot(places, list(CURVE_6.values()), "ks-", markerfacecolor="none", markersize=4, linewidth=0.5)
    panels[3].plot([0, 1, 25], [-1, 0, 0], "C0", linewidth=1)
    panels[3].plot(places, [found_6(runs[spinning(angle).name], angle) for angle in CURVE_6], "C3.")
    panels[3].set(xlabel="test 6: 7/2 μ (1 + e) v_n / (rω)", ylabel="β", xlim=(0, 13))
