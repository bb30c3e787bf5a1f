// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/loop/open_scene.hpp"

namespace talus
{

/// How many spheres will have come in by a time: as many as rate, number and mass let, and as its region has room for.
double poured_by(const Pour& source, double time, const Simulation& simulation);

/// The CPU time that a run will take on one thread [s], within a factor of two: what a sphere takes in a bed of the
/// scene's spheres, with its step and its solver, is measured in some steps of one; how many there will be follows from
/// fills, pours, falls, and from gates that open (Beverloo, Leniger & van de Velde 1961).
double forecast_cpu(const OpenedScene& opened);

} // namespace talus
