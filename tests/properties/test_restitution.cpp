// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/properties/as_a_scene.hpp"
#include "tests/properties/draws.hpp"
#include "tests/properties/event_driven.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

// Restitution e means that what meets parts with e times its speed. All worlds have the settings that a scene gets
// which asks for nothing.

namespace talus::test
{
namespace
{

constexpr double d = 2 * standard_radius;

Stabilisation any_law(Draw& draw)
{
    return draw.chance(0.5) ? Stabilisation::matched : Stabilisation::projected;
}

double any_restitution(Draw& draw)
{
    return draw.chance(0.2) ? 0.0 : draw.chance(0.2) ? 1.0 : draw.uniform(0, 1);
}

const char* name(Stabilisation law)
{
    return law == Stabilisation::matched ? "matched" : "projected";
}

std::string in_words(const Vec3& v)
{
    return text("(%.9g, %.9g, %.9g)", v.x(), v.y(), v.z());
}

// --- Pairs -----------------------------------------------------------------------------------------------------------

/// Two smooth spheres of any masses and sizes meet in flight, at any angle.
Fault pair_in_flight(Draw& draw)
{
    const Stabilisation law = any_law(draw);
    const double e = any_restitution(draw), ratio = draw.log_uniform(1e-3, 1e3), speed = draw.log_uniform(0.1, 10);
    const double size = draw.chance(0.5) ? std::cbrt(ratio) : draw.log_uniform(0.2, 5);
    const bool gravity = draw.chance(0.5);
    const double radius[] = {standard_radius, standard_radius * size};
    const double density[] = {standard_density, standard_density * ratio / std::pow(size, 3)};

    // They touch at the instant t with this normal and velocity; before and after it they fly.
    const Vec3 n = draw.direction(), drift = draw.uniform(0, 1) * speed * draw.direction();
    Vec3 u = speed * draw.direction();
    if (u.dot(n) > 0.0) u = -u;
    World world = empty_world({.restitution = e}, gravity);
    const Vec3 g = world.model.gravity;
    const Vec3 xa = (radius[0] + radius[1]) * n;
    world.add_sphere(xa, u + drift, Vec3::Zero(), radius[0], density[0]);
    world.add_sphere(Vec3::Zero(), drift, Vec3::Zero(), radius[1], density[1]);
    set_as_a_scene(world, law);
    const double h = world.model.time_step, t = h * draw.uniform(1, 4);
    if (-u.dot(n) < 6.0 * h * g.norm()) return {}; // slower ones do not rebound
    for (Body& m : world.state.bodies) {
        const std::size_t i = static_cast<std::size_t>(&m - world.state.bodies.data());
        world.state.position[i] -= t * m.velocity + 0.5 * t * t * g;
    }
    world.step(8);

    const double ma = world.mass(0), mb = world.mass(1);
    const Vec3 impulse = -(1 + e) * u.dot(n) / (1 / ma + 1 / mb) * n, fall = 8 * h * g;
    const Vec3 a = u + drift + impulse / ma + fall, b = drift - impulse / mb + fall;
    const double error = std::max((world.velocity(0) - a).norm(), (world.velocity(1) - b).norm()) / speed;
    if (error < 1e-9) return {};
    return text("two spheres meet in flight, %s, e %.3g, masses 1 : %.4g, radii 1 : %.4g, gravity %d, step %.3g s\n"
                "  they meet with %.4g m/s, %.4g m/s of it along the normal, after %.3g steps; error %.2g of the speed",
               name(law), e, ratio, size, gravity, h, speed, -u.dot(n), t / h, error) +
           "\n  first " + in_words(world.velocity(0)) + " for " + in_words(a) + ", second " +
           in_words(world.velocity(1)) + " for " + in_words(b);
}

/// A sphere meets a plane, which may lie at any angle.
Fault sphere_and_wall(Draw& draw)
{
    const Stabilisation law = any_law(draw);
    const double e = any_restitution(draw), speed = draw.log_uniform(0.1, 10);
    const bool gravity = draw.chance(0.5);
    const Vec3 n = draw.direction();
    Vec3 v = speed * draw.direction();
    if (v.dot(n) > 0.0) v = -v;
    World world = empty_world({.restitution = e}, gravity);
    const Vec3 g = world.model.gravity;
    world.add_plane(Vec3::Zero(), n);
    world.add_sphere(Vec3::Zero(), v);
    set_as_a_scene(world, law);
    const double h = world.model.time_step, t = h * draw.uniform(1, 4);
    if (-v.dot(n) < 12.0 * h * g.norm()) return {};
    world.state.position[0] = standard_radius * n - t * v;
    int steps = 0;
    Vec3 before = v;
    for (; steps < 8 && world.velocity().dot(n) < -1e-3 * speed * std::abs(v.dot(n)) / speed; ++steps) {
        before = world.velocity();
        world.step();
    }
    const Vec3 tangential = before - before.dot(n) * n + h * (g - g.dot(n) * n);
    const double normal = -e * before.dot(n);
    const double error = (world.velocity() - tangential - normal * n).norm() / speed;
    // With e = 0 it ends on the wall, which the blow may be a step before it is.
    if (error < 1e-9) return {};
    return text(
        "a sphere meets a plane, %s, e %.3g, gravity %d, step %.3g s: %.4g m/s, %.4g m/s of it along the normal, "
        "after %.3g steps; parts with %.9g m/s for %.9g m/s, error %.2g of the speed",
        name(law), e, gravity, h, speed, -before.dot(n), t / h, world.velocity().dot(n), normal, error);
}

// --- Rows ------------------------------------------------------------------------------------------------------------

/// A cradle of elastic equal spheres, of which some meet the rest. Velocities are exchanged from sphere to sphere, so
/// in the end they stand in order: as many fly on as came.
Fault cradle(Draw& draw)
{
    const Stabilisation law = any_law(draw);
    const int n = draw.integer(2, 7), moving = draw.integer(1, std::min(3, n - 1));
    const double speed = draw.log_uniform(0.2, 5);
    const bool floor = draw.chance(0.5);
    const int kind = draw.integer(0, floor ? 2 : 1);                        // touching, apart, squeezed
    const double squeeze = kind == 2 ? draw.log_uniform(1e-15, 1e-3) : 0.0; // of a weight
    World world = empty_world({.restitution = 1.0}, floor);
    if (floor) world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    double x = 0.0, widest = 0.0;
    for (int k = 0; k < n; ++k) {
        world.add_sphere(Vec3(x, 0, standard_radius), k < moving ? Vec3(speed, 0, 0) : Vec3::Zero());
        const double gap = kind == 1 ? draw.log_uniform(1e-12, 0.05) * d : 0.0;
        widest = std::max(widest, gap);
        x += d + (k == moving - 1 ? draw.uniform(0.1, 0.6) * d : gap);
    }
    set_as_a_scene(world, law, speed);
    const double weight = world.mass() * standard_gravity;
    if (squeeze > 0.0) {
        world.state.own_force.assign(static_cast<std::size_t>(n), Vec3::Zero());
        world.state.own_force[static_cast<std::size_t>(moving)] = squeeze * weight * Vec3::UnitX();
        world.state.own_force[static_cast<std::size_t>(n - 1)] -= squeeze * weight * Vec3::UnitX();
    }
    const double length = d + (n + 2) * widest + 0.5 * d;
    const int steps = static_cast<int>(length / (speed * world.model.time_step)) + 4 * n;
    world.step(steps);
    const double time = steps * world.model.time_step;
    // Impacts that come in one step are solved to the tolerance, 1e-2; and what squeezes goes on to push.
    const double tolerance = 2e-2 + 2.0 * squeeze * standard_gravity * time / speed;
    double error = 0.0;
    std::string speeds;
    for (int k = 0; k < n; ++k) {
        error = std::max(error, (world.velocity(k) - Vec3(k >= n - moving ? speed : 0.0, 0, 0)).norm() / speed);
        speeds += text(" %.4g", world.velocity(k).x() / speed);
    }
    if (error < tolerance) return {};
    return text("a cradle of %d, %s, %d of it come with %.4g m/s, %s, step %.3g s: %s; error %.2g of the speed\n"
                "  velocities in the end, of that speed:",
               n, name(law), moving, speed, floor ? "on a floor" : "without gravity", world.model.time_step,
               kind == 0   ? "the others touch"
               : kind == 1 ? text("gaps up to %.3g d", widest / d).c_str()
                           : text("the others touch, squeezed by %.3g of a weight", squeeze).c_str(),
               error) +
           speeds;
}

/// The velocities, along a line upwards, that a column has after impacts of two at a time, where these are few, and
/// none is slow.
/// @param from_below which of them comes first; @return their number, −1 where there is no such sequence
int binary_impacts(std::vector<double>& v, const std::vector<double>& m, double e, double slowest, bool from_below)
{
    const std::size_t n = v.size();
    std::vector<int> met(n);
    for (int count = 0;; ++count) {
        std::size_t next = n; // contact k is below sphere k
        bool slow = false;
        for (std::size_t k = 0; k < n; ++k) {
            const double closing = k == 0 ? -v[0] : v[k - 1] - v[k];
            if (closing > 1e-12 && (next == n || !from_below)) next = k;
            slow = slow || (closing > 1e-12 && closing < slowest);
        }
        if (next == n) return count;
        if (slow || ++met[next] > 2) return -1;
        if (next == 0) {
            v[0] = -e * v[0];
            continue;
        }
        const double impulse = (1 + e) * (v[next - 1] - v[next]) / (1 / m[next - 1] + 1 / m[next]);
        v[next - 1] -= impulse / m[next - 1];
        v[next] += impulse / m[next];
    }
}

/// Spheres on each other fall on a floor: Galileo's cannon.
Fault stacked_drop(Draw& draw)
{
    const Stabilisation law = any_law(draw);
    const bool gravity = draw.chance(0.5);
    for (;;) {
        const int n = draw.integer(2, 4);
        const double e = draw.chance(0.4) ? 1.0 : draw.uniform(0.3, 1), speed = draw.log_uniform(0.5, 3);
        World world = empty_world({.restitution = e}, gravity);
        world.add_plane(Vec3::Zero(), Vec3::UnitZ());
        std::vector<double> m;
        std::string masses;
        double z = 0.0;
        for (int k = 0; k < n; ++k) {
            const double ratio = k == 0 ? 1.0 : draw.log_uniform(1e-3, 1e3);
            const double size = draw.chance(0.5) ? 1.0 : std::cbrt(ratio);
            const double r = standard_radius * size;
            world.add_sphere(
                Vec3(0, 0, z + r), Vec3(0, 0, -speed), Vec3::Zero(), r, standard_density * ratio / std::pow(size, 3));
            z += 2 * r;
            m.push_back(world.mass(k));
            masses += text(" %.4g (radius %.3g)", ratio, size);
        }
        if (*std::ranges::max_element(m) > 1000 * *std::ranges::min_element(m)) continue;
        std::vector<double> expected(m.size(), -speed), reversed = expected;
        const double slowest = 0.1 * speed;
        const int impacts = binary_impacts(expected, m, e, slowest, true);
        if (impacts < 0 || binary_impacts(reversed, m, e, slowest, false) < 0) continue;
        double dependence = 0.0;
        for (std::size_t k = 0; k < m.size(); ++k)
            dependence = std::max(dependence, std::abs(expected[k] - reversed[k]));
        if (dependence > 1e-9 * speed) continue;
        set_as_a_scene(world, law);
        const double h = world.model.time_step;
        const double lift = draw.uniform(0, 2) * speed * h;
        for (Vec3& x : world.state.position) x.z() += lift;
        // Until none approaches the next, but for what gravity does meanwhile.
        int steps = 0;
        const auto goes_on = [&] {
            double below = 0.0;
            const double fallen = gravity ? steps * h * standard_gravity : 0.0;
            for (int k = 0; k < n; ++k) {
                const double v = world.velocity(k).z() + fallen;
                if (v < below - 1e-3 * speed) return true;
                below = v;
            }
            return false;
        };
        while (steps < 10 * impacts + 20 && goes_on()) world.step(), ++steps;
        // Gravity acts in the steps that a sequence takes, and is multiplied as velocities are.
        const double fall = gravity ? steps * h * standard_gravity : 0.0;
        double error = 0.0, fastest = speed;
        std::string found;
        for (int k = 0; k < n; ++k) {
            const double v = world.velocity(k).z() + fall, should = expected[static_cast<std::size_t>(k)];
            fastest = std::max(fastest, std::abs(should));
            error = std::max(error, std::abs(v - should));
            found += text(" %.4g (%.4g)", v / speed, should / speed);
        }
        if (error < 1e-2 * fastest + 2 * fall * fastest / speed) return {};
        return text("%d spheres on each other fall on a floor with %.4g m/s, %s, e %.3g, gravity %d, step %.3g s, %.3g "
                    "steps "
                    "above it\n  masses from below:",
                   n, speed, name(law), e, gravity, h, lift / (speed * h)) +
               masses + "\n  velocities after it, of that speed (impacts one by one):" + found;
    }
}

// --- Drops on beads at rest ------------------------------------------------------------------------------------------

struct Drop {
    Stabilisation law = Stabilisation::matched;
    int beads = 1;      ///< at rest, one on the other
    double ratio = 1.0; ///< mass of what falls, of a bead's
    bool large = false; ///< it is of the beads' density
    double speed = 1.0; ///< with which it arrives [m/s]
    double phase = 0.0; ///< of a step, at which it does
};

Drop any_drop(Draw& draw, int fewest, int most, double greatest_ratio)
{
    Drop drop;
    drop.law = any_law(draw);
    drop.beads = draw.integer(fewest, most);
    drop.ratio = draw.log_uniform(1, greatest_ratio);
    drop.large = draw.chance(0.5);
    drop.speed = draw.log_uniform(0.3, 2);
    drop.phase = draw.uniform(0, 1);
    return drop;
}

std::string in_words(const Drop& drop)
{
    return text("%s, a sphere of mass %.4g (%s) falls with %.4g m/s on %d beads of mass 1 at rest, phase %.4g",
        name(drop.law), drop.ratio, drop.large ? "same density" : "same size", drop.speed, drop.beads, drop.phase);
}

/// The greatest speed upwards of what fell, of that with which it arrived.
double rebound(const Drop& drop, double e)
{
    World world = empty_world({.restitution = e});
    world.add_plane(Vec3::Zero(), Vec3::UnitZ());
    for (int k = 0; k < drop.beads; ++k) world.add_sphere(Vec3(0, 0, (2 * k + 1) * standard_radius));
    const double size = drop.large ? std::cbrt(drop.ratio) : 1.0, r = size * standard_radius;
    const double height = drop.speed * drop.speed / (2 * standard_gravity);
    const std::int64_t id = world.add_sphere(Vec3(0, 0, drop.beads * d + r + height + 2 * d), Vec3::Zero(),
        Vec3::Zero(), r, standard_density * drop.ratio / std::pow(size, 3));
    set_as_a_scene(world, drop.law, drop.speed);
    const double h = world.model.time_step;
    // The beads come to rest while it is still high above them; then it is let go nearer to them.
    world.step(150);
    Body& fast = world.state.body(world.index_of(id));
    Vec3& x = world.state.position[world.index_of(id)];
    fast.velocity = Vec3(0, 0, -drop.speed);
    x.z() = drop.beads * d + r + drop.speed * h * (3.0 + drop.phase);
    world.state.position_rest[world.index_of(id)].setZero();
    double most = 0.0;
    const int steps = static_cast<int>(0.08 / h) + 10;
    for (int k = 0; k < steps; ++k) {
        world.step();
        most = std::max(most, world.velocity(id).z());
    }
    return most / drop.speed;
}

double on_floor_or_bead(double ratio) ///< the most that may come back with e = 0
{
    return ratio <= 100 ? 0.02 : 0.02 + 0.05 * std::log10(ratio / 100);
}

Fault dead_drop_on_one(Draw& draw)
{
    const Drop drop = any_drop(draw, 0, 1, 1000);
    const double back = rebound(drop, 0.0);
    if (back <= on_floor_or_bead(drop.beads > 0 ? drop.ratio : 1.0)) return {};
    return in_words(drop) + text(": e 0, and %.4f of its speed comes back", back);
}

Fault dead_drop_on_column(Draw& draw)
{
    const Drop drop = any_drop(draw, 4, 8, 100);
    const double back = rebound(drop, 0.0);
    if (back <= 0.1) return {};
    return in_words(drop) + text(": e 0, and %.4f of its speed comes back", back);
}

Fault live_drop_on_one(Draw& draw)
{
    const Drop drop = any_drop(draw, 1, 1, 10);
    const double e = draw.uniform(0.05, 1), back = rebound(drop, e);
    if (std::abs(back - e) <= 0.15) return {};
    return in_words(drop) + text(": e %.4g, and %.4f of its speed comes back", e, back);
}

/// Rigid beads, one on the other, bear what is much heavier as one.
Fault live_drop_on_rigid_column(Draw& draw)
{
    Drop drop = any_drop(draw, 1, 6, 100);
    drop.law = Stabilisation::projected;
    drop.ratio = draw.log_uniform(11, drop.beads == 1 ? 1000 : 100);
    const double e = any_restitution(draw), back = rebound(drop, e);
    if (std::abs(back - e) <= 0.15) return {};
    return in_words(drop) + text(": e %.4g, and %.4f of its speed comes back", e, back);
}

/// More comes back where e is greater.
Fault rising(Draw& draw)
{
    const Drop drop = any_drop(draw, 0, draw.chance(0.5) ? 1 : 6, 1000);
    const double restitutions[] = {0, 1e-9, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9};
    double most = 0.0, before = 0.0;
    std::string row;
    for (const double e : restitutions) {
        const double back = rebound(drop, e);
        most = std::max(most, before - back);
        before = std::max(before, back);
        row += text(" %g: %.3f", e, back);
    }
    if (most <= 0.02) return {};
    return in_words(drop) + text(": falls by %.3f where e rises. What comes back, by e:", most) + row;
}

} // namespace

TEST_CASE("two spheres that meet in flight part with e times their speed, whatever their masses", "[restitution][pair]")
{
    for_all_worlds(1.0, pair_in_flight);
}

TEST_CASE("a sphere that meets a plane parts from it with e times its speed", "[restitution][wall]")
{
    for_all_worlds(1.0, sphere_and_wall);
}

TEST_CASE("as many elastic spheres leave a cradle as have come, touching, squeezed, or apart", "[restitution][cradle]")
{
    for_all_worlds(1.0, cradle);
}

TEST_CASE("a stack that falls on a floor is a sequence of binary impacts", "[restitution][stack][!mayfail]")
{
    for_all_worlds(1.0, stacked_drop);
}

TEST_CASE("without restitution next to nothing comes back from a floor, or from a bead on it", "[restitution][dead]")
{
    for_all_worlds(1.0, dead_drop_on_one);
}

TEST_CASE("without restitution little comes back from a column", "[restitution][column]")
{
    for_all_worlds(1.0 / 4, dead_drop_on_column);
}

TEST_CASE("a sphere up to ten times as heavy as the resting bead that it meets comes back with about e times its speed",
    "[restitution][bead]")
{
    for_all_worlds(1.0, live_drop_on_one);
}

TEST_CASE("with rigid contacts what is much heavier comes back from a column with about e times its speed",
    "[restitution][rigid_column]")
{
    for_all_worlds(1.0 / 4, live_drop_on_rigid_column);
}

TEST_CASE("more comes back where the restitution is greater", "[restitution][rising][!mayfail]")
{
    for_all_worlds(1.0 / 8, rising);
}

} // namespace talus::test
