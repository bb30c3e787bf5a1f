// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/builder/sensors.hpp"

#include "core/sensors/mass_flow.hpp"
#include "core/sensors/profile.hpp"
#include "core/sensors/region_average.hpp"
#include "core/sensors/repose.hpp"
#include "core/sensors/slope.hpp"
#include "core/sensors/sphere_track.hpp"
#include "core/sensors/wall_force.hpp"
#include "core/sensors/wall_position.hpp"
#include "scenarios/builder/checks.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

namespace talus
{
namespace
{

/// A sensor's table, and the paths of its keys for errors.
struct Entry {
    const scene::SensorTable& table;
    std::size_t index;
    double diameter; ///< of the spheres, on average [m]

    std::string key(const char* name) const { return key_path("sensor", index, name); }
};

TimeWindow build_window(const Entry& entry)
{
    const auto& table = entry.table;
    if (!(table.to > table.from)) throw SceneError(entry.key("to"), "'to' must be later than 'from'");
    return {table.from, table.to};
}

std::unique_ptr<Sensor> build_mass_flow(const Entry& entry, const Periodicity& periodicity)
{
    const TimeWindow window = build_window(entry);
    const Vec3 normal = unit_vector(entry.table.normal, entry.key("normal"));
    for (int d = 0; d < 3; ++d)
        if (periodicity.along(d) && normal[d] != 0.0 && std::abs(normal[d]) != 1.0)
            throw SceneError(entry.key("normal"), "a plane must lie along a periodic axis or straight across it");
    return std::make_unique<MassFlow>(entry.table.name, entry.table.point, normal, window);
}

std::unique_ptr<Sensor> build_repose(const Entry& entry, const Vec3& gravity)
{
    const auto& table = entry.table;
    if (gravity.isZero()) throw SceneError(entry.key("kind"), "an angle of repose needs gravity");
    if (table.outer_radius > 0.0 && table.outer_radius <= table.inner_radius)
        throw SceneError(entry.key("outer_radius"), "'outer_radius' must be above 'inner_radius'");
    return std::make_unique<Repose>(table.name, table.base, table.inner_radius, table.outer_radius);
}

std::unique_ptr<Sensor> build_slope(const Entry& entry)
{
    const auto& table = entry.table;
    return std::make_unique<Slope>(
        table.name, table.point, unit_vector(table.along, entry.key("along")), table.length, build_window(entry));
}

std::unique_ptr<Sensor> build_region_average(const Entry& entry)
{
    const Region region = require_region(entry.table.region, entry.diameter, entry.key("region"));
    return std::make_unique<RegionAverage>(entry.table.name, region, build_window(entry));
}

/// A profile's table is written to a file that is named after it.
void require_file_name(const Entry& entry)
{
    const auto is_plain = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; };
    if (entry.table.name.empty() || !std::ranges::all_of(entry.table.name, is_plain))
        throw SceneError(entry.key("name"),
            "the name of a profile is part of a file's name: use letters, digits, '_' and '-' only, one at least");
    constexpr std::size_t longest = 200; // file systems take 255, with what stands before and behind it
    if (entry.table.name.size() > longest)
        throw SceneError(entry.key("name"), "the name of a profile is part of a file's name: at most 200 characters");
}

std::unique_ptr<Sensor> build_profile(const Entry& entry)
{
    using Direction = RegionBins::Direction;
    static const std::map<std::string, Direction> directions = {{"x", Direction::x}, {"y", Direction::y},
        {"z", Direction::z}, {"axial", Direction::axial}, {"radial", Direction::radial}};
    require_file_name(entry);
    const Region region = require_region(entry.table.region, entry.diameter, entry.key("region"));
    const Direction direction = directions.at(entry.table.direction);
    if ((region.shape == Region::Shape::box) != (direction < Direction::axial))
        throw SceneError(entry.key("direction"), "a box is cut along 'x', 'y' or 'z', a cylinder 'axial' or 'radial'");
    const RegionBins bins(region, direction, static_cast<std::size_t>(entry.table.bins));
    return std::make_unique<Profile>(entry.table.name, bins, build_window(entry));
}

std::unique_ptr<Sensor> build_wall_force(const Entry& entry, const std::vector<Wall>& walls)
{
    const std::size_t wall = index_of(walls, "wall", entry.table.wall, entry.key("wall"));
    return std::make_unique<WallForce>(entry.table.name, wall, entry.table.point, build_window(entry));
}

std::unique_ptr<Sensor> build_wall_position(const Entry& entry, const std::vector<Wall>& walls)
{
    const Wall& wall = walls[index_of(walls, "wall", entry.table.wall, entry.key("wall"))];
    if (!wall.is_piston())
        throw SceneError(entry.key("wall"), "the wall '" + wall.name + "' has no finite mass: it moves as prescribed");
    return std::make_unique<WallPosition>(entry.table.name, static_cast<std::size_t>(wall.piston), build_window(entry));
}

std::unique_ptr<Sensor> build_sensor(const Entry& entry, const Model& model)
{
    if (entry.table.kind == "mass_flow") return build_mass_flow(entry, model.periodicity);
    if (entry.table.kind == "repose") return build_repose(entry, model.gravity);
    if (entry.table.kind == "slope") return build_slope(entry);
    if (entry.table.kind == "region") return build_region_average(entry);
    if (entry.table.kind == "profile") return build_profile(entry);
    if (entry.table.kind == "sphere") return std::make_unique<SphereTrack>(entry.table.name, entry.table.id);
    if (entry.table.kind == "wall_position") return build_wall_position(entry, model.walls);
    return build_wall_force(entry, model.walls);
}

} // namespace

std::vector<std::unique_ptr<Sensor>> build_sensors(const scene::Scene& scene, const Model& model)
{
    std::vector<std::unique_ptr<Sensor>> sensors;
    for (std::size_t k = 0; k < scene.sensor.size(); ++k)
        sensors.push_back(build_sensor({scene.sensor[k], k, model.mean_diameter}, model));
    return sensors;
}

} // namespace talus
