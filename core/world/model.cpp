// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/world/model.hpp"

namespace talus
{

ModelledPhysics Model::needed_physics(bool spheres_turn) const
{
    ModelledPhysics needed{.wall_loads = physics.wall_loads};
    for (const ContactLaw& law : materials.laws) {
        needed.twisting = needed.twisting || law.twisting_friction > 0.0;
        needed.rolling = needed.rolling || law.rolling_friction > 0.0 || needed.twisting;
        needed.friction = needed.friction || law.friction > 0.0 || needed.rolling;
        needed.restitution = needed.restitution || law.restitution > 0.0;
        needed.elasticity = needed.elasticity || law.modulus < infinity;
    }
    for (const Attraction& law : materials.attractions) needed.attraction = needed.attraction || law.range > 0.0;
    needed.spin = needed.friction && spheres_turn;
    for (const Wall& wall : walls) {
        needed.moving_walls = needed.moving_walls || !wall.motion.empty();
        needed.pistons = needed.pistons || wall.is_piston();
    }
    return needed;
}

Vec3 Model::up() const
{
    const Vec3 down = gravity - periodicity.part_along(gravity);
    return down.isZero() ? Vec3::UnitZ() : Vec3(-down.normalized());
}

} // namespace talus
