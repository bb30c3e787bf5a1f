// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/properties/random_world.hpp"

#include "tests/properties/draw.hpp"
#include "tests/properties/room.hpp"
#include "tests/support/contacts.hpp"

#include "core/law/hertz.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

namespace talus::test
{
namespace
{

constexpr double r0 = standard_radius;   ///< of the largest spheres
constexpr double allowed_overlap = 0.02; ///< of what was not asked to touch, in smallest diameters
constexpr int max_sweeps = 100'000, warm_up_sweeps = 3000;

template <class... Parts> std::string line(const Parts&... parts)
{
    std::ostringstream text;
    text.precision(4);
    (text << ... << parts);
    return text.str();
}

std::string told(const Vec3& v, double unit = 1.0)
{
    return line("(", v.x() / unit, " ", v.y() / unit, " ", v.z() / unit, ")");
}

class Maker
{
public:
    Maker(std::uint64_t seed, const Wish& wish) : draw_(seed), wish_(wish) { made_.seed = seed; }

    RandomWorld make()
    {
        draw_sizes();
        draw_laws();
        draw_steps();
        draw_walls();
        if (has_up_ && draw_.chance(0.2)) stack();
        for (std::size_t k = world_.state.count(); k < radius_.size(); ++k) place_sphere(k);
        if (world_.state.count() == 0) place_anywhere(0);
        set_diameters();
        if (wish_.pistons && has_up_ && draw_.chance(0.2)) place_piston();
        draw_velocities();
        if (wish_.attraction) draw_attraction();
        if (wish_.elasticity) draw_moduli();
        world_.model.contents = contents();
        return std::move(made_);
    }

private:
    Draw draw_;
    Wish wish_;
    RandomWorld made_;
    World& world_ = made_.world;
    std::vector<double> radius_, mass_;
    double d_min_ = 0.0, d_max_ = 0.0, h_ = 0.0;
    Vec3 middle_ = Vec3::Zero(); ///< where spheres go
    double spread_ = 0.0;
    bool has_up_ = false; ///< there is a floor, whose normal is +z

    template <class... Parts> void tell(const Parts&... parts) { made_.told.push_back(line(parts...)); }

    void draw_sizes()
    {
        const int count = draw_.integer(1, 8);
        const double decades = draw_.one_of({0.0, 0.0, draw_.uniform(0, 1), draw_.uniform(0, 1), 1.0});
        for (int k = 0; k < count; ++k) radius_.push_back(r0 * std::pow(10.0, -decades * draw_.uniform(0, 1)));
        if (draw_.chance(0.3)) // a big one, and small ones
            for (std::size_t k = 1; k < radius_.size(); ++k) radius_[k] = radius_.back();
        const double m0 = standard_density * 4.0 / 3.0 * std::numbers::pi * r0 * r0 * r0;
        const double heavy = draw_.one_of({0.0, 1.0, 10.0, 30.0, 100.0, 1000.0});
        for (const double r : radius_)
            mass_.push_back(heavy == 0.0 ? m0 * std::pow(r / r0, 3) : m0 * std::pow(heavy, draw_.uniform(-0.5, 0.5)));
        if (heavy > 1.0 && draw_.chance(0.5)) // one at each end
            for (double& m : mass_) m = m0 * (draw_.chance(0.5) ? std::sqrt(heavy) : 1.0 / std::sqrt(heavy));
        d_min_ = 2.0 * *std::ranges::min_element(radius_);
        d_max_ = 2.0 * *std::ranges::max_element(radius_);
        spread_ = d_max_;
    }

    double draw_restitution()
    {
        return draw_.one_of({0.0, 0.0, 1.0, 0.9, 0.5, draw_.uniform(0, 1), draw_.uniform(0, 1)});
    }

