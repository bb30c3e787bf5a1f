// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/build_sensors.hpp"

#include "core/mass_flow.hpp"
#include "core/repose.hpp"
#include "scenarios/scene_checks.hpp"

namespace talus
{
namespace
{

std::unique_ptr<Sensor> build_mass_flow(const scene::SensorTable& table, std::size_t index)
{
    if (!(table.to > table.from)) throw SceneError(key_path("sensor", index, "to"), "'to' must be later than 'from'");
    const Vec3 normal = unit_vector(table.normal, key_path("sensor", index, "normal"));
    return std::make_unique<MassFlow>(table.name, table.point, normal, table.from, table.to);
}

std::unique_ptr<Sensor> build_repose(const scene::SensorTable& table, std::size_t index, const Vec3& gravity)
{
    if (gravity.isZero()) throw SceneError(key_path("sensor", index, "kind"), "an angle of repose needs gravity");
    if (table.outer_radius > 0.0 && table.outer_radius <= table.inner_radius)
        throw SceneError(key_path("sensor", index, "outer_radius"), "'outer_radius' must be above 'inner_radius'");
    return std::make_unique<Repose>(table.name, table.base, table.inner_radius, table.outer_radius);
}

} // namespace

std::vector<std::unique_ptr<Sensor>> build_sensors(const scene::Scene& scene)
{
    std::vector<std::unique_ptr<Sensor>> sensors;
    for (std::size_t k = 0; k < scene.sensor.size(); ++k)
        sensors.push_back(scene.sensor[k].kind == "mass_flow" ? build_mass_flow(scene.sensor[k], k)
                                                              : build_repose(scene.sensor[k], k, scene.world.gravity));
    return sensors;
}

} // namespace talus
