// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/properties/transformed.hpp"

#include "core/candidates/candidate_search.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace talus::test
{
namespace
{

template <class... Cases> struct Overloaded : Cases... {
    using Cases::operator()...;
};

class Transformer
{
public:
    Transformer(const World& from, const Transform& transform) : from_(from), t_(transform) {}

    World make(double h)
    {
        to_.model = from_.model;
        to_.report = from_.report;
        transform_model();
        transform_state();
        lay_down(h);
        return std::move(to_);
    }

private:
    const World& from_;
    const Transform& t_;
    World to_;

    double speed() const { return t_.length / t_.time; }
    double impulse() const { return t_.mass * speed(); }
    double force() const { return impulse() / t_.time; }

    Shape shape(const Shape& old, const Vec3& shift) const
    {
        const auto place = [&](const Vec3& x) { return Vec3(t_.place(x) + shift); };
        return std::visit(
            Overloaded{[&](const Plane& s) -> Shape {
                           return Plane{place(s.point), t_.arrow(s.normal)};
                       },
                [&](const Cylinder& s) -> Shape {
                    return Cylinder{place(s.base), t_.arrow(s.axis), t_.length * s.radius, t_.length * s.height};
                },
                [&](const Cone& s) -> Shape {
                    return Cone{place(s.base), t_.arrow(s.axis), t_.length * s.base_radius, t_.length * s.top_radius,
                        t_.length * s.height};
                },
                [&](const Disk& s) -> Shape {
                    return Disk{place(s.center), t_.arrow(s.normal), t_.length * s.radius, t_.length * s.hole_radius};
                },
                [&](const Panels& s) -> Shape {
                    Panels panels;
                    for (const Panels::Rectangle& r : s.rectangles)
                        panels.rectangles.push_back({place(r.corner), Vec3(t_.length * t_.arrow(r.edge_a)),
                            Vec3(t_.length * t_.arrow(r.edge_b))});
                    return panels;
                },
                [&](const Mesh& s) -> Shape {
                    std::vector<Vec3> vertices;
                    for (const Vec3& x : s.vertices) vertices.push_back(place(x));
                    return make_mesh(vertices, s.triangles);
                },
                [&](const Grains& s) -> Shape {
                    Grains grains{{}, t_.length * s.radius};
                    for (const Vec3& x : s.centers) grains.centers.push_back(place(x));
                    std::ranges::sort(grains.centers, {}, [](const Vec3& x) { return x.x(); });
                    return grains;
                }},
            old);
    }

    MotionSpan span(const MotionSpan& old) const { return {t_.time * old.from, t_.time * old.to}; }

    MotionPart part(const MotionPart& old) const
    {
        return std::visit(
            Overloaded{[&](const Translation& m) -> MotionPart {
                           return Translation{span(m.span), Vec3(speed() * t_.arrow(m.velocity))};
                       },
                [&](const Turning& m) -> MotionPart {
                    return Turning{span(m.span), t_.place(m.point), t_.axis(m.axis), m.rate / t_.time};
                },
                [&](const Shaking& m) -> MotionPart {
                    return Shaking{span(m.span), Vec3(t_.length * t_.arrow(m.amplitude)), m.frequency / t_.time};
                },
                [&](const Course& m) -> MotionPart {
                    Course course;
                    for (const Course::Waypoint& w : m.waypoints)
                        course.waypoints.push_back({t_.time * w.time, Vec3(t_.length * t_.arrow(w.shift))});
                    return course;
                }},
            old);
    }

    void transform_model()
    {
        Model& model = to_.model;
        model.gravity = t_.length / (t_.time * t_.time) * t_.arrow(model.gravity);
        model.time_step *= t_.time;
        for (ContactLaw& law : model.materials.laws) {
            law.stiffness *= t_.mass / (t_.time * t_.time);
            law.modulus *= t_.mass / (t_.length * t_.time * t_.time);
        }
        for (double* d : {&model.mean_diameter, &model.min_diameter, &model.max_diameter}) *d *= t_.length;
        model.solver.push_out_speed *= speed();
        const bool boosted = !t_.boost.isZero(0.0);
        const Vec3 back = -t_.time * from_.state.time * t_.boost; // so that now all stands where it stood
        for (Wall& wall : model.walls) {
            wall.shape = shape(wall.shape, boosted && !wall.is_piston() ? back : Vec3(Vec3::Zero()));
            for (MotionPart& one : wall.motion) one = part(one);
            if (boosted && !wall.is_piston()) wall.motion.push_back(Translation{{}, t_.boost});
            model.physics.moving_walls = model.physics.moving_walls || !wall.motion.empty();
        }
        for (Piston& piston : model.pistons) {
            piston.mass *= t_.mass;
            piston.guide = t_.arrow(piston.guide);
            piston.center = t_.place(piston.center);
            piston.inertia = t_.mass * t_.length * t_.length * (t_.turn * piston.inertia * t_.turn.transpose());
            for (LoadPoint& load : piston.load) load = {t_.time * load.time, force() * load.force};
            piston.released_at *= t_.time;
        }
    }

    void transform_state()
    {
        const State& old = from_.state;
        State& state = to_.state;
        state = old;
        const std::size_t count = old.count();
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t j = t_.reversed ? count - 1 - i : i;
            state.position[j] = t_.place(old.position[i]);
            state.position_rest[j] = t_.length * t_.arrow(old.position_rest[i]);
            state.radius[j] = t_.length * old.radius[i];
            const Body& m = old.body(i);
            state.body(j) = {t_.velocity(m.velocity), m.inverse_mass / t_.mass, speed() * t_.axis(m.rim_velocity),
                t_.length * m.spin_radius};
            state.material[j] = old.material[i];
            state.id[j] = old.id[i];
            state.last_wall[j] = old.last_wall[i];
            state.leaving[j] = old.leaving[i];
        }
        state.time *= t_.time;
        if (state.steps == 0) state.steps = 1; // else spheres are renumbered
        for (std::size_t k = 0; k < state.pistons.size(); ++k) {
            PistonState& piston = state.pistons[k];
            const PistonState& was = old.pistons[k];
            piston.pose.rotation = t_.turn * was.pose.rotation * t_.turn.transpose();
            piston.pose.shift = t_.length * t_.arrow(was.pose.shift) + t_.shift - piston.pose.rotation * t_.shift;
            piston.velocity = t_.velocity(was.velocity);
            piston.spin = t_.axis(was.spin) / t_.time;
            turn_guide_impulse(piston.guide_impulse, from_.model.pistons[k].guide, to_.model.pistons[k].guide);
        }
    }

    /// Its first two rows are those of axes across the guide (step_parts.cpp), the next three turns.
    void turn_guide_impulse(PistonState::GuideVector& rows, const Vec3& old_guide, const Vec3& guide) const
    {
        const Vec3 old_across = any_perpendicular(old_guide), across = any_perpendicular(guide);
        const Vec3 push = impulse() * t_.arrow(rows[0] * old_across + rows[1] * old_guide.cross(old_across));
        const Vec3 twist = t_.length * impulse() * t_.axis(rows.segment<3>(2));
        rows << push.dot(across), push.dot(guide.cross(across)), twist, impulse() * rows[5];
    }

    CarriedContact carried(const CarriedContact& old, double sign) const
    {
        CarriedContact now = old;
        now.impulse = sign * impulse() * t_.arrow(old.impulse);
        now.compression = static_cast<float>(old.compression * t_.length);
        return now;
    }

    void lay_down(double h)
    {
        Model& model = to_.model;
        ContactNetwork& network = to_.network;
        const auto search = [&] {
            network = {};
            network.carried.impulse_step = from_.network.carried.impulse_step * t_.time;
            const auto walls = place_walls(model, to_.state, h);
            update_candidates(network.list, network.carried, to_.state, model, h, walls);
        };
        search();
        Box around;
        for (const Vec3& x : to_.state.position) around.extend(x);
        const Vec3 corner = around.center() - Vec3::Constant(0.5 * network.list.tile_edge);
        model.contents = {corner, corner + Vec3::Constant(network.list.tile_edge)};
        search();
        carry_spheres();
        carry_walls();
    }

    void carry_spheres()
    {
        std::map<std::pair<std::int64_t, std::int64_t>, CarriedContact> known;
        for (const Tile& tile : from_.network.list.tiles.tiles)
            for (std::size_t slot = 0; slot < tile.pairs.size(); ++slot)
                known[{id(from_, tile.pairs[slot].a), id(from_, tile.pairs[slot].b)}] = tile.carried.contact[slot];
        for (Tile& tile : to_.network.list.tiles.tiles)
            for (std::size_t slot = 0; slot < tile.pairs.size(); ++slot) {
                const auto a = id(to_, tile.pairs[slot].a), b = id(to_, tile.pairs[slot].b);
                if (const auto same = known.find({a, b}); same != known.end())
                    tile.carried.contact[slot] = carried(same->second, 1.0);
                else if (const auto other = known.find({b, a}); other != known.end())
                    tile.carried.contact[slot] = carried(other->second, -1.0);
            }
    }

    void carry_walls()
    {
        std::map<std::pair<std::int64_t, std::int32_t>, const WallPair*> known;
        for (const WallPair& pair : from_.network.list.wall_pairs) known[{id(from_, pair.sphere), pair.wall}] = &pair;
        Carried& now = to_.network.carried;
        for (WallPair& pair : to_.network.list.wall_pairs) {
            const auto found = known.find({id(to_, pair.sphere), pair.wall});
            if (found == known.end()) continue;
            const WallPair& old = *found->second;
            pair.carried = std::min(old.carried, pair.patches);
            for (std::uint32_t k = 0; k < pair.carried; ++k) {
                now.walls.contact[pair.first + k] = carried(from_.network.carried.walls.contact[old.first + k], 1.0);
                now.wall_normal[pair.first + k] = t_.arrow(from_.network.carried.wall_normal[old.first + k]);
            }
        }
    }

    static std::int64_t id(const World& world, std::int32_t sphere)
    {
        return world.state.id[static_cast<std::size_t>(sphere)];
    }
};

} // namespace

World transformed(const World& world, const Transform& transform, double h)
{
    return Transformer(world, transform).make(h);
}

} // namespace talus::test
