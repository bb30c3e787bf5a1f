// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/vector.hpp"

namespace talus
{

/// The normal and two tangents as columns, right-handed: the directions of a contact's rows where they need some.
inline Eigen::Matrix3d contact_basis(const Vec3& normal)
{
    Eigen::Matrix3d basis;
    basis.col(0) = normal;
    basis.col(1) = any_perpendicular(normal);
    basis.col(2) = normal.cross(basis.col(1));
    return basis;
}

} // namespace talus
