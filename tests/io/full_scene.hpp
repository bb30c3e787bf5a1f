// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tests/io/scene_folder.hpp"

namespace talus::test
{

/// A scene with every kind of table; its funnel.stl, sieves.csv and spheres.csv must lie beside it.
inline constexpr const char* full_scene = R"(
title = 'A "quoted" title, a tab	, a \ and µ'
seed = 7
[time]
step = 1e-4
duration = 3
frame_interval = inf
[world]
min = [0, -1, -inf]
max = [1, 1, inf]
periodic = ["x"]
rotation = false
[solver]
tolerance = "fine"
[output]
particle_arrays = ["force"]
contact_arrays = []
region = { shape = "box", max = [1, 1, 1] }
[materials.glass]
density = 2500.0
["materials"."dark wood"]
[[contact]]
between = ["glass", "dark wood"]
friction = 0.1
[[fill]]
material = "glass"
count = 1_000
diameter = 0.01
region = { shape = "cylinder", radius = 0.3333333333333333, height = 1 }
[[fill]]
count = 10
region = { max = [1, 1, 1] }
[[fill.species]]
material = "glass"
diameter = { distribution = "sieve", file = "sieves.csv" }
share = 2
[[fill.species]]
material = "dark wood"
diameter = { distribution = "lognormal", median = 0.01, deviation = 0.2, min = 0.005, max = 0.02 }
share = 1
[[fill]]
arrangement = "file"
file = "spheres.csv"
material = "glass"
scale = 0.001
translate = [0, 0, 2]
[[pour]]
material = "glass"
mass = 0.5
mass_rate = 0.1
diameter = { distribution = "normal", mean = 0.01, deviation = 0.001, min = 0.008, max = 0.012 }
region = { max = [1, 1, 1] }
[[pour]]
material = "glass"
count = 5
rate = 1e3
diameter = { distribution = "uniform", min = 0.0095, max = 0.0105 }
region = { max = [1, 1, 1] }
[[wall]]
name = "box"
shape = "box"
material = "dark wood"
max = [1, 1, 1]
open = ["z+", "x-"]
[[wall]]
name = "funnel"
mesh = "funnel.stl"
material = "glass"
scale = 0.001
translate = [0, 0, 1]
[[outlet]]
region = { max = [1, 1, 1] }
[[sensor]]
name = "flow"
kind = "mass_flow"
[[sensor]]
name = "bed"
kind = "region"
region = { max = [1, 1, 1] }
[[sensor]]
name = "rings"
kind = "profile"
direction = "radial"
region = { shape = "cylinder", radius = 0.3, height = 1 }
bins = 7
[[sensor]]
name = "load"
kind = "wall_force"
wall = "box"
point = [0, 0, 1]
[[wall]]
name = "bed"
shape = "grains"
material = "glass"
diameter = 0.02
spacing = 1.25
max = [1, 1, 0]
[[wall.motion]]
kind = "shake"
amplitude = [0, 0, 0.001]
frequency = 30
from = 0.5
[[wall.motion]]
kind = "turn"
point = [0.1, 0.2, 0.3]
axis = [0, 1, 0]
rate = -0.3333333333333333
to = 2
[[wall]]
name = "lid"
shape = "plane"
material = "glass"
[[wall.motion]]
kind = "translate"
velocity = [0, 0, -0.1]
[[wall.motion]]
kind = "table"
table = [[0, 0, 0, 0], [0.1, 0, 0, 0.3333333333333333]]
[[wall]]
name = "plate"
shape = "disk"
material = "glass"
radius = 0.5
mass = 2
guide = [0, 0, -1]
load = [[0.5, 0], [1, 0.3333333333333333]]
released_at = 0.25
[[wall]]
name = "piston"
shape = "disk"
material = "glass"
radius = 0.25
mass = 0.3333333333333333
guide = [1, 0, 0]
load = -5
[[sensor]]
name = "surface"
kind = "slope"
along = [1, 0, 0]
length = 0.5
)";

/// An ASCII STL file.
inline constexpr const char* one_triangle = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1000 0 0\n"
                                            "vertex 0 1000 0\nendloop\nendfacet\nendsolid\n";

/// A sieve analysis.
inline constexpr const char* two_sieves = "size_mm, passing_percent\n5, 0\n10, 100\n";

/// Two spheres, in millimetres.
inline constexpr const char* two_spheres = "x,y,z,radius\n0,0,10,5\n20,0,10,10\n";

/// Writes the files that the full scene names.
inline void write_named_files(const SceneFolder& folder)
{
    folder.write("funnel.stl", one_triangle);
    folder.write("sieves.csv", two_sieves);
    folder.write("spheres.csv", two_spheres);
}

} // namespace talus::test