    void draw_laws()
    {
        ContactLaw spheres, walls;
        spheres.restitution = draw_restitution();
        walls.restitution = draw_.chance(0.5) ? spheres.restitution : draw_restitution();
        const bool rough = draw_.chance(0.5);
        if (wish_.friction.value_or(rough)) spheres.friction = walls.friction = 0.5;
        if (draw_.chance(0.1)) spheres.stiffness = walls.stiffness = draw_.log_uniform(1e2, 1e5);

        const auto law = draw_.chance(0.5) || wish_.elasticity ? Stabilisation::matched : Stabilisation::projected;
        const double tolerance = 1e-12;
        SolverSettings solver = law == Stabilisation::matched ? matched_settings(tolerance, max_sweeps)
                                                              : rigid_settings(tolerance, max_sweeps);
        h_ = automatic_step(d_min_) * draw_.one_of({1.0, 1.0, 1.0, 0.3, 3.0});
        world_ = make_world(spheres, walls, solver, h_);
        if (const double which = draw_.uniform(0, 1); which < 0.2)
            world_.model.gravity.setZero();
        else if (which < 0.3)
            world_.model.gravity = standard_gravity * draw_.direction();
        const bool push = draw_.chance(0.7), at_once = draw_.chance(0.1);
        world_.model.solver.push_out_speed = !wish_.push_out.value_or(push) ? 0.0
                                             : at_once                      ? infinity
                                                                            : automatic_push_out_speed(d_max_);
        made_.warm_up_tolerance = draw_.one_of({1e-2, 1e-4, 1e-12});
        tell(name_of(law), ", e ", spheres.restitution, ", at walls ", walls.restitution, ", mu ", spheres.friction,
            ", k ", spheres.stiffness, " N/m, gravity ", told(world_.model.gravity), ", h ", h_, " s, p ",
            world_.model.solver.push_out_speed, " m/s, d_min ", d_min_, " m, steps before solved to ",
            made_.warm_up_tolerance);
    }

    void draw_attraction()
    {
        const double weight = *std::ranges::min_element(mass_) * standard_gravity;
        const Attraction law{.force = weight * draw_.log_uniform(1e-2, 1e3),
            .range = d_min_ * draw_.log_uniform(1e-3, 0.5),
            .volume = draw_.chance(0.5) ? 0.0 : std::pow(d_min_, 3) * draw_.log_uniform(1e-5, 1e-2)};
        world_.attract(law);
        tell("attract each other with ", law.force / weight, " weights of the lightest, up to a gap of ",
            law.range / d_min_, " d, as bridges of ", law.volume / std::pow(d_min_, 3), " d3");
    }

    /// Such that the springs of the lightest get as stiff as sweeps can carry at any share of a diameter.
    void draw_moduli()
    {
        const double least_mass = *std::ranges::min_element(mass_), knee = d_min_ * draw_.log_uniform(1e-6, 1.0);
        const double carried =
            carried_stiffness<double>(2.0 / least_mass, law_of_step(world_.model, part_of_step(world_.model, 1)));
        const double modulus = 0.6 * carried / std::sqrt(0.25 * d_min_ * knee);
        const double of_walls = draw_.one_of({1.0, 2.0, 0.01, infinity});
        auto& laws = world_.model.materials.laws;
        for (ContactLaw& law : laws) {
            law.modulus = &law == laws.data() ? modulus : of_walls * modulus;
            law.stiffness = infinity;
        }
        world_.model.physics.elasticity = true;
        tell("E* ", modulus, " Pa, at walls ", of_walls, " times that: of the lightest as stiff as sweeps carry at ",
            knee / d_min_, " d");
    }

    void draw_steps()
    {
        const int before = draw_.chance(0.2) ? 0 : draw_.integer(0, 20);
        const double which = draw_.uniform(0, 1);
        const int parts = draw_.integer(2, 8);
        for (int k = 0; k <= before; ++k)
            made_.parts.push_back(which < 0.7 || (which < 0.85 && draw_.chance(0.5)) ? 1 : parts);
    }

