// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/world/model.hpp"

namespace talus
{

Vec3 Model::up() const
{
    const Vec3 down = gravity - periodicity.part_along(gravity);
    return down.isZero() ? Vec3::UnitZ() : Vec3(-down.normalized());
}

} // namespace talus
