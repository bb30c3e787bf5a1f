// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/packs/kernels.hpp"
#include "core/packs/numbers.hpp"
#include "core/solver/gauss_seidel.hpp"
#include "core/solver/whole_contact.hpp"
#include "tests/support/contacts.hpp"
#include "tests/support/world.hpp"

#include <cmath>
#include <cstring>
#include <set>

namespace talus::test
{
namespace
{

/// Many spheres of three sizes that have just fallen into a box, in several tiles; its walls may turn.
World crowd(const ContactLaw& law, bool spin, bool walls_move)
{
    World world = make_world(law, production_settings(Stabilisation::matched), 4e-4);
    world.model.physics.spin = world.model.physics.spin && spin;
    const double edge = 14 * standard_radius;
    WallMotion motion;
    if (walls_move) motion.push_back(Turning{{}, Vec3(0.5 * edge, 0.5 * edge, 0), Vec3(0.36, 0.48, 0.8), 0.8});
    world.add_wall(box_panels({Vec3::Zero(), Vec3(edge, edge, 8 * edge)}, {"z+"}), motion);
    Random random(5);
    for (int k = 0; k < 7 * 7 * 6; ++k) {
        const Vec3 place(k % 7 + 0.5, k / 7 % 7 + 0.5, k / 49 + 0.5);
        const double radius = standard_radius * (0.6 + 0.4 * uniform(random));
        const double x = uniform(random), y = uniform(random);
        world.add_sphere(2 * standard_radius * place, Vec3(x - 0.5, y - 0.5, -uniform(random)),
            spin ? Vec3(50 * y, 50 * x, 30) : Vec3::Zero().eval(), radius);
    }
    world.step(120);
    return world;
}

/// What a kernel makes of the next step's problem, to the bit.
struct Result {
    std::vector<double> numbers;

