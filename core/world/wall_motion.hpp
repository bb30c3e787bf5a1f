// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/pose.hpp"

#include <variant>
#include <vector>

namespace talus
{

/// When a part of a motion goes on; before it the wall is where it was, after it where it has come to.
struct MotionSpan {
    double from = 0.0;    ///< [s]
    double to = infinity; ///< [s]

    /// How long it has been going on at this time [s].
    double elapsed(double time) const;
};

/// At a constant velocity.
struct Translation {
    MotionSpan span;
    Vec3 velocity = Vec3::Zero(); ///< [m/s]
};

/// About a fixed axis at a constant rate.
struct Turning {
    MotionSpan span;
    Vec3 point = Vec3::Zero(); ///< on the axis [m]
    Vec3 axis = Vec3::UnitZ(); ///< unit
    double rate = 0.0;         ///< [rad/s], right-handed
};

/// To and fro: amplitude sin(2π frequency t).
struct Shaking {
    MotionSpan span;
    Vec3 amplitude = Vec3::Zero(); ///< [m]
    double frequency = 0.0;        ///< [Hz]
};

/// Along a table of times and places, in straight lines between them; held at its ends.
struct Course {
    struct Waypoint {
        double time; ///< [s]
        Vec3 shift;  ///< from where the wall stands in the scene [m]
    };
    std::vector<Waypoint> waypoints; ///< in ascending order of time, at least one
};

using MotionPart = std::variant<Translation, Turning, Shaking, Course>;

/// A motion made of parts: the first moves the wall in its own frame, the next what came of it, and so on.
using WallMotion = std::vector<MotionPart>;

/// The pose at a time [s]; that of no motion is the identity.
Pose pose_at(const WallMotion& motion, double time);

} // namespace talus