    void add_wall(const std::string& name, const Shape& shape, const Vec3& normal)
    {
        WallMotion motion;
        std::string how = "stands still";
        if (wish_.moving_walls && draw_.chance(0.2)) {
            const double speed = 0.1 * d_min_ / h_ * std::pow(10.0, -draw_.uniform(0, 3));
            const Vec3 along = draw_.chance(0.6) ? Vec3(draw_.sign() * normal) : draw_.direction();
            if (const double which = draw_.uniform(0, 1); which < 0.5) {
                motion = {Translation{{}, speed * along}};
                how = line("moves with ", told(speed * along), " m/s");
            } else if (which < 0.75) {
                const double steps = draw_.log_uniform(5, 200);
                const double frequency = 1.0 / (steps * h_);
                motion = {Shaking{{}, speed / (2 * std::numbers::pi * frequency) * along, frequency}};
                how = line("shakes along ", told(along), " with up to ", speed, " m/s, once in ", steps, " steps");
            } else {
                Turning turning{{}, d_max_ * draw_.in_cube(), draw_.direction(), speed / (3 * d_max_)};
                motion = {turning};
                how = line("turns about ", told(turning.point, d_min_), " d, axis ", told(turning.axis), " with ",
                    turning.rate, " 1/s");
            }
        }
        tell("wall ", world_.model.walls.size(), ": ", name, ", ", how);
        world_.add_wall(shape, motion);
    }

    void add_plane(const Vec3& point, const Vec3& normal)
    {
        add_wall(
            line("plane through ", told(point, d_min_), " d, normal ", told(normal)), Plane{point, normal}, normal);
    }

    Vec3 tilted(const Vec3& axis)
    {
        return draw_.chance(0.7) ? axis : Vec3((axis + draw_.uniform(0, 0.4) * draw_.direction()).normalized());
    }

    void draw_walls()
    {
        const double d = d_max_;
        const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
        const auto leaning = [&](const Vec3& axis) { // of a wall beside the floor: 60 to 120 degrees
            return draw_.chance(0.4) ? axis : Vec3((axis + draw_.uniform(-0.5, 0.5) * z).normalized());
        };
        middle_ = d * z;
        if (wish_.press) return close_in();
        switch (draw_.one_of({0, 1, 1, 1, 2, 2, 3, 3, 4, 5, 5, 6, 6, 7, 8})) {
        case 0:
            middle_.setZero();
            return;
        case 1:
            add_plane(Vec3::Zero(), tilted(z));
            has_up_ = true;
            return;
        case 2:
            add_plane(Vec3::Zero(), tilted(z));
            add_plane(Vec3::Zero(), leaning(x));
            middle_ = d * (x + z);
            has_up_ = true;
            return;
        case 3:
            add_plane(Vec3::Zero(), tilted(z));
            add_plane(Vec3::Zero(), leaning(x));
            add_plane(Vec3::Zero(), leaning(y));
            middle_ = d * (x + y + z);
            has_up_ = true;
            return;
        case 4: {
            const double slope = draw_.uniform(0.3, 1.2);
            add_plane(Vec3::Zero(), Vec3(std::sin(slope), 0, std::cos(slope)));
            add_plane(Vec3::Zero(), Vec3(-std::sin(slope), 0, std::cos(slope)));
            middle_ = 2 * d * z;
            has_up_ = true;
            return;
        }
        case 5: {
            const double height = d * draw_.one_of({1.0, draw_.uniform(1, 1.2), draw_.uniform(1, 3)});
            add_plane(Vec3::Zero(), z);
            add_plane(height * z, draw_.chance(0.7) ? Vec3(-z) : Vec3(-tilted(z)));
            middle_ = 0.5 * height * z;
            return;
        }
        case 6: {
            const double fold = draw_.one_of({0.0, 0.0, draw_.uniform(-2, 2)});
            const Mesh mesh = make_mesh(
                {{0, -3 * d, 0}, {0, 3 * d, 0}, {4 * d, 0, 0}, {-4 * d, 0, fold * d}}, {{{0, 2, 1}}, {{0, 1, 3}}});
            add_wall(
                line("mesh of two triangles, joined along y, the one at x < 0 rises to ", fold, " d_max"), mesh, z);
            spread_ = 0.5 * d;
            has_up_ = true;
            return;
        }
        case 7: {
            const Vec3 corner(-4 * d, -4 * d, 0);
            add_wall("panel z = 0 with its edge at x = 0", Panels{{{corner, 4 * d * x, 8 * d * y}}}, z);
            if (draw_.chance(0.5)) add_plane(Vec3(0, 0, -d * draw_.uniform(0.2, 2)), z);
            spread_ = 0.7 * d;
            return;
        }
        default: {
            const Box box{Vec3::Zero(), Vec3::Constant(4 * d)};
            add_wall("panels of a box from the origin on", box_panels(box, {"z+"}), z);
            middle_ = d * (x + y + z);
            has_up_ = true;
        }
        }
    }

