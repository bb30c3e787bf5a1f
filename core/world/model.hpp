// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/periodicity.hpp"
#include "core/base/region.hpp"
#include "core/world/material.hpp"
#include "core/world/piston.hpp"
#include "core/world/wall.hpp"

#include <string>
#include <vector>

namespace talus
{

/// How overlap is kept small (core/law has the laws).
enum class Stabilisation { matched, projected };

struct SolverSettings {
    Stabilisation stabilisation = Stabilisation::matched;
    int min_sweeps = 2;                 ///< N_min; it also sets the stiffness of `matched`
    int max_sweeps = 300;               ///< a step that stops here unconverged is counted and reported
    double tolerance = 1e-2;            ///< on the residual ε, see gauss_seidel.hpp
    double relaxation = 1.3;            ///< ω of the sweeps that are relaxed, METHOD (6); 1: none
    double restitution_threshold = 3.0; ///< impacts slower than this times gravity × step do not rebound
    double push_out_speed = infinity;   ///< with which overlap is undone that no load has pressed [m/s]
    bool pressure_scaling = false;      ///< before the sweeps, see pressure_scaling/; with `projected` only
    bool to_the_end = false;            ///< the tolerance is on what all further sweeps would change, METHOD (9)
};

/// What the scene needs; the rest does not exist in the step.
struct ModelledPhysics {
    bool friction = false;
    bool spin = false;     ///< spheres turn; never without friction
    bool rolling = false;  ///< rolling rows, METHOD (8)
    bool twisting = false; ///< … which resist twisting, too
    bool restitution = false;
    bool moving_walls = false; ///< as prescribed
    bool pistons = false;
    bool attraction = false;
    bool elasticity = false; ///< moduli of materials
    bool wall_loads = false; ///< a sensor asks for them
};

/// The constant part of a simulation.
struct Model {
    Vec3 gravity = Vec3(0, 0, -9.81); ///< [m/s²]
    double time_step = 0.0;           ///< h [s]
    Materials materials;
    std::vector<Wall> walls;
    std::vector<Piston> pistons; ///< the walls of finite mass
    std::vector<Region> outlets; ///< a sphere whose centre enters one leaves the world lawfully
    Periodicity periodicity;     ///< none unless the scene asks for it
    Box world;                   ///< a sphere whose centre leaves it elsewhere has escaped
    /// Round walls, fills, pours and outlets as the scene begins: tiles and hats are counted from its lower corner.
    Box contents = {Vec3::Zero(), Vec3::Zero()};
    double speed_limit = infinity; ///< a faster sphere is a blow-up [m/s]
    double mean_diameter = 0.0;    ///< d, of all spheres that the scene makes; the unit of lengths in reports [m]
    double min_diameter = 0.0;
    double max_diameter = 0.0;
    double attraction_range = 0.0; ///< of what attracts from furthest [m]
    ModelledPhysics physics;
    SolverSettings solver;

    /// What must be modelled, by its materials and walls; what sensors ask for stays.
    ModelledPhysics needed_physics(bool spheres_turn = true) const;

    /// Against gravity, as far as it acts across periodic axes; +z without: where the surface of a bed is.
    Vec3 up() const;
};

} // namespace talus
