// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/candidates/carried.hpp"
#include "core/law/hertz.hpp"
#include "core/packs/kernels.hpp"
#include "tests/support/world.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>

namespace talus::test
{
namespace
{

constexpr double radius = standard_radius;

constexpr int spheres = 2 * pack_size;

/// Eight touches of sixteen spheres, and what they need: gaps from −0.1 to 0.1 radii, motions at random, the last two
/// spheres in one place. Every sphere is of a material of its own.
struct Touches {
    std::vector<SpherePlace> places;
    std::vector<double> reaches;
    std::vector<std::int32_t> material;
    std::vector<ContactLaw> laws = std::vector<ContactLaw>(spheres * spheres);
    std::vector<CarriedContact> carried = std::vector<CarriedContact>(pack_size);
    StepConstants step = {};
    // what becomes of them
    ContactPack contact = {};
    RecordPack record = {};
    TouchSums sums;
    PackImpacts impacts;
    unsigned deep = 0; ///< lanes, as bits

    explicit Touches(std::uint64_t seed)
    {
        Random random(seed);
        const auto number = [&](double least, double most) { return least + (most - least) * uniform(random); };
        step.law = {.h = 1e-3,
            .threshold_speed = 0.03,
            .elastic_speed = 0.04,
            .push_out_speed = 0.1,
            .min_diameter = 2 * radius};
        step.reach = 0.02 * radius;
        step.horizon = 1.5e-3;
        step.inverse_inertia_factor = 2.5;
        std::fill_n(step.cell_length, 3, infinity);
        for (int lane = 0; lane < pack_size; ++lane) {
            const Vec3 place(number(-1, 1), number(-1, 1), number(-1, 1));
            const Vec3 way = Vec3(number(-1, 1), number(-1, 1), number(-1, 1)).normalized();
            add(place);
            add(lane + 1 < pack_size ? Vec3(place + number(1.9, 2.1) * radius * way) : place);
            for (std::size_t s : {places.size() - 2, places.size() - 1})
                for (double& component : places[s].velocity) component = number(-1, 1);
            contact.a[lane] = 2 * lane;
            contact.b[lane] = 2 * lane + 1;
            record.slot[lane] = static_cast<std::uint32_t>(pack_size - 1 - lane);
            ContactLaw& law = laws[static_cast<std::size_t>(2 * lane * spheres + 2 * lane + 1)];
            law = {number(0, 1), lane % 3 ? number(0, 1) : 0.0, 0.0, lane % 2 ? 1e4 : infinity};
            law.modulus = lane % 2 ? infinity : modulus_of(lane);
            if (was_struck(lane)) carried_of(lane).touch.note(TouchRecord::impact);
            if (is_new(lane)) continue;
            // In half of them it points outwards. Impacts have 10⁻³ N s: a part of these loads is none beside that.
            CarriedContact& own = carried_of(lane);
            const double size = lane % 2 ? 1.0 : 1e-7;
            for (int d = 0; d < 3; ++d) own.impulse[d] = size * number(-1, 1);
            own.compression = static_cast<float>(number(0, 0.1 * radius));
            own.touch.note(TouchRecord::loaded);
            if (is_jammed(lane)) own.touch.note_known();
            if (had_gap(lane)) own.touch.note(TouchRecord::closing_a_gap);
        }
    }

    /// Such that springs are as stiff as sweeps can carry at some hundredths of a radius, or a tenth [Pa].
    static double modulus_of(int lane) { return 1e3 / radius * (1 + lane); }
    static bool is_new(int lane) { return lane % 4 == 0; }
    static bool was_struck(int lane) { return lane == 4; }
    static bool is_jammed(int lane) { return lane % 4 == 3; }
    static bool had_gap(int lane) { return lane == 5 || lane == 6; }

    void add(const Vec3& x)
    {
        material.push_back(static_cast<std::int32_t>(places.size()));
        reaches.push_back(1.01 * radius);
        places.push_back(
            {{x.x(), x.y(), x.z()}, radius, {0, 0, 0}, 1000.0 + 100.0 * static_cast<double>(places.size())});
    }