    /// A floor, and what comes down on it: a plane, or a plate beside which there is room; perhaps in a tube.
    void close_in()
    {
        const double height = d_max_ * draw_.uniform(1, 2.5), speed = d_max_ / h_ * draw_.log_uniform(1e-3, 5e-2);
        const Vec3 z = Vec3::UnitZ(), down = draw_.chance(0.7) ? Vec3(-z) : Vec3(-tilted(z));
        middle_ = 0.5 * height * z;
        tell("wall 0: plane z = 0; wall 1: at z = ", height / d_min_, " d, normal ", told(down), ", comes down with ",
            speed, " m/s");
        world_.add_plane(Vec3::Zero(), z);
        const Shape above =
            draw_.chance(0.6) ? Shape(Plane{height * z, down}) : Shape(Disk{height * z, down, d_max_, 0.0});
        world_.add_wall(above, {Translation{{0.0, d_max_ * draw_.uniform(0.5, 2) / speed}, -speed * z}});
        if (draw_.chance(0.3)) {
            tell("wall 2: a tube round the z axis of radius ", 1.5 * d_max_ / d_min_, " d");
            world_.add_wall(Cylinder{Vec3(0, 0, -d_max_), z, 1.5 * d_max_, 6 * d_max_});
            spread_ = 0.7 * d_max_;
        }
    }

    double draw_gap()
    {
        const double which = draw_.uniform(0, 1);
        if (which < 0.35) return 0.0;
        if (which < 0.45) return draw_.sign() * d_min_ * std::pow(10.0, draw_.uniform(-16, -9));
        if (which < 0.65) return -d_min_ * std::pow(10.0, draw_.uniform(-6, -2.2));
        if (which < 0.67) return -d_min_ * draw_.uniform(0.01, 0.2);
        if (which < 0.85) return d_min_ * std::pow(10.0, draw_.uniform(-6, -2));
        return d_min_ * draw_.uniform(0.01, 0.3);
    }

    /// Where a ball at x is nearest to object k: a sphere, or a wall behind them.
    std::pair<Vec3, double> nearest(std::size_t k, const Vec3& x, double r, const std::vector<PlacedWall>& walls) const
    {
        const State& state = world_.state;
        if (k < state.count()) {
            const Vec3 apart = x - state.position[k];
            const double distance = apart.norm();
            return {distance > 0 ? Vec3(apart / distance) : Vec3::UnitZ(), distance - r - state.radius[k]};
        }
        const PlacedWall& wall = walls[k - state.count()];
        WallPoint best{Vec3::Zero(), Vec3::UnitZ(), infinity, 0};
        for (std::size_t patch = 0; patch < wall.patch_count(); ++patch)
            if (const WallPoint at = wall.nearest_point(patch, x); at.distance < best.distance) best = at;
        return {best.normal, best.distance - r};
    }

