// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/region.hpp"
#include "core/world/wall.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace talus
{

/// Corners of a mesh that are no further apart than this are one, in diameters of the spheres.
inline constexpr double same_corner = 1e-6;

/// Where a mesh is open: edges in a row that belong to one triangle only.
struct Hole {
    std::size_t edges = 0;
    Vec3 place = Vec3::Zero(); ///< mean of their corners [m]
    double length = 0.0;       ///< of all [m]
};

/// What a mesh encloses.
class ClosedMesh final : public ClosedSurface
{
public:
    /// @param weld corners no further apart are one [m]
    ClosedMesh(const Mesh& mesh, double weld);
    ~ClosedMesh() override;

    /// None where the mesh is closed; otherwise nothing is inside.
    std::vector<Hole> holes() const;

    double depth(const Vec3& x) const override;
    Box bounds() const override;
    double volume() const override;

private:
    struct Surface;
    std::unique_ptr<const Surface> surface_;
};

/// The inside of a wall, in the wall's own frame, for a mesh without a hole and a box with all its faces; else nothing.
/// @param weld as for a `ClosedMesh` [m]
std::optional<Region> inside_of(const Shape& shape, double weld);

} // namespace talus
