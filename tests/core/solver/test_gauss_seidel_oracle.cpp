// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/region.hpp"
#include "core/candidates/candidate_search.hpp"
#include "core/contacts/assembly.hpp"
#include "core/solver/gauss_seidel.hpp"
#include "tests/support/contacts.hpp"
#include "tests/support/dense_gauss_seidel.hpp"
#include "tests/support/world.hpp"

namespace talus::test
{
namespace
{

bool has_kind(const ContactNetwork& network, ContactKind kind)
{
    bool found = false;
    for_each_contact(
        network, [&](const TileContacts& contacts, std::size_t k, bool) { found = found || contacts.kind(k) == kind; });
    return found;
}

/// The beginning of the next step, as `advance` does it: contacts, and velocities with gravity.
void begin(World& world)
{
    world.update_candidates();
    assemble_contacts(world.network, world.state, world.model, {world.model.time_step}, world.placed_walls());
    for (Body& motion : world.state.bodies) motion.velocity += world.model.time_step * world.model.gravity;
}

/// Whether the next step begins with enough of all that there is to compare.
bool is_worth_comparing(World world)
{
    begin(world);
    std::size_t contacts = 0;
    for_each_contact(world.network, [&](const TileContacts&, std::size_t, bool) { ++contacts; });
    return contacts > 15 && has_kind(world.network, ContactKind::open) && has_kind(world.network, ContactKind::resting);
}

/// A small heap in a box in the middle of its collapse: sizes 1 : 3, resting and open contacts with spheres and walls,
/// impulses carried from the steps before.
World collapsing_heap(
    const ContactLaw& law, const SolverSettings& solver, const WallMotion& motion = {}, bool spin = true)
{
    World world = make_world(law, solver, 5e-4);
    world.model.physics.spin = world.model.physics.spin && spin;
    const double edge = 8 * standard_radius;
    world.add_wall(box_panels({Vec3::Zero(), Vec3(edge, edge, 8 * edge)}, {"z+"}), motion);
    Random random(11);
    const auto anywhere = [&](double size) {
        const double x = uniform(random);
        const double y = uniform(random);
        return Vec3(size * x, size * y, size * uniform(random));
    };
    for (int k = 0; k < 54; ++k) {
        const Vec3 place(k % 3 + 0.35, k / 3 % 3 + 0.35, k / 9 + 0.35);
        const double radius = standard_radius * (0.4 + 0.8 * uniform(random));
        world.add_sphere(edge / 3 * place + anywhere(0.3 * edge / 3), anywhere(0.5),
            spin ? anywhere(100.0) : Vec3::Zero().eval(), radius);
    }
    world.step(300);
    advance_until(world, is_worth_comparing, 200);
    world.add_sphere(
        Vec3(standard_radius + 1e-4, 0.5 * edge, 4 * edge), Vec3(-2, 1, 0)); // hits a wall in the next step
    return world;
}

Vec3 rolling_impulse(const TileContacts& contacts, std::size_t k)
{
    return contacts.has_rolling() ? contacts.rolling_impulse(k) : Vec3::Zero().eval();
}

/// What the assembled contacts are in the words of the note; masses the oracle works out by itself.
std::vector<DenseContact> dense_contacts(const ContactNetwork& network)
{
    std::vector<DenseContact> all;
    for_each_contact(network, [&](const TileContacts& contacts, std::size_t k, bool with_wall) {
        const Contact contact = contacts.contact(k);
        DenseContact dense;
        dense.a = static_cast<std::size_t>(contact.a);
        dense.b = with_wall ? 0 : static_cast<std::size_t>(contact.b);
        dense.with_wall = with_wall;
        if (&contacts == &network.contacts.pistons) {
            dense.piston = 0;
            dense.piston_arm = network.contacts.piston_arms[k];
        }
        if (with_wall && contacts.has_moving_walls()) {
            dense.wall_velocity = contacts.wall(k).velocity;
            dense.wall_spin = contacts.wall(k).spin;
        }
        dense.normal = contact.normal;
        dense.target = contact.target;
        dense.compliance = contact.compliance;
        dense.friction = contact.friction;
        dense.rolling_reach = contacts.has_rolling() ? contacts.rolling(k).reach : 0.0;
        dense.impulse = contact.impulse;
        dense.rolling_impulse = rolling_impulse(contacts, k);
        all.push_back(dense);
    });
    return all;
}

/// The oracle knows no parting speed (test_packed_sweep.cpp has that of the kernel): none may have one.
void let_part(ContactNetwork& network)
{
    const auto change = [](TileContacts& contacts) {
        for (const std::size_t k : contacts.indices()) contacts.pack(k / pack_size).parting[k % pack_size] = infinity;
    };
    for (TileContacts& contacts : network.contacts.spheres) change(contacts);
    for (TileContacts& contacts : network.contacts.walls) change(contacts);
    change(network.contacts.pistons);
}

/// Lever arms of contacts that are laid where paths meet, in the rows of the oracle, which has them where spheres are.
void lay_arms(DenseProblem& dense, const ContactNetwork& network, const State& state)
{
    Eigen::Index row = 0;
    for_each_contact(network, [&](const TileContacts& contacts, std::size_t slot, bool with_wall) {
        const std::int32_t a = contacts.a(slot), b = contacts.b(slot);
        if (!with_wall) {
            const double radii = state.radius[a] + state.radius[b];
            const double longer =
                contacts.contact(slot).arm_scale * radii / (state.position[a] - state.position[b]).norm();
            for (const std::int32_t sphere : {a, b}) dense.jacobian.block<3, 3>(row, 6 * sphere + 3) *= longer;
        }
        row += DenseProblem::rows;
    });
}

/// Largest differences of kernel and oracle, relative to the largest impulse and speed.
struct Difference {
    double impulse = 0.0, rolling_impulse = 0.0, velocity = 0.0, spin = 0.0;
};

Difference compare(const ContactNetwork& network, const State& state, const DenseProblem& dense)
{
    Difference worst;
    std::size_t k = 0;
    for_each_contact(network, [&](const TileContacts& contacts, std::size_t slot, bool) {
        worst.impulse = std::max(worst.impulse, (contacts.impulse(slot) - dense.impulse_in_space(k)).norm());
        worst.rolling_impulse = std::max(
            worst.rolling_impulse, (rolling_impulse(contacts, slot) - dense.rolling_impulse_in_space(k)).norm());
        ++k;
    });
    double fastest = 0.0;
    for (std::size_t i = 0; i < state.count(); ++i) {
        const auto own = dense.velocity.segment<6>(6 * static_cast<Eigen::Index>(i));
        worst.velocity = std::max(worst.velocity, (state.body(i).velocity - own.head<3>()).norm());
        worst.spin = std::max(worst.spin, (state.body(i).rim_velocity - state.radius[i] * own.tail<3>()).norm());
        fastest = std::max({fastest, own.head<3>().norm(), state.radius[i] * own.tail<3>().norm()});
    }
    const double largest = dense.impulse.lpNorm<Eigen::Infinity>();
    worst.impulse /= largest;
    worst.rolling_impulse /= largest * standard_radius;
    worst.velocity /= fastest;
    worst.spin /= fastest;
    return worst;
}

/// From the impulses of the last step on.
SolveReport solve_begun(World& world, const SolverSettings& solver)
{
    PistonGroup pistons(world.network, world.state, world.model, world.model.time_step);
    apply_warm_start(world.network, pistons, world.state.bodies, world.model.physics);
    const auto report = solve_contacts(world.network, pistons, world.state.bodies, world.model.physics, solver);
    pistons.store(world.network, world.state);
    return report;
}

/// Solves the next step of this world both ways.
void check_against_oracle(World& world, int sweeps);

ContactLaw contact_law(double friction, double rolling_friction, double restitution)
{
    ContactLaw law;
    law.friction = friction;
    law.rolling_friction = rolling_friction;
    law.restitution = restitution;
    return law;
}

} // namespace

TEST_CASE(
    "the sphere kernel gives the impulses and velocities of a plain dense Algorithm 3.1", "[gauss_seidel][oracle]")
{
    // Same contacts, same order, same number of sweeps: two ways of writing one iteration differ by round-off, which a
    // few sweeps of some dozen contacts leave far below 1e-10.
    const auto law =
        GENERATE(contact_law(0, 0, 0), contact_law(0.4, 0, 0), contact_law(0.4, 0, 0.5), contact_law(0.6, 0.1, 0.3));
    const auto stabilisation = GENERATE(Stabilisation::matched, Stabilisation::projected);
    const int sweeps = GENERATE(1, 2, 9);
    World world = collapsing_heap(law, production_settings(stabilisation));
    check_against_oracle(world, sweeps);
}

TEST_CASE("at moving walls, and without spin, the kernel gives those of Algorithm 3.1 too", "[gauss_seidel][oracle]")
{
    // The box turns slowly and shakes: walls with a velocity of their own everywhere, and a spin.
    const Vec3 middle = Vec3(4, 4, 0) * standard_radius;
    const WallMotion motion = {
        Turning{{}, middle, Vec3(0.36, 0.48, 0.8), 0.8}, Shaking{{}, Vec3(0.0004, 0, 0.0003), 40.0}};
    const auto stabilisation = GENERATE(Stabilisation::matched, Stabilisation::projected);
    const int sweeps = GENERATE(1, 2, 9);
    SECTION("walls that move, rolling resistance")
    {
        World world = collapsing_heap(contact_law(0.6, 0.1, 0.3), production_settings(stabilisation), motion);
        check_against_oracle(world, sweeps);
    }
    SECTION("walls that move, no friction")
    {
        World world = collapsing_heap(contact_law(0, 0, 0.3), production_settings(stabilisation), motion);
        check_against_oracle(world, sweeps);
    }
    SECTION("no spin")
    {
        World world = collapsing_heap(contact_law(0.4, 0, 0.3), production_settings(stabilisation), {}, false);
        check_against_oracle(world, sweeps);
        for (const Body& m : world.state.bodies) CHECK(m.rim_velocity == Vec3::Zero());
    }
    SECTION("walls that move, no spin")
    {
        World world = collapsing_heap(contact_law(0.4, 0, 0), production_settings(stabilisation), motion, false);
        check_against_oracle(world, sweeps);
    }
}

TEST_CASE("with a piston, whose contacts have coupled blocks, sweeps are those of Algorithm 3.1 too",
    "[gauss_seidel][oracle][piston]")
{
    // A plate that comes down on the heap beside its own middle, along a guide that is not level, so that its contacts
    // would turn it.
    const auto law = GENERATE(contact_law(0, 0, 0), contact_law(0.4, 0, 0.3), contact_law(0.6, 0.1, 0.3));
    const auto stabilisation = GENERATE(Stabilisation::matched, Stabilisation::projected);
    const int sweeps = GENERATE(1, 2, 9);
    World world = collapsing_heap(law, production_settings(stabilisation));
    const Disk plate{Vec3(5, 4, 6.5) * standard_radius, Vec3::UnitZ(), 3.0 * standard_radius, 0.0};
    world.add_piston(plate, 0.02, Vec3(0.1, 0.05, -1), {{0.0, 2.0}});
    ContactNetwork unlisted; // there is one more wall to search for
    std::swap(world.network, unlisted);
    world.step(200);
    const auto bears_next = [](World copy) {
        if (!is_worth_comparing(copy)) return false;
        begin(copy);
        return copy.network.contacts.pistons.count() >= 2;
    };
    advance_until(world, bears_next, 2000);
    world.add_sphere(Vec3(standard_radius + 1e-4, 4 * standard_radius, 30 * standard_radius), Vec3(-2, 1, 0));
    check_against_oracle(world, sweeps);
    CHECK(world.network.contacts.pistons.count() >= 2);
}

TEST_CASE("relaxed sweeps are those of Algorithm 3.1 with the note's scaled d", "[gauss_seidel][oracle]")
{
    const auto law = GENERATE(contact_law(0, 0, 0), contact_law(0.4, 0, 0.5), contact_law(0.6, 0.1, 0.3));
    const auto stabilisation = GENERATE(Stabilisation::matched, Stabilisation::projected);
    const double relaxation = GENERATE(0.7, 1.4);
    World world = collapsing_heap(law, production_settings(stabilisation));
    world.model.solver.relaxation = relaxation;
    check_against_oracle(world, 9);
}

TEST_CASE("a relaxed solve has the velocities of an ordinary one, in fewer sweeps", "[gauss_seidel]")
{
    // Without friction the velocities are unique.
    const auto stabilisation = GENERATE(Stabilisation::matched, Stabilisation::projected);
    const World start = collapsing_heap(contact_law(0, 0, 0), production_settings(stabilisation));
    const auto solve = [&](World& world, double relaxation) {
        SolverSettings solver = world.model.solver;
        solver.tolerance = 1e-11;
        solver.max_sweeps = 100000;
        solver.relaxation = relaxation;
        begin(world);
        return solve_begun(world, solver);
    };
    World ordinary = start, relaxed = start;
    const int ordinary_sweeps = solve(ordinary, 1.0).sweeps, relaxed_sweeps = solve(relaxed, 1.4).sweeps;
    CHECK(relaxed_sweeps < 0.7 * ordinary_sweeps);
    double worst = 0.0, fastest = 0.0;
    for (std::size_t i = 0; i < start.state.count(); ++i) {
        const Vec3 v = ordinary.state.body(i).velocity;
        fastest = std::max(fastest, v.norm());
        worst = std::max(worst, (v - relaxed.state.body(i).velocity).norm());
    }
    CHECK(worst < 1e-8 * fastest);
}

namespace
{

void check_against_oracle(World& world, int sweeps)
{
    const Model& model = world.model;
    for (int k = 0; k == 0 || (k < 100 && !has_kind(world.network, ContactKind::impact)); ++k) {
        if (k > 0) world.step();
        begin(world);
    }
    let_part(world.network);
    const auto contacts = dense_contacts(world.network);
    REQUIRE(contacts.size() > 15);
    REQUIRE(has_kind(world.network, ContactKind::open));
    REQUIRE(has_kind(world.network, ContactKind::resting));
    REQUIRE(has_kind(world.network, ContactKind::impact));

    // Without friction no row has spin either.
    auto dense = make_dense_problem(world.state, contacts, model.physics.spin);
    lay_arms(dense, world.network, world.state);
    if (model.physics.pistons) add_pistons(dense, world.state, model, contacts);
    REQUIRE(dense.impulse.norm() > 0);
    warm_start(dense);
    const bool has_soft_modes = !model.physics.friction && model.solver.stabilisation == Stabilisation::matched;
    for (int k = 0; k < sweeps; ++k) {
        const bool is_relaxed = k >= model.solver.min_sweeps || (has_soft_modes && k + 1 < model.solver.min_sweeps);
        sweep(dense, is_relaxed ? model.solver.relaxation : 1.0);
    }

    SolverSettings solver = model.solver;
    solver.max_sweeps = sweeps;
    solver.tolerance = 0.0;
    const auto report = solve_begun(world, solver);

    const auto difference = compare(world.network, world.state, dense);
    CHECK(difference.impulse < 1e-10);
    CHECK(difference.rolling_impulse < 1e-10);
    CHECK(difference.velocity < 1e-10);
    CHECK(difference.spin < 1e-10);
    CHECK(report.sweeps == sweeps);
    // With a piston ε is a natural map of coupled blocks, which is not the correction of a sequential local solve.
    if (!model.physics.pistons) CHECK(report.residual == within(1e-9, residual(dense)).margin(1e-14));
    for (std::size_t k = 0; k < world.state.pistons.size(); ++k) {
        const auto own = dense.velocity.segment<6>(6 * static_cast<Eigen::Index>(world.state.count() + k));
        const double speed = world.state.pistons[k].velocity.norm();
        const double fastest = std::max(speed, standard_gravity * model.time_step); // it may have been brought to rest
        CHECK((world.state.pistons[k].velocity - own.head<3>()).norm() <= 1e-10 * fastest);
        CHECK(world.state.pistons[k].spin.norm() * standard_radius < 1e-12 * fastest);
    }
}

} // namespace

} // namespace talus::test
