# SPDX-License-Identifier: GPL-3.0-or-later
"""The colours of pictures, in red, green and blue from 0 to 1. A ramp is a list of places from 0 to 1 with their colour."""

INK = (0.16, 0.17, 0.20)
WALL = (0.50, 0.57, 0.66)
SAND = (0.94, 0.81, 0.63)
FAINT_GRAIN = (0.80, 0.80, 0.80)
RAMP = ((0.0, SAND), (0.3, (0.97, 0.67, 0.36)), (0.65, (0.82, 0.28, 0.33)), (1.0, (0.35, 0.14, 0.48)))
FORCES = ((0.0, (0.62, 0.72, 0.82)), (0.35, (0.25, 0.45, 0.70)), (0.7, (0.55, 0.20, 0.45)), (1.0, (0.75, 0.10, 0.15)))
MATERIALS = (SAND, (0.42, 0.60, 0.75), (0.80, 0.45, 0.36), (0.52, 0.66, 0.45), (0.60, 0.50, 0.68))
