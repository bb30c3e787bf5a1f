// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model.hpp"

namespace talus
{

Vec3 Model::up() const
{
    Vec3 down = gravity;
    for (int d = 0; d < 3; ++d)
        if (periodicity.along(d)) down[d] = 0.0;
    return down.isZero() ? Vec3::UnitZ() : Vec3(-down.normalized());
}

} // namespace talus