    void place_sphere(std::size_t own)
    {
        const double r = radius_[own];
        const auto walls = world_.placed_walls();
        const std::size_t objects = world_.state.count() + walls.size();
        for (int attempt = 0; attempt < 30; ++attempt) {
            Vec3 x = middle_ + spread_ * draw_.in_cube();
            const int wanted = std::min<int>(draw_.one_of({0, 1, 1, 2, 2, 3, 3}), static_cast<int>(objects));
            std::vector<std::size_t> which(objects);
            std::vector<double> gap;
            for (std::size_t k = 0; k < objects; ++k) which[k] = k;
            std::ranges::sort(which, {}, [&](std::size_t k) { return nearest(k, x, r, walls).second; });
            if (draw_.chance(0.3) && objects > 3) std::swap(which[0], which[3]);
            for (int k = 0; k < wanted; ++k) gap.push_back(draw_gap());
            which.resize(static_cast<std::size_t>(wanted));
            for (int round = 0; round < 30 && wanted > 0; ++round) { // Gauss-Newton, the shortest way
                Eigen::MatrixXd J(wanted, 3);
                Eigen::VectorXd miss(wanted);
                for (int k = 0; k < wanted; ++k) {
                    const auto [normal, distance] = nearest(which[static_cast<std::size_t>(k)], x, r, walls);
                    J.row(k) = normal.transpose();
                    miss[k] = distance - gap[static_cast<std::size_t>(k)];
                }
                Vec3 move = -J.completeOrthogonalDecomposition().solve(miss);
                if (move.norm() > r) move *= r / move.norm();
                x += move;
            }
            bool fits = true;
            for (std::size_t k = 0; k < objects; ++k) {
                const double distance = nearest(k, x, r, walls).second;
                const auto asked = std::ranges::find(which, k);
                if (asked == which.end())
                    fits = fits && distance > -allowed_overlap * d_min_;
                else
                    fits = fits && std::abs(distance - gap[static_cast<std::size_t>(asked - which.begin())]) < 1e-9 * r;
            }
            if ((x - middle_).norm() > 6 * d_max_ || !fits) continue;
            add(own, x);
            return;
        }
    }

    void place_anywhere(std::size_t own) { add(own, middle_); }

    /// Some stand on each other above the floor, perhaps leaning: beads between it and a heavier one.
    void stack()
    {
        const auto walls = world_.placed_walls();
        const Vec3 axis =
            draw_.chance(0.6) ? Vec3::UnitZ() : Vec3((Vec3::UnitZ() + 0.2 * draw_.direction()).normalized());
        const auto count =
            static_cast<std::size_t>(draw_.integer(1, static_cast<int>(std::min<std::size_t>(4, radius_.size()))));
        Vec3 x = middle_;
        for (int round = 0; round < 50; ++round) {
            double least = infinity;
            for (std::size_t w = 0; w < walls.size(); ++w)
                least = std::min(least, nearest(w, x, radius_[0], walls).second);
            x.z() -= least;
        }
        x.z() += draw_gap();
        for (std::size_t k = 0; k < count; ++k) {
            if (k > 0) x += (radius_[k - 1] + radius_[k] + draw_gap()) * axis;
            add(k, x);
        }
    }

    void add(std::size_t own, const Vec3& x)
    {
        const double r = radius_[own];
        world_.add_sphere(x, Vec3::Zero(), Vec3::Zero(), r, mass_[own] / (4.0 / 3.0 * std::numbers::pi * r * r * r));
    }

    /// As if all spheres had been placed: those that found no room do not change the step.
    void set_diameters()
    {
        world_.model.min_diameter = d_min_;
        world_.model.max_diameter = d_max_;
    }

    void place_piston()
    {
        const State& state = world_.state;
        const Vec3 axis = tilted(Vec3::UnitZ());
        std::size_t top = 0;
        const auto height = [&](std::size_t i) { return axis.dot(state.position[i]) + state.radius[i]; };
        for (std::size_t i = 1; i < state.count(); ++i)
            if (height(i) > height(top)) top = i;
        const double radius = d_max_ * draw_.one_of({0.5, 1.0, 4.0});
        const Vec3 center = state.position[top] + (state.radius[top] + draw_gap()) * axis +
                            0.3 * radius * draw_.uniform(0, 1) * any_perpendicular(axis);
        double least = infinity, most = 0.0;
        for (std::size_t i = 0; i < state.count(); ++i) {
            least = std::min(least, state.mass(i));
            most = std::max(most, state.mass(i));
        }
        const double mass = std::min(draw_.log_uniform(0.3, 30) * most, 1000 * least);
        const double load = draw_.one_of({0.0, draw_.log_uniform(0.1, 30) * mass * standard_gravity});
        const Disk plate{center, axis, radius, 0.0};
        const std::size_t index =
            load == 0.0 ? world_.add_piston(plate, mass, -axis) : world_.add_piston(plate, mass, -axis, {{0.0, load}});
        const double speed = draw_.one_of({0.0, draw_.uniform(-0.1, 0.1), draw_.uniform(0, 0.01)}) * d_min_ / h_;
        world_.state.pistons[index].velocity = -speed * axis;
        tell("wall ", world_.model.walls.size() - 1, ": piston, a round plate of radius ", radius / d_min_, " d round ",
            told(center, d_min_), " d, guide ", told(-axis), ", ", mass, " kg, load ", load,
            " N, moves along the guide with ", speed, " m/s");
    }

