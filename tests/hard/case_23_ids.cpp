// SPDX-License-Identifier: GPL-3.0-or-later
#include "hard_case.hpp"

#include "tests/support/world.hpp"
#include "tests/validation/run_scene.hpp"

#include "core/base/region.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace talus;
using namespace talus::test;

namespace
{

constexpr double d = 2 * standard_radius;

Vec3 random_vector(Random& random)
{
    return Vec3(uniform(random) - 0.5, uniform(random) - 0.5, uniform(random) - 0.5);
}

/// The scene with its spheres stored, and numbered, in another order.
void shuffle_spheres(Simulation& simulation, std::uint64_t seed)
{
    State& state = simulation.state;
    std::vector<std::int32_t> order(state.count());
    std::iota(order.begin(), order.end(), 0);
    Random random(seed);
    std::shuffle(order.begin(), order.end(), random);
    renumber_spheres(state, order, state.count());
    state.steps = 1; // at step 0 they are sorted along a curve, which would undo it
    std::iota(state.id.begin(), state.id.end(), 0);
}

struct Bed {
    double height, overlap, contacts; ///< twice that of the centre of mass [d]; mean [d]; a sphere
};

Bed settle(const std::vector<std::string>& overrides, std::uint64_t seed)
{
    auto s = open_scene("packing", overrides);
    if (seed) shuffle_spheres(s, seed);
    run_until(s, 0.7);
    const auto report = advance(s);
    double height = 0.0;
    for (const Vec3& x : s.state.position) height += x.z();
    const auto count = static_cast<double>(s.state.count());
    return {2 * height / count / s.model.mean_diameter, report.contacts.mean_overlap() / s.model.mean_diameter,
        static_cast<double>(report.contacts.overlapping) / count};
}

} // namespace

TEST_CASE("23 permuted ids of two spheres", "[hard][quick]")
{
    // Two spheres that meet with any speeds and spins: exchanged, they must end the same but for rounding. A kernel
    // that takes "the first sphere" for something special, or projects on a basis made from ids, would show here.
    HardCase hard("23 permuted ids of two spheres");
    Random random(23);
    for (const auto law : {Stabilisation::matched, Stabilisation::projected}) {
        double position = 0.0, velocity = 0.0, spin = 0.0;
        int met = 0;
        for (int trial = 0; trial < 300; ++trial) {
            const ContactLaw contact{.friction = 2 * uniform(random),
                .restitution = trial % 3 ? uniform(random) : 0.0,
                .rolling_friction = trial % 2 ? 0.1 * uniform(random) : 0.0};
            const double h = automatic_step();
            World worlds[2] = {
                make_world(contact, production_settings(law), h), make_world(contact, production_settings(law), h)};
            const double small = standard_radius * (0.1 + 0.9 * uniform(random));
            const Vec3 towards = random_vector(random).normalized(), drift = random_vector(random);
            const Vec3 spins[2] = {100 * random_vector(random), 100 * random_vector(random)};
            const Vec3 beside = 0.3 * standard_radius * random_vector(random);
            for (int k = 0; k < 2; ++k) {
                World& world = worlds[k];
                world.state.steps = 1; // at step 0 spheres are sorted along a curve, which would undo the exchange
                const auto add_large = [&] { world.add_sphere(Vec3::Zero(), drift, spins[0]); };
                const auto add_small = [&] {
                    world.add_sphere(
                        1.05 * (standard_radius + small) * towards + beside, drift - towards, spins[1], small);
                };
                k ? add_small() : add_large();
                k ? add_large() : add_small();
            }
            bool touch = false;
            for (int k = 0; k < 40; ++k) {
                for (World& world : worlds) world.step();
                for (const ContactForce& force : worlds[0].contact_forces()) touch = touch || force.normal_force > 0;
            }
            met += touch;
            for (int id = 0; id < 2; ++id) {
                position = std::max(position, (worlds[0].position(id) - worlds[1].position(1 - id)).norm() / d);
                velocity = std::max(velocity, (worlds[0].velocity(id) - worlds[1].velocity(1 - id)).norm());
                spin = std::max(spin,
                    standard_radius * (worlds[0].angular_velocity(id) - worlds[1].angular_velocity(1 - id)).norm());
            }
        }
        const std::string name = name_of(law) + ": ";
        hard.above(name + "pairs that met", met, 250);
        hard.below(name + "places [d]", position, 1e-12);
        hard.below(name + "velocities of 1 m/s [m/s]", velocity, 1e-12);
        hard.below(name + "spins x radius [m/s]", spin, 1e-12);
    }
}

TEST_CASE("23 permuted ids of a bed", "[hard]")
{
    // Bulk figures of six beds must not differ from those of the same beds with their spheres permuted by more than
    // chance.
    HardCase hard("23 permuted ids of a bed");
    const std::vector<std::string> small = {
        "fill.0.count=700", "fill.0.region.max=[0.085, 0.085, 0.40]", "wall.box.max=[0.085, 0.085, 0.42]"};
    std::vector<Bed> permuted, seeded;
    for (std::uint64_t k = 1; k <= 6; ++k) {
        auto overrides = small;
        overrides.push_back("seed=" + std::to_string(k));
        seeded.push_back(settle(overrides, 0));
        permuted.push_back(settle(overrides, k));
    }
    const auto compare = [&](const std::string& what, double Bed::*figure) {
        const auto n = static_cast<double>(seeded.size());
        const auto mean_and_square_error = [&](const std::vector<Bed>& beds) {
            double mean = 0.0, squares = 0.0;
            for (const Bed& bed : beds) mean += bed.*figure / n;
            for (const Bed& bed : beds) squares += std::pow(bed.*figure - mean, 2);
            return std::pair(mean, squares / (n - 1) / n);
        };
        const auto [of_seeds, seeds_error] = mean_and_square_error(seeded);
        const auto [of_permutations, permutations_error] = mean_and_square_error(permuted);
        hard.tell(what + ", six beds", of_seeds);
        hard.tell(what + ", permuted", of_permutations);
        // Student's t with some eight degrees of freedom exceeds 4 once in 250.
        hard.below(what + ": difference [standard error]",
            std::abs(of_seeds - of_permutations) / std::sqrt(seeds_error + permutations_error), 4);
    };
    compare("height [d]", &Bed::height);
    compare("mean overlap [d]", &Bed::overlap);
    compare("overlapping contacts a sphere", &Bed::contacts);
}
