// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/simulation/interventions.hpp"

#include "core/simulation/simulation.hpp"
#include "core/supply/removal.hpp"

#include <algorithm>

namespace talus
{
namespace
{

void end_at(double time, Course& course)
{
    const Vec3 shift = pose_at({course}, time).shift;
    std::erase_if(course.waypoints, [&](const Course::Waypoint& point) { return point.time >= time; });
    course.waypoints.push_back({time, shift});
}

void end_at(double time, auto& part)
{
    part.span.to = std::min(part.span.to, time);
}

/// What is left of a motion that ends at this time, where it has come to.
WallMotion ended_at(double time, WallMotion motion)
{
    for (MotionPart& part : motion) std::visit([&](auto& p) { end_at(time, p); }, part);
    return motion;
}

Vec3 way_of(const Translation& part)
{
    return (part.span.to - part.span.from) * part.velocity;
}

/// Ends the last way at this time and begins another. The way of the step before is kept apart, for the velocity of
/// that step counts; what was before it is one.
void turn_to(std::vector<Translation>& ways, const Vec3& velocity, double time)
{
    if (!ways.empty() && ways.back().span.from >= time) ways.pop_back();
    if (!ways.empty()) ways.back().span.to = time;
    if (ways.size() == 3) {
        const double from = ways[0].span.from, to = ways[1].span.to;
        ways[1] = {{from, to}, (way_of(ways[0]) + way_of(ways[1])) / (to - from)};
        ways.erase(ways.begin());
    }
    ways.push_back({{time, infinity}, velocity});
}

void persist_way(Archive& archive, Translation& way)
{
    archive(way.span.from, way.span.to, way.velocity);
}

} // namespace

void Interventions::Drive::apply(Model& model) const
{
    model.walls[wall].motion = ended_at(from, prescribed);
    for (const Translation& way : ways) model.walls[wall].motion.push_back(way);
    model.physics.moving_walls = true;
}

void Interventions::Drive::persist(Archive& archive)
{
    archive(wall, from);
    std::uint64_t count = ways.size();
    archive(count);
    ways.resize(static_cast<std::size_t>(std::min<std::uint64_t>(count, 3)));
    for (Translation& way : ways) persist_way(archive, way);
}

void Interventions::Load::apply(Model& model) const
{
    model.pistons[piston].load = {{0.0, force}};
}

void Interventions::drive(Model& model, std::size_t wall, const Vec3& velocity, double time)
{
    any = true;
    auto found = std::ranges::find(drives_, wall, &Drive::wall);
    if (found == drives_.end()) found = drives_.insert(found, Drive{wall, time, {}, model.walls[wall].motion});
    turn_to(found->ways, velocity, time);
    found->apply(model);
}

void Interventions::load(Model& model, std::size_t piston, double force)
{
    any = true;
    auto found = std::ranges::find(loads_, piston, &Load::piston);
    if (found == loads_.end()) found = loads_.insert(found, Load{piston, force, model.pistons[piston].load});
    found->force = force;
    found->apply(model);
}

void Interventions::persist(Archive& archive, Model& model)
{
    if (archive.reading()) {
        for (const Drive& drive : drives_) model.walls[drive.wall].motion = drive.prescribed;
        for (const Load& load : loads_) model.pistons[load.piston].load = load.prescribed;
    }
    archive(any, taken_out, drives_, loads_);
    if (!archive.reading()) return;
    for (Drive& drive : drives_) {
        if (drive.wall >= model.walls.size()) throw ArchiveError("it is of a scene with more walls");
        drive.prescribed = model.walls[drive.wall].motion;
        drive.apply(model);
    }
    for (Load& load : loads_) {
        if (load.piston >= model.pistons.size()) throw ArchiveError("it is of a scene with more walls of finite mass");
        load.prescribed = model.pistons[load.piston].load;
        load.apply(model);
    }
}

void drive_wall(Simulation& simulation, std::size_t wall, const Vec3& velocity)
{
    simulation.interventions.drive(simulation.model, wall, velocity, simulation.state.time);
    simulation.network.list.listed_pose.clear(); // a wall that has stood still is listed without room to move
}

void load_piston(Simulation& simulation, std::size_t piston, double force)
{
    simulation.interventions.load(simulation.model, piston, force);
}

void set_own_force(Simulation& simulation, std::size_t sphere, const Vec3& force)
{
    simulation.interventions.any = true;
    simulation.state.own_force.resize(simulation.state.count(), Vec3::Zero());
    simulation.state.own_force[sphere] = force;
}

std::size_t put_in(Simulation& simulation, const Vec3& position, double diameter, int material, const Vec3& velocity)
{
    simulation.interventions.any = true;
    const double density = simulation.model.materials.list[static_cast<std::size_t>(material)].density;
    return add_sphere(simulation.state, position, 0.5 * diameter, density, material, velocity);
}

void take_out(Simulation& simulation, const std::vector<std::uint8_t>& gone)
{
    simulation.interventions.any = true;
    simulation.interventions.taken_out += std::ranges::count_if(gone, [](std::uint8_t one) { return one != 0; });
    remove_spheres(simulation.state, simulation.network, gone);
}

} // namespace talus
