// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact_network.hpp"
#include "core/deep_beds/hat_grid.hpp"
#include "core/solver/piston_group.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

#include <vector>

namespace talus
{

/// A contact that carries an impulse λ: what it does to its bodies, where it is, and how far it is from its law.
struct Load {
    std::int32_t a = 0;          ///< sphere
    std::int32_t b = -1;         ///< sphere, or −1
    std::int32_t piston = -1;    ///< or −1
    Vec3 impulse = Vec3::Zero(); ///< λ [N s] on a, −λ on the other
    Vec3 turn_a = Vec3::Zero();  ///< what it adds to 2/5 m a of sphere a, a = r ω [N s]
    Vec3 turn_b = Vec3::Zero();
    HatPlace place;
    double power = 0.0;     ///< λ·y [J], y = u + Σ λ − q: by so much the energy rises per share of growth
    double unsliding = 0.0; ///< `power` without the rows that slide [J]
};

/// The loaded contacts: those of tile t are [first[t], first[t + 1]), in the order of its contacts; then come those
/// with pistons.
struct Loads {
    std::vector<std::size_t> first;
    std::vector<Load> list;

    std::size_t first_of_pistons() const { return first.back(); }
};

/// Loads whose spheres and pistons hang together, as places in the list, each in its order; the largest network first.
/// What is less than a tenth of all, or than a hundred, is counted to the largest.
std::vector<std::vector<std::uint32_t>> networks_of(const Loads& loads, std::size_t spheres, std::size_t pistons);

/// Some of them.
Loads part_of(const Loads& loads, const std::vector<std::uint32_t>& places);

/// What the contacts carry after the warm start, at these velocities. Tiles in parallel.
Loads find_loads(
    ContactNetwork& network, const PistonGroup& pistons, State& state, const Model& model, const HatGrid& grid);

} // namespace talus
