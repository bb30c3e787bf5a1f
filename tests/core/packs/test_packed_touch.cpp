// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/packs/kernels.hpp"
#include "tests/support/world.hpp"

#include <algorithm>
#include <cstring>

namespace talus::test
{
namespace
{

constexpr double radius = standard_radius;

/// Eight touches of sixteen spheres, and what they need: gaps from −0.1 to 0.1 radii, motions at random, the last two
/// spheres in one place.
struct Touches {
    std::vector<ReachBall> balls;
    std::vector<Motion> motion;
    TouchPack touch = {};
    StepConstants step = {};

    explicit Touches(std::uint64_t seed)
    {
        Random random(seed);
        const auto number = [&](double least, double most) { return least + (most - least) * uniform(random); };
        step.law = {.h = 1e-3, .threshold_speed = 0.03, .push_out_speed = 0.1};
        step.reach = 0.02 * radius;
        step.horizon = 1.5e-3;
        step.touching = 1e-9 * radius;
        step.inverse_inertia = 2.5;
        step.restitution = true;
        std::fill_n(step.cell_length, 3, infinity);
        touch.count = pack_size;
        for (int lane = 0; lane < pack_size; ++lane) {
            const Vec3 place(number(-1, 1), number(-1, 1), number(-1, 1));
            const Vec3 way = Vec3(number(-1, 1), number(-1, 1), number(-1, 1)).normalized();
            add(place);
            add(lane + 1 < pack_size ? Vec3(place + number(1.9, 2.1) * radius * way) : place);
            for (std::size_t s : {motion.size() - 2, motion.size() - 1})
                motion[s].velocity = Vec3(number(-1, 1), number(-1, 1), number(-1, 1));
            touch.contact.a[lane] = 2 * lane;
            touch.contact.b[lane] = 2 * lane + 1;
            touch.contact.friction[lane] = number(0, 1);
            touch.restitution[lane] = lane % 3 ? number(0, 1) : 0.0;
            touch.stiffness[lane] = lane % 2 ? 1e4 : infinity;
            for (int d = 0; d < 3; ++d) touch.carried[d][lane] = number(-1, 1);
            touch.free_overlap[lane] = number(0, 0.1 * radius);
            touch.loaded[lane] = -(lane % 2);
            touch.jammed[lane] = -(lane % 4 == 3);
        }
    }

    void add(const Vec3& x)
    {
        balls.push_back({{x.x(), x.y(), x.z()}, 1.01 * radius});
        motion.push_back({.inverse_mass = 1000.0 + 100.0 * static_cast<double>(motion.size()), .radius = radius});
    }

    const double* motions() const { return reinterpret_cast<const double*>(motion.data()); }
};

} // namespace

TEST_CASE("all instruction sets find the same touches and make the same contacts, to the bit", "[packed_touch]")
{
    const auto seed = static_cast<std::uint64_t>(GENERATE(range(1, 40)));
    const bool rigid = GENERATE(false, true);
    Touches plain(seed);
    plain.step.law.rigid = rigid;
    plain.step.law.parts = seed % 5 ? 1.0 : 3.0;
    plain.step.law.shallow_overlap = 0.01 * radius;
    plain.step.is_periodic = seed % 3 == 0;
    if (plain.step.is_periodic) plain.step.cell_length[0] = 1.3;
    const std::vector<std::int32_t> pairs = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 0, 15, 2, 9, 14, 15, 1, 3, 12, 13};
    const std::vector<std::uint8_t> loaded = {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0};
    const auto near = [&](const Kernels& kernels, std::uint32_t first) {
        std::vector<std::uint32_t> list(loaded.size() + 1);
        list.resize(kernels.touch.find_near(
            pairs.data(), loaded.data(), first, 11, plain.balls.data(), plain.step, list.data()));
        return list;
    };
    for (const Kernels* kernels : usable_kernels()) {
        CAPTURE(kernels->instructions);
        Touches other = plain, same = plain;
        plain_kernels.touch.touch_spheres(same.touch, plain.balls.data(), plain.motions(), plain.step);
        kernels->touch.touch_spheres(other.touch, plain.balls.data(), plain.motions(), plain.step);
        CHECK(std::memcmp(&other.touch, &same.touch, sizeof(TouchPack)) == 0);
        for (const std::uint32_t first : {0u, 3u, 10u}) CHECK(near(*kernels, first) == near(plain_kernels, first));
    }
}

