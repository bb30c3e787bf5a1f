// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/region.hpp"
#include "core/world/wall.hpp"

#include <optional>
#include <utility>

namespace talus
{

/// How many edges belong to one triangle only: none where a mesh is closed.
std::size_t open_edges(const Mesh& mesh);

/// A mesh of which one may be inside.
class ClosedMesh final : public ClosedSurface
{
public:
    /// @pre no edge of the mesh is open
    explicit ClosedMesh(Mesh mesh) : mesh_(std::move(mesh)) {}

    double depth(const Vec3& x) const override;
    Box bounds() const override;
    double volume() const override;

private:
    Mesh mesh_;
};

/// The inside of a wall, in the wall's own frame, for a mesh without an open edge and a box with all its faces; else
/// nothing.
std::optional<Region> inside_of(const Shape& shape);

} // namespace talus
