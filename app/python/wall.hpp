// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/python/session.hpp"

namespace talus::python
{

/// A wall of a simulation, by name.
class WallHandle
{
public:
    /// @throws std::out_of_range where there is none of this name
    WallHandle(std::shared_ptr<Session> session, const std::string& name);

    const std::string& name() const { return wall().name; }
    Vec3 force() const;    ///< of the spheres on it, the mean over the last step [N]
    Vec3 torque() const;   ///< of the same about the origin [N m]
    Vec3 position() const; ///< of the middle of its box, as it stands; of a plane, of its point [m]
    Vec3 velocity() const; ///< of its material there, the mean over the step that begins now [m/s]
    double load() const;   ///< on a wall of finite mass, along its guide [N]

    void set_velocity(const Vec3& velocity); ///< @throws std::invalid_argument where the wall has a finite mass
    void set_load(double force);             ///< @throws std::invalid_argument where it has none

private:
    std::shared_ptr<Session> session_;
    std::size_t index_;

    const Wall& wall() const { return session_->now().model.walls[index_]; }
    std::size_t piston() const;
    WallLoad last_load() const;
    PlacedWall placed() const;
};

} // namespace talus::python
