// SPDX-License-Identifier: GPL-3.0-or-later
// The sphere kernel against the note's general layer on steps of the supplied scenes.
#include "core/multibody/algorithm_3_1.hpp"
#include "core/solver/gauss_seidel.hpp"
#include "core/solver/step_problem.hpp"
#include "io/problem/fclib_problem.hpp"
#include "tests/support/contacts.hpp"
#include "tests/validation/run_scene.hpp"

#include <catch2/catch.hpp>

#include <unistd.h>

#include <filesystem>

using namespace talus;
using namespace talus::test;

namespace
{

/// The spheres and pistons after the warm start and so many sweeps of the sphere kernel.
State swept_by_kernel(const Simulation& simulation, int sweeps)
{
    State state = simulation.state;
    auto network = simulation.network;
    const Model& model = simulation.model;
    PistonGroup pistons(network, state, model, model.time_step);
    for (Body& m : state.bodies) m.velocity += model.time_step * model.gravity;
    SolverSettings solver = model.solver;
    solver.tolerance = 0.0;
    solver.max_sweeps = sweeps;
    apply_warm_start(network, pistons, state.bodies, model.physics);
    solve_contacts(network, pistons, state.bodies, model.physics, solver);
    pistons.store(network, state);
    return state;
}

/// As many sweeps of Algorithm 3.1, each as relaxed as the run's.
multibody::SolveSettings as_run(const Model& model, int sweeps)
{
    multibody::SolveSettings settings{.tolerance = 0.0, .max_sweeps = sweeps, .omega = {}};
    for (int sweep = 0; sweep < sweeps; ++sweep)
        settings.omega.push_back(relaxation_of(sweep, model.physics, model.solver));
    return settings;
}

/// The velocities after so many sweeps of Algorithm 3.1 on general blocks.
Eigen::VectorXd swept_by_blocks(const StepProblem& step, const multibody::SolveSettings& settings)
{
    multibody::Iterate x(step.problem, step.warm_impulse);
    solve_projected(x, settings);
    return x.velocity();
}

/// The velocities after so many sweeps on general blocks, of the step as it is read back from a file.
Eigen::VectorXd swept_from_file(const StepProblem& step, const multibody::SolveSettings& settings)
{
    const auto folder = std::filesystem::temp_directory_path();
    const auto path = folder / ("talus_step_" + std::to_string(::getpid()) + ".hdf5");
    write_fclib(to_fclib(step.problem, step.warm_impulse), path);
    const auto file = read_fclib(path);
    std::filesystem::remove(path);
    const auto bodies = with_bodies(file, path);
    multibody::Iterate x(bodies.problem, file.guesses[0].r);
    solve_projected(x, settings);
    return bodies.in_order_of_matrices(x.velocity());
}

/// The largest difference of velocities over the largest speed, and of rim velocities over the largest of these.
double worst_difference(const State& kernel, const StepProblem& step, const Eigen::VectorXd& blocks)
{
    double difference = 0.0, rim_difference = 0.0, speed = 0.0, rim_speed = 0.0;
    const auto compare_velocities = [&](const Vec3& a, const Vec3& b) {
        difference = std::max(difference, (a - b).norm());
        speed = std::max(speed, a.norm());
    };
    for (std::size_t body = 0; body < kernel.count(); ++body) {
        const std::size_t i = step.sphere_of_body[body];
        const auto own = step.problem.dofs_of(body, blocks);
        compare_velocities(kernel.body(i).velocity, own.head<3>());
        if (own.size() == 3) continue;
        rim_difference = std::max(rim_difference, (kernel.body(i).rim_velocity - own.tail<3>()).norm());
        rim_speed = std::max(rim_speed, kernel.body(i).rim_velocity.norm());
    }
    for (std::size_t k = 0; k < kernel.pistons.size(); ++k)
        compare_velocities(kernel.pistons[k].velocity, step.problem.dofs_of(kernel.count() + k, blocks).head<3>());
    return std::max(difference / speed, rim_speed > 0.0 ? rim_difference / rim_speed : 0.0);
}

/// Contacts of a step that are impacts, that have rolling rows, and of twisting, at which the wall moves, with pistons,
/// and that attract.
struct Census {
    int impacts = 0, rolling = 0, twisting = 0, moving = 0, with_pistons = 0, attracting = 0;
};

Census census(const ContactNetwork& network)
{
    Census count;
    for_each_contact(network, [&](const TileContacts& contacts, std::size_t k, bool) {
        count.impacts += contacts.kind(k) == ContactKind::impact;
        count.rolling += contacts.has_rolling() && contacts.rolling(k).reach > 0.0;
        count.twisting += contacts.has_rolling() && contacts.rolling(k).twist_reach > 0.0;
        count.attracting += contacts.attracts(k);
        count.with_pistons += &contacts == &network.contacts.pistons;
        count.moving += contacts.has_moving_walls() && !contacts.wall(k).velocity.isZero(0.0);
    });
    return count;
}

/// Spheres and walls stick to each other, and resist rolling and twisting.
void make_sticky(Model& model)
{
    for (ContactLaw& law : model.materials.laws) law.rolling_friction = law.twisting_friction = 0.1;
    model.attraction_range = 0.05 * model.min_diameter;
    model.materials.attractions.assign(
        model.materials.laws.size(), {.by_weight = 3.0, .range = model.attraction_range});
    model.physics = model.needed_physics();
}

/// Returns what the step had in it.
Census compare(const std::string& scene, double time, bool sticky = false)
{
    CAPTURE(scene, time, sticky);
    auto simulation = open_scene(scene);
    if (sticky) make_sticky(simulation.model);
    run_until(simulation, time);
    prepare_step(simulation);
    if (!simulation.model.pistons.empty()) simulation.model.solver.relaxation = 1.0; // theirs is not relaxed
    const auto step = make_step_problem(simulation.state, simulation.network, simulation.model);
    REQUIRE(step.problem.constraints().size() > 500);
    for (const int sweeps : {1, 2, 20})
        CHECK(worst_difference(swept_by_kernel(simulation, sweeps), step,
                  swept_by_blocks(step, as_run(simulation.model, sweeps))) < 1e-10);
    // Guides of pistons are blocks, and single rows in a file; and what stops springs there is swept after all others.
    const bool may_be_filed = simulation.model.pistons.empty() && !sticky &&
                              std::ranges::none_of(step.problem.constraints(),
                                  [](const multibody::Constraint& contact) { return contact.headroom < 0.0; });
    if (may_be_filed)
        CHECK(worst_difference(
                  swept_by_kernel(simulation, 20), step, swept_from_file(step, as_run(simulation.model, 20))) < 1e-10);
    return census(simulation.network);
}

} // namespace

TEST_CASE("kernel and general layer give the same velocities, sweep by sweep", "[oracle]")
{
    CHECK(compare("hopper", 0.2).impacts > 10); // restitution
    CHECK(compare("pile", 0.8).rolling > 500);
    CHECK(compare("drum", 0.35).moving > 100);
    CHECK(compare("piston", 0.3).with_pistons == 0); // its plate hangs from its guide
}

TEST_CASE("kernel and general layer agree where spheres stick to each other, roll and twist", "[oracle]")
{
    const Census drum = compare("drum", 0.35, true);
    CHECK(std::min({drum.attracting, drum.twisting, drum.moving}) > 100);
}

TEST_CASE("kernel and general layer give the same velocities in full flow", "[oracle][slow]")
{
    compare("hopper", 2.0);
    compare("pile", 2.0);
    compare("drum", 2.0);
    CHECK(compare("piston", 1.6).with_pistons > 50);
    CHECK(compare("piston", 1.6, true).with_pistons > 50);
}
