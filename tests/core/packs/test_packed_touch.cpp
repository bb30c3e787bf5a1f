// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/candidates/carried.hpp"
#include "core/packs/kernels.hpp"
#include "tests/support/world.hpp"

#include <algorithm>
#include <cstring>

namespace talus::test
{
namespace
{

constexpr double radius = standard_radius;

constexpr int spheres = 2 * pack_size;

/// Eight touches of sixteen spheres, and what they need: gaps from −0.1 to 0.1 radii, motions at random, the last two
/// spheres in one place. Every sphere is of a material of its own.
struct Touches {
    std::vector<ReachBall> balls;
    std::vector<Motion> motion;
    std::vector<std::int32_t> material;
    std::vector<ContactLaw> laws = std::vector<ContactLaw>(spheres * spheres);
    std::vector<CarriedContact> carried = std::vector<CarriedContact>(pack_size);
    StepConstants step = {};
    // what becomes of them
    ContactPack contact = {};
    RecordPack record = {};
    TouchSums sums;
    TouchMarks marks;

    explicit Touches(std::uint64_t seed)
    {
        Random random(seed);
        const auto number = [&](double least, double most) { return least + (most - least) * uniform(random); };
        step.law = {.h = 1e-3, .h_before = 2e-3, .threshold_speed = 0.03, .push_out_speed = 0.1};
        step.reach = 0.02 * radius;
        step.horizon = 1.5e-3;
        step.touching = 1e-9 * radius;
        step.inverse_inertia = 2.5;
        step.restitution = true;
        step.jam_steps = TouchRecord::jam_steps;
        std::fill_n(step.cell_length, 3, infinity);
        for (int lane = 0; lane < pack_size; ++lane) {
            const Vec3 place(number(-1, 1), number(-1, 1), number(-1, 1));
            const Vec3 way = Vec3(number(-1, 1), number(-1, 1), number(-1, 1)).normalized();
            add(place);
            add(lane + 1 < pack_size ? Vec3(place + number(1.9, 2.1) * radius * way) : place);
            for (std::size_t s : {motion.size() - 2, motion.size() - 1})
                motion[s].velocity = Vec3(number(-1, 1), number(-1, 1), number(-1, 1));
            contact.a[lane] = 2 * lane;
            contact.b[lane] = 2 * lane + 1;
            record.slot[lane] = static_cast<std::uint32_t>(pack_size - 1 - lane);
            ContactLaw& law = laws[static_cast<std::size_t>(2 * lane * spheres + 2 * lane + 1)];
            law = {number(0, 1), lane % 3 ? number(0, 1) : 0.0, 0.0, lane % 2 ? 1e4 : infinity};
            CarriedContact& own = carried_of(lane);
            for (int d = 0; d < 3; ++d) own.impulse[d] = number(-1, 1);
            own.compression = static_cast<float>(number(0, 0.1 * radius));
            own.touch.note_load(is_loaded(lane));
            if (is_jammed(lane)) own.touch.note_crushed();
        }
    }

    static bool is_loaded(int lane) { return lane % 2; }
    static bool is_jammed(int lane) { return lane % 4 == 3; }

    void add(const Vec3& x)
    {
        material.push_back(static_cast<std::int32_t>(motion.size()));
        balls.push_back({{x.x(), x.y(), x.z()}, 1.01 * radius});
        motion.push_back({.inverse_mass = 1000.0 + 100.0 * static_cast<double>(motion.size()), .radius = radius});
    }

    const ContactLaw& law(int lane) const { return laws[static_cast<std::size_t>(2 * lane * spheres + 2 * lane + 1)]; }
    CarriedContact& carried_of(int lane) { return carried[static_cast<std::size_t>(pack_size - 1 - lane)]; }

    SphereNumbers numbers() const
    {
        return {balls.data(), reinterpret_cast<const double*>(motion.data()), material.data(), spheres,
            reinterpret_cast<const double*>(laws.data()), reinterpret_cast<const double*>(carried.data())};
    }

    void touch(const Kernels& kernels) { marks = kernels.touch.touch_spheres(contact, record, sums, numbers(), step); }