    void draw_velocities()
    {
        State& state = world_.state;
        const double g = world_.model.gravity.norm(), fast = 0.18 * d_min_ / h_;
        const double mood = draw_.uniform(0, 1);
        const auto near = touches(world_, h_, 0.5 * d_min_);
        for (std::size_t i = 0; i < state.count(); ++i) {
            if (mood < 0.15 || draw_.chance(0.25)) continue; // at rest
            const bool gentle = mood < 0.4 && g > 0.0;
            double speed = gentle ? 3 * h_ * g * std::pow(10.0, draw_.uniform(-1, 1)) : fast * draw_.uniform(0, 1);
            Vec3 along = draw_.direction();
            std::vector<Touch> own;
            for (const Touch& touch : near)
                if (touch.a == i || (!touch.with_wall && touch.b == i)) own.push_back(touch);
            if (!own.empty() && draw_.chance(0.6)) { // at one of its neighbours, or away from it
                const Touch& aim = own[static_cast<std::size_t>(draw_.integer(0, static_cast<int>(own.size()) - 1))];
                along = (aim.a == i ? -1.0 : 1.0) * aim.normal;
                if (draw_.chance(0.2)) along = -along;
                if (aim.gap > 1e-3 * d_min_ && draw_.chance(0.7)) speed = aim.gap / h_ * draw_.uniform(0.3, 2);
            }
            state.body(i).velocity = std::min(speed, fast) * along;
            if (world_.model.physics.spin && draw_.chance(0.5))
                state.body(i).rim_velocity = fast * draw_.uniform(0, 1) * draw_.direction();
        }
    }

