// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace talus::test
{

/// A scene with every kind of table; its funnel.stl must lie beside it.
inline constexpr const char* full_scene = R"(
title = 'A "quoted" title, a tab	, a \ and µ'
seed = 7
[time]
step = 1e-4
duration = 3
frame_interval = inf
[world]
max = [1, 1, inf]
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
)";

/// An ASCII STL file.
inline constexpr const char* one_triangle = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1000 0 0\n"
                                            "vertex 0 1000 0\nendloop\nendfacet\nendsolid\n";

} // namespace talus::test