    const ContactLaw& law(int lane) const { return laws[static_cast<std::size_t>(2 * lane * spheres + 2 * lane + 1)]; }
    CarriedContact& carried_of(int lane) { return carried[static_cast<std::size_t>(pack_size - 1 - lane)]; }
    bool holds(int lane) const { return record.holds(static_cast<std::size_t>(lane)); }
    bool is_struck(int lane) const { return impacts.lanes >> lane & 1U; }
    static Vec3 vector(const double (&rows)[3][pack_size], int lane)
    {
        return {rows[0][lane], rows[1][lane], rows[2][lane]};
    }
    Vec3 normal(int lane) const { return vector(contact.normal, lane); }
    Vec3 impulse(int lane) const { return vector(contact.impulse, lane); }
    static Vec3 difference(const double (&x)[3], const double (&y)[3])
    {
        return {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
    }
    Vec3 across(int lane) const { return difference(places[2 * lane].center, places[2 * lane + 1].center); }
    Vec3 velocity(int lane) const { return difference(places[2 * lane].velocity, places[2 * lane + 1].velocity); }

    /// As if solved: each contact has an impulse at random, in its cone or not.
    void solve(std::uint64_t seed)
    {
        Random random(seed);
        for (int lane = 0; lane < pack_size; ++lane) {
            const double along = std::max(0.0, 3e-4 * (uniform(random) - 0.2));
            const Vec3 other(uniform(random), uniform(random), uniform(random));
            const Vec3 tangent = 1e-4 * (other - other.dot(normal(lane)) * normal(lane));
            if (!holds(lane) || along == 0.0) continue; // without a load there is no friction
            for (int d = 0; d < 3; ++d) contact.impulse[d][lane] = along * normal(lane)[d] + tangent[d];
        }
    }

    SphereNumbers numbers() const
    {
        return {places.data(), reaches.data(), material.data(), spheres, reinterpret_cast<const double*>(laws.data()),
            reinterpret_cast<const double*>(carried.data())};
    }

    void touch(const Kernels& kernels)
    {
        impacts = kernels.touch.touch_spheres(contact, record, sums, numbers(), step);
    }

    HandedOn hand_on(const Kernels& kernels)
    {
        HandedOn handed;
        deep = kernels.touch.hand_on(contact, record, step.law, reinterpret_cast<double*>(carried.data()), handed);
        return handed;
    }
};

template <class T> bool same_bytes(const T& a, const T& b)
{
    return std::memcmp(&a, &b, sizeof(T)) == 0;
}

/// What a spring holds [J].
double spring_energy(double kappa, double u_n, double compliance, double inverse_mass_sum, const LawOfStep& step)
{
    const double square = spring_square<double>(kappa, u_n, compliance, inverse_mass_sum, step);
    return energy_of_square<double>(square, compliance, inverse_mass_sum, step);
}

} // namespace

TEST_CASE("all instruction sets find the same touches and make the same contacts, to the bit", "[packed_touch]")
{
    const auto seed = static_cast<std::uint64_t>(GENERATE(range(1, 40)));
    const bool rigid = GENERATE(false, true);
    Touches begin(seed);
    begin.step.law.rigid = rigid;
    begin.step.law.parts = seed % 5 ? 1.0 : 3.0;
    begin.step.law.elastic = GENERATE(false, true);
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
        CHECK(other.impacts.lanes == same.impacts.lanes);
        CHECK(same_bytes(other.impacts.size, same.impacts.size));
        for (Touches* touches : {&other, &same}) touches->solve(seed);
        CHECK(same_bytes(other.hand_on(*kernels), same.hand_on(plain_kernels)));
        CHECK(other.deep == same.deep);
        CHECK(same_bytes(other.record, same.record));
        for (std::size_t slot = 0; slot < pack_size; ++slot) CHECK(same_bytes(other.carried[slot], same.carried[slot]));
        for (const std::uint32_t candidates : {8u, 5u, 1u})
            CHECK(near(*kernels, candidates) == near(plain_kernels, candidates));
    }
}

TEST_CASE("a gap is laid where the spheres' free paths close it, or come nearest", "[packed_touch]")
{
    Touches all(static_cast<std::uint64_t>(GENERATE(range(1, 40))));
    all.touch(fastest_kernels());
    for (int lane = 0; lane < pack_size; ++lane) {
        CAPTURE(lane);
        const Vec3 across = all.across(lane), velocity = all.velocity(lane);
        const double open = across.norm() - 2 * radius;
        double instant = 0.0;
        if (open > 0.0 && across.dot(velocity) < 0.0) {
            // The nearest instant of this step, or an earlier one at which they touch, sought step by step.
            const int parts = 100000;
            double nearest = across.norm();
            for (int k = 1; k <= parts && nearest > 2 * radius; ++k) {
                const double then = all.step.law.h * k / parts, distance = (across + then * velocity).norm();
                if (distance >= nearest) break;
                nearest = distance;
                instant = then;
            }
        }
        const Vec3 then = across + instant * velocity;
        const Vec3 normal = then.norm() > 0.0 ? Vec3(then.normalized()) : Vec3::UnitZ(); // any, but always the same
        CHECK((all.normal(lane) - normal).norm() < 1e-5);
        CHECK(all.normal(lane).norm() == Approx(1.0));
        CHECK(all.contact.arm_scale[lane] == Approx(then.norm() / (2 * radius)).epsilon(1e-5));
        const bool touches = open <= 0.0;
        const double gap = touches ? open : all.normal(lane).dot(across) - 2 * radius;
        CHECK(all.record.gap[lane] == Approx(gap).epsilon(1e-12).margin(1e-16));
        // Where paths close it, the gap along n is gone at that very instant.
        if (instant > 0.0 && then.norm() - 2 * radius < 1e-9 * radius)
            CHECK(gap + instant * all.normal(lane).dot(velocity) == Approx(0.0).margin(1e-5 * radius));
        const double u_n = all.normal(lane).dot(velocity);
        CHECK(all.holds(lane) == (gap <= all.step.reach || gap + all.step.horizon * u_n <= 0.0));
    }
}

TEST_CASE("eight touches become what their laws say one by one", "[packed_touch]")
{
    Touches all(static_cast<std::uint64_t>(GENERATE(range(1, 40))));
    all.step.law.rigid = GENERATE(false, true);
    all.step.law.parts = GENERATE(1.0, 3.0);
    all.step.law.elastic = GENERATE(false, true);
    all.touch(fastest_kernels());
    const ContactPack& contact = all.contact;
    const LawOfStep& step = all.step.law;
    for (int lane = 0; lane < pack_size; ++lane) {
        CAPTURE(lane);
        if (!all.holds(lane)) {
            for (const auto* row : {contact.target, contact.normal_mass, contact.tangent_mass, contact.impulse[0],
                     contact.impulse[1], contact.impulse[2]})
                CHECK(row[lane] == 0.0);
            CHECK(all.record.compliance[lane] == 0.0);
            CHECK_FALSE(all.is_struck(lane));
            for (const auto* sum : {all.sums.overlap, all.sums.stored_energy, all.sums.push_out_energy})
                CHECK(sum[lane] == 0.0);
            continue;
        }
        const Vec3 across = all.across(lane), velocity = all.velocity(lane), normal = all.normal(lane);
        const double gap = all.record.gap[lane];
        const double w = all.places[2 * lane].inverse_mass + all.places[2 * lane + 1].inverse_mass;
        const ContactLaw& pair = all.law(lane);
        const CarriedContact& own = all.carried_of(lane);
        const double carried_along = std::max(0.0, own.impulse.dot(normal));
        const double u_n = normal.dot(velocity);
        ContactEvent<double> event{gap, 2 * radius, 0.5 * radius, u_n, u_n,
            closing_time<double>(
                -across.dot(velocity), velocity.squaredNorm(), across.squaredNorm() - 4 * radius * radius),
            w, pair.restitution, pair.stiffness, Touches::had_gap(lane) ? 0.0 : step.parts * carried_along, 0.0,
            Touches::was_struck(lane)};
        if (step.elastic) {
            const StepSpring<double> made =
                spring_of_step<double>(own.compression, carried_along > 0.0, event, pair.modulus, step);
            event.stiffness = made.stiffness;
            event.compression = made.compression;
            event.shift = made.shift;
            event.full_shift = made.full_shift;
        }
        const double spring = spring_compliance<double>(event.stiffness, w, step);
        if (!step.elastic)
            event.compression =
                taken_over<double>(own.compression, carried_along > 0.0, gap, u_n, pair.restitution, spring, w, step);
        const bool impact = is_impact<double>(event, step), open = gap > touching_gap * 2 * radius;
        const bool yields = -gap > elastic_overlap<double>(event, step);
        CHECK(all.is_struck(lane) == impact);
        CHECK(all.impacts.size[lane] == (impact ? Approx(impact_size<double>(event)) : Approx(0.0).margin(0.0)));
        CHECK(all.record.kind[lane] == (impact      ? ContactKind::impact
                                           : open   ? ContactKind::open
                                           : yields ? ContactKind::yielding
                                                    : ContactKind::resting));

        // What is carried: the part along n, and within the cone of that across it. Of an impact, nothing.
        const Vec3 warm = all.impulse(lane);
        const double along = impact ? 0.0 : carried_along;
        CHECK(warm.dot(normal) == Approx(along).margin(1e-15));
        const Vec3 tangent = own.impulse - own.impulse.dot(normal) * normal;
        const double share = tangent.norm() > 0.0 ? std::min(1.0, pair.friction * along / tangent.norm()) : 0.0;
        CHECK((warm - along * normal - share * tangent).norm() < 1e-14);

        const auto law = normal_law<double>(event, impact, step);
        CHECK(contact.target[lane] == Approx(law.target).epsilon(1e-12).margin(1e-15));
        CHECK(all.record.compliance[lane] == Approx(law.compliance).epsilon(step.elastic ? 1e-12 : 0.0));
        CHECK(contact.parting[lane] == Approx(law.parting));
        CHECK(contact.normal_mass[lane] == Approx(1.0 / (w + law.compliance)).epsilon(1e-14));
        const double s = contact.arm_scale[lane];
        CHECK(contact.tangent_mass[lane] == Approx(1.0 / (w * (1.0 + 2.5 * s * s))));
        CHECK(all.record.inverse_mass_sum[lane] == w);

        CHECK(all.record.compression[lane] == Approx(static_cast<float>(law.compression)));
        CHECK(all.record.spring[lane] == static_cast<float>(spring));
        CHECK(all.record.restitution[lane] == static_cast<float>(pair.restitution));
        if (step.elastic) CHECK(all.record.shift[lane] == Approx(static_cast<float>(event.shift)));
        CHECK(all.record.hands_on[lane] == (impact ? 0.0F : INFINITY));

        CHECK(all.sums.overlap[lane] == std::max(0.0, -gap));
        CHECK(all.sums.worst_overlap[lane] == std::max(0.0, -gap));
        CHECK(all.sums.overlapping[lane] == (gap < 0.0));
        // A spring holds what it held with the κ that it had, and what pushing out has put in; a new one, all of it.
        const bool keeps = law.compression > 0.0, had = keeps && event.compression > touching_gap * 2 * radius;
        const auto energy = [&](double kappa, double speed) { return spring_energy(kappa, speed, spring, w, step); };
        const double kappa = law.compression - (yields && !impact ? 0.5 * step.h * std::min(0.0, u_n) : 0.0);
        const double held = had ? energy(kappa - law.grown, u_n) : 0.0;
        const double holds = keeps ? energy(kappa, had ? u_n : 0.0) : 0.0;
        const double square_before = had ? spring_square<double>(kappa - law.grown, u_n, spring, w, step) : 0.0;
        CHECK(all.record.stored[lane] == Approx(static_cast<float>(square_before)).margin(0.0));
        CHECK(all.sums.stored_energy[lane] == Approx(holds).margin(1e-18));
        CHECK(all.sums.push_out_energy[lane] == Approx(holds - held).margin(1e-12 * std::abs(holds)));
    }
}

TEST_CASE("all kinds of touches between spheres are among those tested", "[packed_touch]")
{
    std::array<int, 4> count = {};
    int out_of_reach = 0, springs = 0;
    for (std::uint64_t seed = 1; seed < 40; ++seed) {
        Touches all(seed);
        all.touch(fastest_kernels());
        for (int lane = 0; lane < pack_size; ++lane) {
            if (all.holds(lane)) ++count[static_cast<std::size_t>(all.record.kind[lane])];
            out_of_reach += !all.holds(lane);
            springs += all.record.compression[lane] > 0.0F;
        }
    }
    for (const int of_kind : count) CHECK(of_kind > 10);
    CHECK(out_of_reach > 10);
    CHECK(springs > 10);
}

TEST_CASE("contacts hand on their impulses and what their springs keep, impacts and touches out of reach nothing",
    "[packed_touch]")
{
    const auto seed = static_cast<std::uint64_t>(GENERATE(range(1, 40)));
    Touches all(seed);
    all.step.law.rigid = GENERATE(false, true);
    all.step.law.elastic = GENERATE(false, true);
    all.touch(fastest_kernels());
    all.solve(seed);
    if (seed % 2) // beside an impact a contact hands on no more than its spheres bore
        for (float& most : all.record.hands_on) most = std::min(most, 1e-4F);
    const double deep = jammed_overlap * all.step.law.min_diameter;
    const Touches solved = all;
    const LawOfStep& step = all.step.law;
    const HandedOn left = all.hand_on(fastest_kernels());
    double worst = 0.0, stored = 0.0, pushed = 0.0;
    for (int lane = 0; lane < pack_size; ++lane) {
        CAPTURE(lane);
        const CarriedContact& own = all.carried_of(lane);
        const ContactPack& contact = solved.contact;
        const Vec3 impulse = solved.impulse(lane);
        const double along = impulse.dot(solved.normal(lane)), most = solved.record.hands_on[lane];
        worst = std::max(worst, (impulse - along * solved.normal(lane)).norm() - contact.friction[lane] * along);
        const bool is_deep = solved.holds(lane) && -solved.record.gap[lane] > deep;
        CHECK((all.deep >> lane & 1U) == is_deep);
        if (!solved.holds(lane)) {
            CHECK(own.impulse == Vec3::Zero());
            CHECK(own.compression == 0.0F);
            CHECK_FALSE((own.touch.last() != TouchRecord::unloaded));
            continue;
        }
        const Vec3 handed = along > most ? Vec3(most / along * impulse) : impulse;
        CHECK((own.impulse - handed).norm() < 1e-18);
        const ContactKind kind = solved.record.kind[lane];
        if (kind == ContactKind::impact && along > 0.0) CHECK(own.impulse == Vec3::Zero());

        const bool is_loaded = along > 0.0;
        if (is_deep) {
            CHECK(own.touch.is_jammed() == Touches::is_jammed(lane)); // left to the caller
        } else {
            CHECK(own.touch.is_loaded() == (is_loaded && kind != ContactKind::impact));
            CHECK((own.touch.last() == TouchRecord::impact) == (is_loaded && kind == ContactKind::impact));
            CHECK((own.touch.last() == TouchRecord::closing_a_gap) == (is_loaded && kind == ContactKind::open));
            CHECK_FALSE(own.touch.is_jammed());
        }

        // A solved row tells u_n: q − Σ λ, or its parting speed. From it a spring knows what is left of it.
        const double u_n =
            std::min(contact.target[lane] - solved.record.compliance[lane] * along, contact.parting[lane]);
        const double shift = step.elastic ? solved.record.shift[lane] : 0.0;
        const double kappa = compression_after<double>(solved.record.compression[lane], solved.record.gap[lane] + shift,
            u_n, solved.record.restitution[lane], step);
        const double spring = solved.record.spring[lane], w = solved.record.inverse_mass_sum[lane];
        const double square = handed_on<double>(kappa, solved.record.stored[lane], u_n, along, spring, w, step);
        const double share = step.elastic ? share_of_carried<double>(spring, w, step) : 1.0;
        CHECK(own.compression == Approx(static_cast<float>(std::sqrt(share * square))));
        CHECK((own.compression > 0.0F) ==
              (is_loaded ? kappa > touching_gap * step.min_diameter : solved.record.stored[lane] > 0.0F));
        stored += energy_of_square<double>(square, spring, w, step);
        pushed += static_cast<double>(solved.record.push[lane]) * along;
    }
    const auto sum = [](const double(&lanes)[pack_size]) { return std::accumulate(lanes, lanes + pack_size, 0.0); };
    CHECK(*std::ranges::max_element(left.cone_violation) == Approx(worst).margin(1e-18));
    CHECK(sum(left.stored_energy) == Approx(stored).margin(1e-20));
    CHECK(sum(left.push_out_energy) == Approx(pushed).margin(1e-20));
}

TEST_CASE("a touch across the border of a cell is that of the nearest image", "[packed_touch][periodic]")
{
    Touches direct(7), across = direct;
    across.step.is_periodic = true;
    across.step.cell_length[1] = 2.5;
    for (std::size_t s = 1; s < across.places.size(); s += 2) across.places[s].center[1] += s % 4 == 1 ? 2.5 : -2.5;
    for (Touches* touches : {&direct, &across}) touches->touch(fastest_kernels());
    for (int lane = 0; lane + 1 < pack_size; ++lane) {
        CHECK(across.record.gap[lane] == Approx(direct.record.gap[lane]).margin(1e-15));
        for (int d = 0; d < 3; ++d)
            CHECK(across.contact.normal[d][lane] == Approx(direct.contact.normal[d][lane]).margin(1e-13));
    }
}

} // namespace talus::test
