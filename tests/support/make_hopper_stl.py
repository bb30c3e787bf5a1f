#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the STL file of a conical hopper under a cylinder, open at the top and at the outlet, which lies at z = 0.

    tests/support/make_hopper_stl.py > scenarios/hopper.stl
    tests/support/make_hopper_stl.py --outlet-diameter 0.1 > wide.stl

Rings of corners round the z axis, joined by two triangles a segment whose normals point inwards. The corners lie on the
radius, so the walls between them cut up to radius (1 - cos(pi / segments)) into the round shape.
"""
import argparse
import math


def positive(text):
    """A number above zero, for argparse."""
    value = float(text)
    if not 0.0 < value < math.inf:
        raise argparse.ArgumentTypeError(f"{text} is not above zero")
    return value


def parse_arguments():
    parser = argparse.ArgumentParser(description="Writes the ASCII STL file of a conical hopper, in metres.")
    parser.add_argument("--cylinder-diameter", type=positive, default=0.24, metavar="M")
    parser.add_argument("--cylinder-height", type=positive, default=0.40, metavar="M")
    parser.add_argument("--outlet-diameter", type=positive, default=0.07, metavar="M")
    parser.add_argument("--half-angle-deg", type=positive, default=30.0, metavar="DEG",
                        help="of the cone, from the vertical")
    parser.add_argument("--segments", type=int, default=64, metavar="N", help="of the circle, at least 3")
    arguments = parser.parse_args()
    if arguments.outlet_diameter >= arguments.cylinder_diameter:
        parser.error("the outlet must be narrower than the cylinder")
    if arguments.half_angle_deg >= 90.0:
        parser.error("the half-angle must be below 90 degrees")
    if arguments.segments < 3:
        parser.error("a circle has at least 3 segments")
    return arguments


def solid_name(hopper):
    """The dimensions, so that the file tells what it is."""
    return (f"hopper_cylinder_d{1e3 * hopper.cylinder_diameter:g}_h{1e3 * hopper.cylinder_height:g}"
            f"_cone_{hopper.half_angle_deg:g}deg_outlet_d{1e3 * hopper.outlet_diameter:g}_mm"
            f"_{hopper.segments}_segments_corners_on_radius_coordinates_in_m")


def ring(radius, height, segments):
    """Corners of one ring, rounded to the digits printed so that triangles share them exactly (and zero has no sign)."""
    angles = [2.0 * math.pi * k / segments for k in range(segments)]
    corners = [(radius * math.cos(angle), radius * math.sin(angle), height) for angle in angles]
    return [tuple(round(x, 9) + 0.0 for x in corner) for corner in corners]


def band(lower, upper):
    """Triangles between two rings, counter-clockwise seen from the axis."""
    for k, next_k in zip(range(len(lower)), [*range(1, len(lower)), 0]):
        yield lower[k], upper[next_k], lower[next_k]
        yield lower[k], upper[k], upper[next_k]


def unit_normal(a, b, c):
    p, q = [[y - x for x, y in zip(a, end)] for end in (b, c)]
    normal = [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
    length = math.hypot(*normal)
    return [round(x / length, 9) + 0.0 for x in normal]


def coordinates(vector):
    return " ".join(f"{x:.9f}" for x in vector)


def main():
    hopper = parse_arguments()
    outlet_radius, radius = hopper.outlet_diameter / 2, hopper.cylinder_diameter / 2
    cone_height = (radius - outlet_radius) / math.tan(math.radians(hopper.half_angle_deg))
    outlet = ring(outlet_radius, 0.0, hopper.segments)
    shoulder = ring(radius, cone_height, hopper.segments)
    top = ring(radius, cone_height + hopper.cylinder_height, hopper.segments)

    print(f"solid {solid_name(hopper)}")
    for triangle in [*band(outlet, shoulder), *band(shoulder, top)]:
        print(f"  facet normal {coordinates(unit_normal(*triangle))}\n    outer loop")
        for corner in triangle:
            print(f"      vertex {coordinates(corner)}")
        print("    endloop\n  endfacet")
    print(f"endsolid {solid_name(hopper)}")


if __name__ == "__main__":
    main()
