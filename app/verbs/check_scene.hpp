// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/loop/open_scene.hpp"

namespace talus
{

/// Prints what the scene holds and what a run of it needs: where walls and spheres are and how large beside a sphere,
/// mass, step, model, time, memory and disk, overlaps at the start.
void print_scene(const OpenedScene& opened, const OverlapCheck& overlaps);

/// Prints that, and if it is asked for the resolved scene, with every key written out.
void check_scene(const OpenedScene& opened, bool resolved);

/// Prints where the step comes from, what is modelled, which overlap to expect, and which overlaps there are already.
void print_explanations(const OpenedScene& opened, const OverlapCheck& overlaps);

/// Prints name and title of every scene that comes with Talus.
void list_scenes();

} // namespace talus
