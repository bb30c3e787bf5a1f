// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/world/state.hpp"

#include <unordered_map>

namespace talus
{

/// Mean kinetic energy of the spheres but the liveliest two in a hundred [J]: a few rattlers roll for ever and would
/// hide everything else in a plain mean. 0 without spheres.
double energy_without_rattlers(const State& state);

/// Twice the height of the centre of mass above the foot of the lowest sphere [m]: of a bed of one density its height.
/// 0 without spheres.
/// @param up unit
double packing_height(const State& state, const Vec3& up);

/// How far spheres have come since it was made, whatever their storage order.
class Displacements
{
public:
    explicit Displacements(const State& start);

    /// Of the spheres that were there then and still are [m]; 0 without any.
    double median(const State& state) const;

private:
    std::unordered_map<std::int64_t, Vec3> start_; ///< by id
};

} // namespace talus