    Box contents()
    {
        Box box;
        for (const Vec3& x : world_.state.position) box.extend(x);
        return box.grown(d_max_ * draw_.uniform(1, 5)).shifted(0.8 * d_max_ * draw_.in_cube());
    }
};

} // namespace

double RandomWorld::mass_ratio() const
{
    double least = infinity, most = 0.0;
    const auto note = [&](double mass) {
        least = std::min(least, mass);
        most = std::max(most, mass);
    };
    for (std::size_t i = 0; i < world.state.count(); ++i) note(world.state.mass(i));
    for (const Piston& piston : world.model.pistons) note(piston.mass);
    return most / least;
}

bool RandomWorld::has_moving_walls() const
{
    return std::ranges::any_of(world.model.walls, [](const Wall& wall) { return !wall.motion.empty(); });
}

RandomWorld draw_world(std::uint64_t seed, const Wish& wish)
{
    return Maker(seed, wish).make();
}

StepLength part_of_step(const Model& model, int parts)
{
    return {model.time_step, parts};
}

StepReport make_part(World& world, int parts)
{
    return *advance_once(part_of_step(world.model, parts), true, world.state, world.network, world.model, {});
}

void end_step(World& world, int parts)
{
    if (parts > 1) world.state.time = static_cast<double>(++world.state.steps) * world.model.time_step;
}

bool warm_up(RandomWorld& own, int sweeps)
{
    World& world = own.world;
    const SolverSettings solver = world.model.solver;
    if (sweeps == 0) {
        world.model.solver.tolerance = own.warm_up_tolerance;
        world.model.solver.max_sweeps = warm_up_sweeps;
    } else {
        world.model.solver.tolerance = -1.0;
        world.model.solver.max_sweeps = sweeps;
    }
    bool room = true;
    for (std::size_t step = 0; step + 1 < own.parts.size(); ++step) {
        const int parts = own.parts[step];
        for (int part = 0; part < parts; ++part) {
            room = room && has_room(world, world.model.time_step / parts);
            world.report = make_part(world, parts);
        }
        end_step(world, parts);
    }
    world.model.solver = solver;
    return room && has_room(world, world.model.time_step / own.parts.back());
}

double largest_velocity(const World& world)
{
    const Model& model = world.model;
    const double h = model.time_step;
    double largest = std::max(h * model.gravity.norm(), 1e-3 * model.min_diameter / h);
    for (const Body& m : world.state.bodies) largest = std::max({largest, m.velocity.norm(), m.rim_velocity.norm()});
    for (const PistonState& piston : world.state.pistons) largest = std::max(largest, piston.velocity.norm());
    for (const Touch& touch : touches(world, h, model.min_diameter))
        largest = std::max(largest, touch.wall_velocity.norm());
    return largest;
}

std::string contact_table(const World& world, int parts)
{
    World copy = world;
    const double d = copy.model.min_diameter, h = copy.model.time_step;
    const PreparedStep prepared = prepare_step(copy.state, copy.network, copy.model, part_of_step(copy.model, parts));
    std::ostringstream text;
    text.precision(6);
    for_each_contact(copy.network, [&](const TileContacts& contacts, std::size_t k, bool with_wall) {
        const Contact c = contacts.contact(k);
        Vec3 u = copy.state.body(c.a).velocity;
        if (with_wall && contacts.has_moving_walls()) u -= contacts.wall(k).velocity;
        if (!with_wall) u -= copy.state.body(c.b).velocity;
        text << "    " << copy.state.id[c.a] << (with_wall ? " at wall " : " on ")
             << (with_wall ? c.b : static_cast<std::int32_t>(copy.state.id[c.b])) << ": kind "
             << static_cast<int>(c.kind) << ", gap " << c.gap / d << " d, kappa " << c.compression / d << " d, u_n "
             << u.dot(c.normal) << " m/s (" << u.dot(c.normal) * h / d << " d/h), carries "
             << c.impulse.dot(c.normal) * c.inverse_mass_sum << " m/s W, q " << c.target << ", Sigma/W "
             << c.compliance / c.inverse_mass_sum << '\n';
    });
    return text.str();
}

std::string picture(const RandomWorld& own)
{
    const World& world = own.world;
    const double d = world.model.min_diameter, h = world.model.time_step;
    std::ostringstream text;
    text.precision(6);
    text << "world " << own.seed << ":\n";
    for (const std::string& one : own.told) text << "  " << one << '\n';
    text << "  after " << own.parts.size() - 1 << " steps, of " << own.parts.front() << ".." << own.parts.back()
         << " parts (in d_min, d_min/h, the lightest mass):\n";
    double least = infinity;
    for (std::size_t i = 0; i < world.state.count(); ++i) least = std::min(least, world.state.mass(i));
    for (std::size_t i = 0; i < world.state.count(); ++i)
        text << "  sphere " << world.state.id[i] << ": r " << world.state.radius[i] / d << ", m "
             << world.state.mass(i) / least << ", x " << told(world.state.position[i], d) << ", v "
             << told(world.state.body(i).velocity, d / h)
             << (world.model.physics.spin ? ", rim " + told(world.state.body(i).rim_velocity, d / h) : "") << '\n';
    for (std::size_t k = 0; k < world.state.pistons.size(); ++k)
        text << "  piston: v " << told(world.state.pistons[k].velocity, d / h) << ", m "
             << world.model.pistons[k].mass / least << '\n';
    text << "  contacts of the step:\n" << contact_table(world, own.parts.back());
    return text.str();
}

bool is_finite(const World& world)
{
    return std::ranges::all_of(world.state.position, [](const Vec3& x) { return x.allFinite(); }) &&
           std::ranges::all_of(
               world.state.bodies, [](const Body& m) { return m.velocity.allFinite() && m.rim_velocity.allFinite(); });
}

} // namespace talus::test