    /// Returns the worst excess over the cone.
    double hand_on(const Kernels& kernels, double deep, unsigned& deep_lanes)
    {
        return kernels.touch.hand_on(contact, record, deep, deep_lanes, reinterpret_cast<double*>(carried.data()));
    }
};

template <class T> bool same_bytes(const T& a, const T& b)
{
    return std::memcmp(&a, &b, sizeof(T)) == 0;
}

} // namespace

TEST_CASE("all instruction sets find the same touches and make the same contacts, to the bit", "[packed_touch]")
{
    const auto seed = static_cast<std::uint64_t>(GENERATE(range(1, 40)));
    const bool rigid = GENERATE(false, true);
    Touches begin(seed);
    begin.step.law.rigid = rigid;
    begin.step.law.parts = seed % 5 ? 1.0 : 3.0;
    begin.step.law.shallow_overlap = 0.01 * radius;
    begin.step.is_periodic = seed % 3 == 0;
    if (begin.step.is_periodic) begin.step.cell_length[0] = 1.3;
    if (seed % 4 == 0) // the last lanes are empty
        for (int lane = static_cast<int>(seed % 7) + 1; lane < pack_size; ++lane)
            begin.contact.a[lane] = begin.contact.b[lane] = -1;
    const std::vector<std::int32_t> pairs = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 0, 15, 2, 9};
    const auto near = [&](const Kernels& kernels, std::uint32_t candidates) {
        std::vector<std::uint32_t> list(pack_size + 1);
        list.resize(kernels.touch.find_near(pairs.data(), candidates, begin.numbers(), begin.step, list.data()));
        return list;
    };
    for (const Kernels* kernels : usable_kernels()) {
        CAPTURE(kernels->instructions);
        Touches other = begin, same = begin;
        same.touch(plain_kernels);
        other.touch(*kernels);
        CHECK(same_bytes(other.contact, same.contact));
        CHECK(same_bytes(other.record, same.record));
        CHECK(same_bytes(other.sums, same.sums));
        CHECK((other.marks.impact == same.marks.impact && other.marks.carries == same.marks.carries));
        unsigned deep = 0, same_deep = 0;
        const double worst = other.hand_on(*kernels, 0.02 * radius, deep);
        CHECK(worst == same.hand_on(plain_kernels, 0.02 * radius, same_deep));
        CHECK(deep == same_deep);
        CHECK(same_bytes(other.record, same.record));
        for (std::size_t slot = 0; slot < pack_size; ++slot) CHECK(same_bytes(other.carried[slot], same.carried[slot]));
        for (const std::uint32_t candidates : {8u, 5u, 1u})
            CHECK(near(*kernels, candidates) == near(plain_kernels, candidates));
    }
}

TEST_CASE("eight touches become what their laws say one by one", "[packed_touch]")
{
    Touches all(static_cast<std::uint64_t>(GENERATE(range(1, 40))));
    all.step.law.rigid = GENERATE(false, true);
    all.touch(fastest_kernels());
    const ContactPack& contact = all.contact;
    for (int lane = 0; lane < pack_size; ++lane) {
        CAPTURE(lane);
        const Motion &a = all.motion[2 * lane], &b = all.motion[2 * lane + 1];
        const double *x = all.balls[2 * lane].center, *y = all.balls[2 * lane + 1].center;
        const Vec3 across(x[0] - y[0], x[1] - y[1], x[2] - y[2]), velocity = a.velocity - b.velocity;
        const double gap = across.norm() - 2 * radius;
        const Vec3 normal = across.norm() > 0.0 ? Vec3(across / across.norm()) : Vec3::UnitZ();
        const double u_n = normal.dot(velocity), apart = across.squaredNorm() - 4 * radius * radius;
        CHECK(all.record.gap[lane] == gap);
        for (int d = 0; d < 3; ++d) CHECK(contact.normal[d][lane] == normal[d]);
        CHECK(contact.arm_scale[lane] == across.norm() / (2 * radius));

        const auto root = [](double square) { return std::sqrt(square); };
        const ContactLaw& pair = all.law(lane);
        const CarriedContact& own = all.carried_of(lane);
        const bool loaded = Touches::is_loaded(lane);
        const double closes = closing_time<double>(-across.dot(velocity), velocity.squaredNorm(), apart, root);
        const bool impact = is_impact<double>(gap, u_n, closes, loaded, pair.restitution, all.step.law);
        const bool within_reach = gap <= all.step.reach || gap + all.step.horizon * u_n <= 0.0;
        const bool misses = gap > 0.0 && closes >= all.step.law.h;
        const bool bears = loaded || pair.restitution == 0.0;
        const bool passes_by = !impact && !bears && misses && gap + all.step.law.h * u_n < 0.0;
        CHECK(all.record.holds(static_cast<std::size_t>(lane)) == (within_reach && !passes_by));
        if (!all.record.holds(static_cast<std::size_t>(lane))) {
            for (const auto* row : {contact.target, contact.compliance, contact.normal_mass, contact.tangent_mass,
                     contact.inverse_mass_sum, contact.impulse[0], contact.impulse[1], contact.impulse[2]})
                CHECK(row[lane] == 0.0);
            continue;
        }
        CHECK((all.record.kind[lane] == ContactKind::impact) == impact);
        CHECK((all.record.kind[lane] == ContactKind::open) == (!impact && gap > 0.0));
        CHECK((all.marks.impact >> lane & 1U) == impact);

        // What is carried: the part along n, and within the cone of that across it.
        const Vec3 warm(contact.impulse[0][lane], contact.impulse[1][lane], contact.impulse[2][lane]);
        const double along = impact ? 0.0 : std::max(0.0, own.impulse.dot(normal));
        CHECK(warm.dot(normal) == Approx(along).margin(1e-15));
        const Vec3 tangent = own.impulse - own.impulse.dot(normal) * normal;
        const double share = std::min(1.0, pair.friction * along / tangent.norm());
        CHECK((warm - along * normal - share * tangent).norm() < 1e-14);
        CHECK((all.marks.carries >> lane & 1U) == (along > 0.0));

        const double w = a.inverse_mass + b.inverse_mass;
        const bool jammed = Touches::is_jammed(lane);
        const double kappa = jammed ? 0.0 : compression<double>(gap, own.compression, u_n, loaded, all.step.law);
        CHECK(all.record.compression[lane] == static_cast<float>(kappa));
        const bool rests = !impact && gap <= 0.0;
        const auto law = normal_law<double>({impact, !impact && gap > 0.0, rests && !jammed ? -kappa : gap, u_n, w,
                                                pair.restitution, pair.stiffness, jammed},
            all.step.law);
        CHECK(contact.target[lane] == Approx(law.target).epsilon(1e-12).margin(1e-15));
        CHECK(contact.compliance[lane] == law.compliance);
        CHECK(contact.normal_mass[lane] == 1.0 / (w + law.compliance));
    }
}