TEST_CASE("eight touches become what their laws say one by one", "[packed_touch]")
{
    Touches all(static_cast<std::uint64_t>(GENERATE(range(1, 40))));
    all.step.law.rigid = GENERATE(false, true);
    fastest_kernels().touch.touch_spheres(all.touch, all.balls.data(), all.motions(), all.step);
    const TouchPack& touch = all.touch;
    const ContactPack& contact = touch.contact;
    for (int lane = 0; lane < pack_size; ++lane) {
        CAPTURE(lane);
        const Motion &a = all.motion[2 * lane], &b = all.motion[2 * lane + 1];
        const double *x = all.balls[2 * lane].center, *y = all.balls[2 * lane + 1].center;
        const Vec3 across(x[0] - y[0], x[1] - y[1], x[2] - y[2]), velocity = a.velocity - b.velocity;
        const double gap = across.norm() - 2 * radius;
        const Vec3 normal = across.norm() > 0.0 ? Vec3(across / across.norm()) : Vec3::UnitZ();
        const double u_n = normal.dot(velocity), apart = across.squaredNorm() - 4 * radius * radius;
        CHECK(touch.gap[lane] == gap);
        for (int d = 0; d < 3; ++d) CHECK(contact.normal[d][lane] == normal[d]);
        CHECK(contact.arm_scale[lane] == across.norm() / (2 * radius));
        CHECK((touch.within_reach[lane] != 0) == (gap <= all.step.reach || gap + all.step.horizon * u_n <= 0.0));

        const auto root = [](double square) { return std::sqrt(square); };
        const double closes = closing_time<double>(-across.dot(velocity), velocity.squaredNorm(), apart, root);
        const bool loaded = lane % 2,
                   impact = is_impact<double>(gap, u_n, closes, loaded, touch.restitution[lane], all.step.law);
        CHECK((touch.impact[lane] != 0) == impact);
        CHECK((touch.open[lane] != 0) == (!impact && gap > 0.0));

        // What is carried: the part along n, and within the cone of that across it.
        Vec3 carried, warm;
        for (int d = 0; d < 3; ++d) {
            carried[d] = touch.carried[d][lane];
            warm[d] = contact.impulse[d][lane];
        }
        const double along = impact ? 0.0 : std::max(0.0, carried.dot(normal));
        CHECK(warm.dot(normal) == Approx(along).margin(1e-15));
        const Vec3 tangent = carried - carried.dot(normal) * normal;
        const double share = std::min(1.0, contact.friction[lane] * along / tangent.norm());
        CHECK((warm - along * normal - share * tangent).norm() < 1e-14);
        CHECK((touch.carries[lane] != 0) == (along > 0.0));

        const double w = a.inverse_mass + b.inverse_mass;
        const auto law =
            normal_law<double>({impact, !impact && gap > 0.0, gap + touch.free_overlap[lane], u_n, w, warm.dot(normal),
                                   touch.restitution[lane], touch.stiffness[lane], lane % 4 == 3},
                all.step.law);
        CHECK(contact.target[lane] == Approx(law.target).epsilon(1e-12).margin(1e-15));
        CHECK(contact.compliance[lane] == law.compliance);
        CHECK(contact.normal_mass[lane] == 1.0 / (w + law.compliance));
    }
}

TEST_CASE("a touch across the border of a cell is that of the nearest image", "[packed_touch][periodic]")
{
    Touches direct(7), across = direct;
    across.step.is_periodic = true;
    across.step.cell_length[1] = 2.5;
    for (std::size_t s = 1; s < across.balls.size(); s += 2) across.balls[s].center[1] += s % 4 == 1 ? 2.5 : -2.5;
    for (Touches* touches : {&direct, &across})
        fastest_kernels().touch.touch_spheres(touches->touch, touches->balls.data(), touches->motions(), touches->step);
    for (int lane = 0; lane + 1 < pack_size; ++lane) {
        CHECK(across.touch.gap[lane] == Approx(direct.touch.gap[lane]).margin(1e-15));
        for (int d = 0; d < 3; ++d)
            CHECK(across.touch.contact.normal[d][lane] == Approx(direct.touch.contact.normal[d][lane]).margin(1e-13));
    }
}

} // namespace talus::test
