// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/supply/pour.hpp"
#include "scenarios/builder/packing.hpp"
#include "scenarios/scene.hpp"

namespace talus
{

/// A fill that was read and checked, before its spheres are there.
struct Fill {
    std::string key;                  ///< its path, for errors: "fill[0]"
    const scene::FillTable& table;    ///< what is taken as it is: arrangement, spacing, velocities
    Mixture mixture;                  ///< what a packing is made of; that of a file has no species
    Region region;                    ///< where a packing is to be; of a list: none
    std::vector<Region> except = {};  ///< where nothing of it is to be
    std::int64_t count = 0;           ///< of a packing
    std::vector<PackedSphere> listed; ///< the spheres of a file, in its order, or a single one

    bool is_list() const { return table.arrangement == "file" || table.arrangement == "single"; }
};

/// The fills in the order of the scene, which must outlive them. @throws SceneError
std::vector<Fill> build_fills(const scene::Scene& scene, const Materials& materials);

/// The pours in the order of the scene; their random generators are still to be seeded. @throws SceneError
std::vector<Pour> build_pours(const scene::Scene& scene, const Materials& materials);

/// @throws SceneError where a fill or a pour has no room for a sphere, reaches out of the world, or is far too wide
void require_inside_world(const std::vector<Fill>& fills, const std::vector<Pour>& pours, const Box& world);

/// Puts the spheres of all fills into the state, in the order of the scene.
/// @param model its walls and its world are known; @throws SceneError where a region cannot hold them
void place_spheres(State& state, const std::vector<Fill>& fills, const Model& model, Random& random);

} // namespace talus
