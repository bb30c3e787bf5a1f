// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/properties/event_driven.hpp"

#include "core/base/region.hpp"

#include <algorithm>
#include <cmath>

namespace talus::test
{
namespace
{

constexpr double never = std::numeric_limits<double>::infinity();

} // namespace

double time_to_touch(const Vec3& x, const Vec3& v, double distance)
{
    const double closing = -x.dot(v), square = v.squaredNorm();
    if (!(closing > 0.0)) return never;
    const double apart = x.squaredNorm() - distance * distance;
    const double root = closing * closing - square * apart;
    if (root < 0.0) return never;
    return std::max(0.0, apart / (closing + std::sqrt(root))); // the smaller root, without cancellation
}

double time_to_fall(double height, double speed, double fall)
{
    const double root = speed * speed + 2.0 * fall * height;
    if (fall == 0.0) return speed < 0.0 ? std::max(0.0, -height / speed) : never;
    if (root < 0.0) return never; // fall < 0, and it turns before
    const double s = std::sqrt(root);
    if (fall > 0.0) return std::max(0.0, speed > 0.0 ? (speed + s) / fall : 2.0 * height / (s - speed));
    return speed < 0.0 ? std::max(0.0, 2.0 * height / (s - speed)) : never;
}

std::vector<Event> EventDriven::next_two() const
{
    std::vector<Event> next(2, Event{.time = never});
    const auto consider = [&](Event event, double wait) {
        event.time = time + wait;
        if (event.time < next[0].time) std::swap(event, next[0]);
        if (event.time < next[1].time) std::swap(event, next[1]);
    };
    for (int a = 0; a < static_cast<int>(spheres.size()); ++a) {
        const FreeSphere& s = spheres[static_cast<std::size_t>(a)];
        for (int b = 0; b < a; ++b) {
            const FreeSphere& t = spheres[static_cast<std::size_t>(b)];
            const Event event{.a = a, .b = b};
            if (!event.same_bodies(last)) consider(event, time_to_touch(s.x - t.x, s.v - t.v, s.radius + t.radius));
        }
        for (int w = 0; w < static_cast<int>(faces.size()); ++w) {
            const Face& face = faces[static_cast<std::size_t>(w)];
            const Event event{.a = a, .b = w, .with_wall = true};
            double height = (s.x - face.point).dot(face.normal) - s.radius;
            const double fall = -gravity.dot(face.normal), speed = s.v.dot(face.normal);
            if (event.same_bodies(last))
                height = 0.0, consider(event, fall > 0.0 ? 2.0 * speed / fall : never);
            else
                consider(event, time_to_fall(height, speed, fall));
        }
    }
    return next;
}

void EventDriven::fly(double until)
{
    const double t = until - time;
    for (FreeSphere& s : spheres) {
        s.x += t * s.v + 0.5 * t * t * gravity;
        s.v += t * gravity;
    }
    time = until;
}

void EventDriven::strike(const Event& event)
{
    fly(event.time);
    FreeSphere& a = spheres[static_cast<std::size_t>(event.a)];
    last = event;
    if (event.with_wall) {
        const Vec3& n = faces[static_cast<std::size_t>(event.b)].normal;
        last.speed = -a.v.dot(n);
        a.v += (1.0 + restitution) * last.speed * n;
        return;
    }
    FreeSphere& b = spheres[static_cast<std::size_t>(event.b)];
    const Vec3 n = (a.x - b.x).normalized();
    last.speed = -(a.v - b.v).dot(n);
    const Vec3 impulse = (1.0 + restitution) * last.speed / (1.0 / a.mass + 1.0 / b.mass) * n;
    a.v += impulse / a.mass;
    b.v -= impulse / b.mass;
}

} // namespace talus::test