TEST_CASE("contacts hand on their impulses, impacts and touches out of reach nothing", "[packed_touch]")
{
    Touches all(static_cast<std::uint64_t>(GENERATE(range(1, 40))));
    all.touch(fastest_kernels());
    const double deep = 0.05 * radius;
    for (int lane = 0; lane < pack_size; lane += 2) // as if solved
        if (all.record.holds(static_cast<std::size_t>(lane)))
            for (int d = 0; d < 3; ++d) all.contact.impulse[d][lane] = 0.3 * all.contact.normal[d][lane];
    const Touches solved = all;
    unsigned deep_lanes = 0;
    double worst = 0.0;
    const double told = all.hand_on(fastest_kernels(), deep, deep_lanes);
    for (int lane = 0; lane < pack_size; ++lane) {
        CAPTURE(lane);
        const CarriedContact& own = all.carried_of(lane);
        const Vec3 impulse(
            solved.contact.impulse[0][lane], solved.contact.impulse[1][lane], solved.contact.impulse[2][lane]);
        const Vec3 normal(
            solved.contact.normal[0][lane], solved.contact.normal[1][lane], solved.contact.normal[2][lane]);
        const bool holds = all.record.holds(static_cast<std::size_t>(lane));
        const bool keeps = holds && all.record.kind[lane] != ContactKind::impact;
        CHECK(own.impulse == (keeps ? impulse : Vec3::Zero().eval()));
        CHECK(own.compression == solved.record.compression[lane]);
        const bool is_deep = holds && -all.record.gap[lane] > deep;
        CHECK((deep_lanes >> lane & 1U) == is_deep);
        if (!holds) CHECK_FALSE(own.touch.is_loaded());
        if (holds && !is_deep) CHECK(own.touch.is_loaded() == (keeps && impulse.dot(normal) > 0.0));
        if (is_deep) CHECK(own.touch.is_jammed() == Touches::is_jammed(lane)); // left to the caller
        const double along = impulse.dot(normal);
        worst = std::max(worst, (impulse - along * normal).norm() - all.law(lane).friction * along);
    }
    CHECK(told == Approx(worst).margin(1e-16));
}

TEST_CASE("a touch across the border of a cell is that of the nearest image", "[packed_touch][periodic]")
{
    Touches direct(7), across = direct;
    across.step.is_periodic = true;
    across.step.cell_length[1] = 2.5;
    for (std::size_t s = 1; s < across.balls.size(); s += 2) across.balls[s].center[1] += s % 4 == 1 ? 2.5 : -2.5;
    for (Touches* touches : {&direct, &across}) touches->touch(fastest_kernels());
    for (int lane = 0; lane + 1 < pack_size; ++lane) {
        CHECK(across.record.gap[lane] == Approx(direct.record.gap[lane]).margin(1e-15));
        for (int d = 0; d < 3; ++d)
            CHECK(across.contact.normal[d][lane] == Approx(direct.contact.normal[d][lane]).margin(1e-13));
    }
}

} // namespace talus::test
