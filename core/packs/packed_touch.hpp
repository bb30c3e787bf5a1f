// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/packs/kernels.hpp"
#include "core/packs/numbers.hpp"
#include "core/packs/packed_slots.hpp"

/// Detection between spheres, and the laws of all contacts, METHOD (4), `width` at a time.
namespace talus::packs
{

/// Balls by sphere, number beside number.
template <int width> struct Balls {
    Vector<width> center;
    Numbers<width> radius;

    [[gnu::always_inline]] Balls(const std::int32_t* sphere, const ReachBall* balls)
    {
        const double* records[width];
        for (int lane = 0; lane < width; ++lane) records[lane] = balls[sphere[lane]].center;
        Numbers<width> numbers[4];
        gather_four<width>(numbers, records);
        center = {numbers[0], numbers[1], numbers[2]};
        radius = numbers[3];
    }
};

/// The shortest of a difference of positions and its images.
template <int width>
[[gnu::always_inline]] inline Numbers<width> nearest_image(const Numbers<width>& across, double cell)
{
    const Numbers<width> once = across > 0.5 * cell ? across - cell : across;
    return once < -0.5 * cell ? once + cell : once;
}

template <int width>
[[gnu::always_inline]] inline Vector<width> across(
    const Balls<width>& a, const Balls<width>& b, const StepConstants& step)
{
    const Vector<width> direct = a.center - b.center;
    if (!step.is_periodic) return direct;
    return {nearest_image<width>(direct.x, step.cell_length[0]), nearest_image<width>(direct.y, step.cell_length[1]),
        nearest_image<width>(direct.z, step.cell_length[2])};
}

template <int width>
std::size_t find_near(const std::int32_t* pairs, std::uint32_t candidates, const SphereNumbers& spheres,
    const StepConstants& step, std::uint32_t* near)
{
    std::size_t count = 0;
    for (std::uint32_t k = 0; k < candidates; k += width) {
        const int pairs_left = candidates - k < width ? static_cast<int>(candidates - k) : width;
        std::int32_t a[width], b[width];
        for (int lane = 0; lane < width; ++lane) {
            const std::uint32_t pair = lane < pairs_left ? k + static_cast<std::uint32_t>(lane) : k;
            a[lane] = pairs[2 * pair];
            b[lane] = pairs[2 * pair + 1];
        }
        const Balls<width> ball_a(a, spheres.balls), ball_b(b, spheres.balls);
        const Vector<width> apart = across<width>(ball_a, ball_b, step);
        const Numbers<width> radii = ball_a.radius + ball_b.radius;
        const Flags<width> meet = apart.dot(apart) <= radii * radii;
        for (int lane = 0; lane < pairs_left; ++lane) {
            near[count] = k + static_cast<std::uint32_t>(lane); // no branch: which are near is no pattern
            const bool loaded = CarriedRecords<width>::is_known(spheres.carried, k + static_cast<std::uint32_t>(lane));
            count += static_cast<std::size_t>((meet[lane] != 0) | loaded);
        }
    }
    return count;
}

/// How the spheres a and b of these touches lie to each other and move. Returns which are within reach.
template <int width>
[[gnu::always_inline]] inline Flags<width> detect(ContactPack& contact, TouchPack& touch, int first,
    const ReachBall* balls, const double* motion, const StepConstants& step)
{
    std::int32_t sphere_a[width], sphere_b[width];
    const double *motion_a[width], *motion_b[width];
    Flags<width> empty = {};
    for (int lane = 0; lane < width; ++lane) {
        const bool is_empty = contact.a[first + lane] < 0;
        sphere_a[lane] = is_empty ? 0 : contact.a[first + lane];
        sphere_b[lane] = is_empty ? 0 : contact.b[first + lane];
        motion_a[lane] = motion + std::int64_t{pack_size} * sphere_a[lane];
        motion_b[lane] = motion + std::int64_t{pack_size} * sphere_b[lane];
        empty[lane] = -static_cast<std::int64_t>(is_empty);
    }
    Numbers<width> a[pack_size], b[pack_size];
    gather<width>(a, motion_a);
    gather<width>(b, motion_b);
    const Vector<width> apart = across<width>(Balls<width>(sphere_a, balls), Balls<width>(sphere_b, balls), step);
    const Vector<width> velocity{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    const Numbers<width> radii = a[7] + b[7], one = radii * 0.0 + 1.0;
    const Numbers<width> square = apart.dot(apart), distance = root<width>(square);
    // Spheres with one centre are pushed apart along a fixed direction: any will do, but always the same.
    const Flags<width> separate = distance > 0.0;
    const Numbers<width> divisor = separate ? distance : one;
    const Vector<width> normal{apart.x / divisor, apart.y / divisor, separate ? apart.z / divisor : one};
    const Numbers<width> gap = distance - radii, u_n = normal.dot(velocity);
    const Flags<width> within = (gap <= step.reach) | (gap + step.horizon * u_n <= 0.0);
    normal.store(contact.normal, first);
    store<width>(contact.arm_scale + first, distance / radii);
    store<width>(contact.inverse_mass_sum + first, a[3] + b[3]);
    store<width>(touch.gap + first, gap);
    store<width>(touch.u_n + first, u_n);
    store<width>(touch.u_n_ahead + first, u_n); // gravity is the same for both
    store<width>(touch.u_n_before + first, u_n);
    store<width>(touch.u_n_turned + first, Numbers<width>{}); // they are convex: it parts them
    if (step.restitution)
        store<width>(touch.closes + first, closing_time<Numbers<width>>(-apart.dot(velocity), velocity.dot(velocity),
                                               square - radii * radii, root<width>));
    return within & ~empty;
}

/// The impulse carried into a contact: turned into the new frame and cut back to the cone, nothing for an impact.
template <int width>
[[gnu::always_inline]] inline Vector<width> warm_impulse(const Vector<width>& carried, const Vector<width>& normal,
    const Numbers<width>& friction, const Flags<width>& impact)
{
    const Numbers<width> along = carried.dot(normal), normal_impulse = larger<Numbers<width>>(Numbers<width>{}, along);
    Vector<width> tangent = carried - normal * along;
    const Numbers<width> largest = friction * normal_impulse, square = tangent.dot(tangent);
    const Flags<width> outside = square > largest * largest;
    if (any<width>(outside)) {
        const Numbers<width> one = square * 0.0 + 1.0;
        tangent = tangent * (outside ? largest / root<width>(outside ? square : one) : one);
    }
    const Vector<width> warm = normal * normal_impulse + tangent;
    const Numbers<width> none = {};
    return {impact ? none : warm.x, impact ? none : warm.y, impact ? none : warm.z};
}

/// With k = 4 Υ / (Σ_n h²), the stiffness that the compliance stands for [J].
template <class N>
[[gnu::always_inline]] inline N stored_energy(const N& kappa, const NormalLaw<N>& law, const StepConstants& step)
{
    if (step.law.rigid) return N{};
    const auto is_spring = (kappa > 0.0) & (law.compliance > 0.0);
    const N compliance = is_spring ? law.compliance : N{} + 1.0;
    const N energy = spring_energy<N>(kappa, compliance, step.law.h) * law.feedback_share;
    return is_spring ? energy : N{};
}

/// Notes what does not close by itself, or opens. What an impact elsewhere closes within this step is an impact of its
/// own in the next one: such a contact waits beside one. Spheres that touch without a load count as apart. In a split
/// step nothing waits: walls must hold what is thrown at them. Left out at once are spheres that miss each other: the
/// law of their gap along the normal of now would brake them.
/// @param is_free no impact, has restitution, and was not loaded
/// Returns what is left out at once.
template <int width>
[[gnu::always_inline]] inline Flags<width> leave_out(
    TouchPack& touch, int first, const Numbers<width>& closes, const Flags<width>& is_free, const StepConstants& step)
{
    const Numbers<width> gap = load<width>(touch.gap + first), none = {};
    const Numbers<width> at_end = gap + step.law.h * load<width>(touch.u_n_ahead + first);
    const Flags<width> misses = (gap > 0.0) & (closes >= none + step.law.h);
    const Flags<width> apart = misses | ((gap <= 0.0) & (at_end >= none - step.touching));
    const Flags<width> may = step.law.parts > 1.0 ? Flags<width>{} : is_free;
    store<width>(touch.waits + first, may & apart);
    return may & misses & (at_end < 0.0);
}

/// The law of these touches, and the numbers of their contacts' solve: zeros for those that are left out.
template <int width>
[[gnu::always_inline]] inline void apply_law(
    ContactPack& contact, TouchPack& touch, int first, const Flags<width>& within_reach, const StepConstants& step)
{
    using N = Numbers<width>;
    using F = Flags<width>;
    const N none = {};
    const auto number = [&](const double* row) __attribute__((always_inline))
    {
        return load<width>(row + first);
    };
    const N gap = number(touch.gap), restitution = number(touch.restitution), u_n = number(touch.u_n);
    const N closes = step.restitution ? number(touch.closes) : none, w = number(contact.inverse_mass_sum);
    const F loaded = load_flags<width>(touch.loaded + first);
    const Vector<width> normal = Vector<width>::load(contact.normal, first);

    const F impact = step.restitution ? is_impact<N>(gap, u_n, closes, loaded, restitution, step.law) : F{};
    const F is_open = (!impact) & (gap > 0.0), rests = (!impact) & (gap <= 0.0);
    const N friction = number(contact.friction);
    const Vector<width> warm = warm_impulse<width>(Vector<width>::load(touch.carried, first), normal, friction, impact);
    const N u_n_before = number(touch.u_n_before);
    const F jammed = load_flags<width>(touch.jammed + first);
    const N kappa = jammed ? none : compression<N>(gap, number(touch.compression), u_n_before, loaded, step.law);
    const auto law = normal_law<N>({impact, is_open, rests & ~jammed ? -kappa : gap, impact ? u_n : u_n_before, w,
                                       restitution, number(touch.stiffness), jammed, number(touch.u_n_turned)},
        step.law);

    const F is_free = (!impact) & (restitution > 0.0) & (!loaded);
    const F in_problem = within_reach & ~leave_out<width>(touch, first, closes, is_free, step);
    const auto put = [&](double* row, const N& numbers) __attribute__((always_inline))
    {
        store<width>(row + first, in_problem ? numbers : none);
    };
    put(contact.impulse[0], warm.x);
    put(contact.impulse[1], warm.y);
    put(contact.impulse[2], warm.z);
    const N arm_scale = number(contact.arm_scale);
    put(contact.target, law.target);
    put(contact.compliance, law.compliance);
    put(contact.normal_mass, 1.0 / (w + law.compliance));
    put(contact.tangent_mass, 1.0 / (w * (1.0 + step.inverse_inertia * arm_scale * arm_scale)));
    put(contact.inverse_mass_sum, w);
    put(touch.stored_energy, rests ? stored_energy<N>(kappa, law, step) : none);
    store<width>(touch.compression + first, kappa);
    store<width>(touch.in_problem + first, in_problem);
    store<width>(touch.impact + first, impact);
    store<width>(touch.open + first, is_open);
    store<width>(touch.carries + first, warm.dot(normal) > 0.0);
}

template <int width> void make_contacts(ContactPack& contact, TouchPack& touch, const StepConstants& step)
{
    for (int first = 0; first < pack_size; first += width)
        apply_law<width>(contact, touch, first, ~Flags<width>{}, step);
}

/// What the spheres' materials and slots say of these touches.
template <int width>
[[gnu::always_inline]] inline void recall(ContactPack& contact, TouchPack& touch, RecordPack& record, int first,
    const SphereNumbers& spheres, const StepConstants& step)
{
    const double* laws[width];
    std::uint32_t slot[width];
    for (int lane = 0; lane < width; ++lane) {
        const bool is_empty = contact.a[first + lane] < 0;
        const std::int32_t a = is_empty ? 0 : contact.a[first + lane], b = is_empty ? 0 : contact.b[first + lane];
        laws[lane] = spheres.laws + 4 * (spheres.material[a] * spheres.materials + spheres.material[b]);
        slot[lane] = is_empty ? record.slot[0] : record.slot[first + lane];
    }
    Numbers<width> law[4];
    gather_four<width>(law, laws);
    store<width>(contact.friction + first, law[0]);
    store<width>(touch.restitution + first, law[1]);
    store<width>(touch.stiffness + first, law[3]);
    const auto carried = CarriedRecords<width>::gather(slot, spheres.carried);
    carried.impulse.store(touch.carried, first);
    store<width>(touch.compression + first, carried.compression);
    store<width>(touch.loaded + first, carried.touch > std::int64_t{0});
    store<width>(touch.jammed + first, carried.touch > std::int64_t{step.jam_steps});
    narrow<width>(record.touch + first, carried.touch);
}

/// Notes what has become of these touches, those within reach.
template <int width>
[[gnu::always_inline]] inline void take_down(
    RecordPack& record, TouchSums& sums, const TouchPack& touch, int first, const Flags<width>& within_reach)
{
    const Numbers<width> gap = load<width>(touch.gap + first), none = {};
    const Flags<width> impact = load_flags<width>(touch.impact + first), open = load_flags<width>(touch.open + first);
    const Flags<width> in_problem = load_flags<width>(touch.in_problem + first);
    const Flags<width> overlaps = within_reach & (gap < 0.0);
    const auto add = [&](double* sum, const Numbers<width>& part) __attribute__((always_inline))
    {
        store<width>(sum + first, load<width>(sum + first) + part);
    };
    add(sums.overlap, overlaps ? -gap : none);
    add(sums.stored_energy, load<width>(touch.stored_energy + first));
    const Numbers<width> worst = load<width>(sums.worst_overlap + first);
    store<width>(sums.worst_overlap + first, larger<Numbers<width>>(worst, overlaps ? -gap : none));
    store<width>(sums.overlapping + first, load_flags<width>(sums.overlapping + first) - overlaps);

    store<width>(record.gap + first, gap);
    store_floats<width>(record.compression + first, load<width>(touch.compression + first));
    narrow<width>(reinterpret_cast<std::uint8_t*>(record.kind) + first, in_problem & ((impact & 2) | (open & 1)));
    narrow<width>(record.touch + first, within_reach & widened<width>(record.touch + first));
    record.in_problem |= static_cast<std::uint8_t>(bits<width>(in_problem) << first);
    record.waits |=
        static_cast<std::uint8_t>(bits<width>(in_problem & load_flags<width>(touch.waits + first)) << first);
}

template <int width>
TouchMarks touch_spheres(
    ContactPack& contact, RecordPack& record, TouchSums& sums, const SphereNumbers& spheres, const StepConstants& step)
{
    TouchPack touch;
    TouchMarks marks;
    record.in_problem = record.waits = 0;
#pragma GCC unroll 4
    for (int first = 0; first < pack_size; first += width) {
        recall<width>(contact, touch, record, first, spheres, step);
        const Flags<width> within_reach = detect<width>(contact, touch, first, spheres.balls, spheres.motion, step);
        apply_law<width>(contact, touch, first, within_reach, step);
        take_down<width>(record, sums, touch, first, within_reach);
        const Flags<width> in_problem = load_flags<width>(touch.in_problem + first);
        marks.impact |= bits<width>(in_problem & load_flags<width>(touch.impact + first)) << first;
        marks.carries |= bits<width>(in_problem & load_flags<width>(touch.carries + first)) << first;
    }
    return marks;
}

template <int width>
double hand_on(const ContactPack& contact, RecordPack& record, double deep, unsigned& deep_lanes, double* carried)
{
    double worst = 0.0;
    deep_lanes = 0;
#pragma GCC unroll 4
    for (int first = 0; first < pack_size; first += width) {
        const Vector<width> normal = Vector<width>::load(contact.normal, first);
        const Vector<width> impulse = Vector<width>::load(contact.impulse, first);
        const Numbers<width> along = impulse.dot(normal), none = {};
        const Vector<width> tangent = impulse - normal * along;
        const Numbers<width> excess = root<width>(tangent.dot(tangent)) - load<width>(contact.friction + first) * along;
        for (int lane = 0; lane < width; ++lane) worst = worst < excess[lane] ? excess[lane] : worst;

        const Flags<width> kind = widened<width>(reinterpret_cast<const std::uint8_t*>(record.kind) + first);
        const Flags<width> keeps = kind != std::int64_t{2}; // an impact hands nothing on
        const Flags<width> is_deep = -load<width>(record.gap + first) > none + deep;
        const Flags<width> loaded = keeps & (along > 0.0) & 1;
        const Flags<width> touch = is_deep ? widened<width>(record.touch + first) : loaded;
        narrow<width>(record.touch + first, touch);
        deep_lanes |= bits<width>(is_deep) << first;

        typename Register<width>::Floats kappa;
        __builtin_memcpy(&kappa, record.compression + first, sizeof kappa);
        const CarriedRecords<width> carries{
            {keeps ? impulse.x : none, keeps ? impulse.y : none, keeps ? impulse.z : none},
            __builtin_convertvector(kappa, Numbers<width>), touch};
        double* records[width];
        for (int lane = 0; lane < width; ++lane)
            records[lane] =
                contact.a[first + lane] < 0 ? nullptr : carried + std::size_t{4} * record.slot[first + lane];
        carries.scatter(records);
    }
    deep_lanes &= record.in_problem;
    return worst;
}

template <int width> constexpr TouchKernel touches()
{
    return {find_near<width>, touch_spheres<width>, make_contacts<width>, hand_on<width>};
}

} // namespace talus::packs