    void add(double number) { numbers.push_back(number); }
    void add(const SweepSums& sums)
    {
        add(sums.change);
        add(sums.size);
    }
    void add(const Vec3& vector)
    {
        for (int d = 0; d < 3; ++d) add(vector[d]);
    }
    bool operator==(const Result& other) const
    {
        return numbers.size() == other.numbers.size() &&
               std::memcmp(numbers.data(), other.numbers.data(), numbers.size() * sizeof(double)) == 0;
    }
};

Result swept_by(const Kernels& kernels, World world)
{
    const std::size_t variant = with_rows(world.model.physics, [](auto rows) { return decltype(rows)::index; });
    const SweepKernel& kernel = kernels.sweep[variant];
    auto* bodies = reinterpret_cast<double*>(world.state.bodies.data());
    auto& contacts = world.network.contacts;
    Result result;
    const auto pass = [&](auto&& of_tile) {
        for (std::size_t tile = 0; tile < contacts.spheres.size(); ++tile)
            result.add(of_tile(contacts.spheres[tile].span(), contacts.walls[tile].span()));
    };
    for (std::size_t tile = 0; tile < contacts.spheres.size(); ++tile)
        kernel.warm_start(contacts.spheres[tile].span(), contacts.walls[tile].span(), bodies);
    for (const double relaxation : {1.0, 1.3, 1.0})
        pass([&](const PackSpan& spheres, const PackSpan& walls) {
            return kernel.relax(spheres, walls, bodies, relaxation);
        });
    pass([&](const PackSpan& spheres, const PackSpan& walls) { return kernel.measure(spheres, walls, bodies); });
    for_each_contact(world.network, [&](const TileContacts& tile, std::size_t k, bool) {
        result.add(tile.impulse(k));
        if (tile.has_rolling()) result.add(tile.rolling_impulse(k));
    });
    for (const Body& m : world.state.bodies) {
        result.add(m.velocity);
        result.add(m.rim_velocity);
    }
    return result;
}

} // namespace

TEST_CASE("all instruction sets give the same bits, whatever a scene models", "[packed_sweep]")
{
    const auto usable = usable_kernels();
    REQUIRE(usable.back() == &plain_kernels);
    const auto [law, spin] = GENERATE(std::pair(ContactLaw{}, false), std::pair(ContactLaw{.friction = 0.4}, false),
        std::pair(ContactLaw{.friction = 0.4, .restitution = 0.3}, true),
        std::pair(ContactLaw{.friction = 0.6, .rolling_friction = 0.1}, true));
    const bool walls_move = GENERATE(false, true);
    World world = crowd(law, spin, walls_move);
    world.update_candidates();
    assemble_contacts(world.network, world.state, world.model, {world.model.time_step}, world.placed_walls());
    const Result plain = swept_by(plain_kernels, world);
    REQUIRE(plain.numbers.size() > 2000);
    for (const Kernels* kernels : usable) {
        CAPTURE(kernels->instructions);
        CHECK(swept_by(*kernels, world) == plain);
    }
}

TEST_CASE("a multiply-add made by parts has the bits of one that is rounded once", "[packed_sweep]")
{
    Random random(3);
    const auto any = [&] {
        const double size = std::ldexp(1.0 + uniform(random), static_cast<int>(60 * uniform(random)) - 30);
        const double kind = uniform(random);
        return kind < 0.02 ? 0.0 : kind < 0.04 ? -0.0 : kind < 0.5 ? -size : size;
    };
    std::size_t wrong = 0;
    for (int k = 0; k < 1000000; ++k) {
        const double scale = std::ldexp(1.0, k % 8 == 0 ? -static_cast<int>(1080 * uniform(random)) : 0);
        const double a = scale * any(), b = any(), kind = uniform(random); // numbers that are hardly any, too
        const double c = kind < 0.3   ? -a * b
                         : kind < 0.5 ? -a * b * (1.0 + 0x1p-52)
                                      : scale * any(); // what cancels, too
        const packs::Numbers<2> as{a, a}, bs{b, b}, cs{c, c}, made = packs::fused_by_parts<2>(as, bs, cs);
        const double found = made[0], expected = std::fma(a, b, c);
        wrong += std::memcmp(&found, &expected, sizeof found) != 0;
    }
    CHECK(wrong == 0);
}

TEST_CASE("no two contacts of a pack share a sphere, and those of large tiles are nearly full", "[packed_sweep]")
{
    World world = crowd({.friction = 0.4}, true, false);
    world.step(200); // until more of them lie
    std::size_t contacts = 0, large = 0;
    std::set<std::pair<std::int32_t, std::int32_t>> pairs;
    for (const TileContacts& tile : world.network.contacts.spheres) {
        if (tile.count() > 150) {
            ++large;
            CHECK(static_cast<double>(tile.count()) > 0.8 * pack_size * static_cast<double>(tile.packs()));
        }
        std::map<std::size_t, std::set<std::int32_t>> spheres;
        for (const std::size_t k : tile.indices()) {
            ++contacts;
            CHECK(spheres[k / pack_size].insert(tile.a(k)).second);
            CHECK(spheres[k / pack_size].insert(tile.b(k)).second);
            CHECK(pairs.insert({tile.a(k), tile.b(k)}).second);
        }
    }
    CHECK(contacts > 400);
    CHECK(large > 0);
}

TEST_CASE("a contact asks for its parting speed at most, and friction is within the cone of that", "[packed_sweep]")
{
    // Eight pairs of like spheres that close with 1 m/s along n, and slide with as much across it: each asks to part
    // with 1 m/s, and so has the impulse 2/W. W = 2/kg, and with spin tangents have 3.5 W.
    constexpr double w = 2.0, friction = 0.5;
    const auto lane = static_cast<std::size_t>(GENERATE(range(0, pack_size)));
    const double parting = GENERATE(-2.0, -1.0, 0.0, 0.9, 1.1, infinity);
    TileContacts contacts;
    contacts.clear({});
    contacts.append_pack();
    std::vector<Body> bodies(2 * pack_size, Body{.inverse_mass = w / 2, .spin_radius = standard_radius});
    for (int k = 0; k < pack_size; ++k) {
        bodies[2 * k].velocity = Vec3(0.5, 0, -0.5);
        bodies[2 * k + 1].velocity = -bodies[2 * k].velocity;
        set_contact(contacts, static_cast<std::size_t>(k),
            {.a = 2 * k,
                .b = 2 * k + 1,
                .target = 1.0,
                .parting = static_cast<std::size_t>(k) == lane ? parting : infinity,
                .friction = friction,
                .inverse_mass_sum = w});
    }
    const std::vector<Body> before = bodies;
    for (const Kernels* kernels : usable_kernels()) {
        CAPTURE(kernels->instructions);
        TileContacts swept = contacts, none;
        bodies = before;
        none.clear({});
        constexpr std::size_t variant = Rows<true, true, false, false>::index;
        kernels->sweep[variant].relax(swept.span(), none.span(), reinterpret_cast<double*>(bodies.data()), 1.0);
        for (std::size_t k = 0; k < pack_size; ++k) {
            const double normal = (1.0 + std::max(-1.0, k == lane ? std::min(parting, 1.0) : 1.0)) / w;
            const double tangent = std::min(friction * normal, 1.0 / (3.5 * w));
            CHECK((swept.impulse(k) - Vec3(-tangent, 0, normal)).norm() < 1e-15);
            CHECK((bodies[2 * k].velocity - before[2 * k].velocity - w / 2 * swept.impulse(k)).norm() < 1e-15);
        }
    }
}

TEST_CASE("contacts of one sphere are in packs of their own, more than a window of them", "[packed_sweep]")
{
    TileContacts contacts;
    contacts.clear({});
    PackFiller filler;
    filler.begin(contacts, 300);
    constexpr std::int32_t many = 150;
    for (std::int32_t b = 1; b <= many; ++b) {
        const std::size_t star = filler.place(0, b); // all share sphere 0
        set_contact(contacts, star, {.a = 0, .b = b});
        const std::size_t other = filler.place(b, 100 + b); // shares b with the one before
        set_contact(contacts, other, {.a = b, .b = 100 + b});
        CHECK(star / pack_size != other / pack_size);
    }
    CHECK(contacts.count() == 2 * many);
    CHECK(contacts.packs() >= many);
    for (std::size_t p = 0; p < contacts.packs(); ++p) {
        std::multiset<std::int32_t> spheres;
        for (const std::size_t k : contacts.indices())
            if (k / pack_size == p) {
                spheres.insert(contacts.a(k));
                spheres.insert(contacts.b(k));
            }
        for (const std::int32_t sphere : spheres) CHECK(spheres.count(sphere) == 1);
    }
}

} // namespace talus::test
