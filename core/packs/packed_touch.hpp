// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/packs/kernels.hpp"
#include "core/packs/numbers.hpp"

/// Detection between spheres, and the laws of all contacts, METHOD (4), `width` at a time.
namespace talus::packs
{

/// Records of four numbers, number beside number.
template <int width>
[[gnu::always_inline]] inline void gather_four(Numbers<width>* numbers, const double* const* records)
{
    constexpr auto lanes = std::make_integer_sequence<int, width>{};
    if constexpr (width == 2) {
        for (int block = 0; block < 4; block += width) {
            for (int lane = 0; lane < width; ++lane) numbers[block + lane] = load<width>(records[lane] + block);
            transpose<width>(numbers + block);
        }
    } else {
        for (int row = 0; row < 4; ++row) {
            if constexpr (width == 8)
                numbers[row] =
                    __builtin_shufflevector(load<4>(records[row]), load<4>(records[row + 4]), 0, 1, 2, 3, 4, 5, 6, 7);
            else
                numbers[row] = load<width>(records[row]);
        }
        exchange<width, 2>(numbers[0], numbers[2], lanes);
        exchange<width, 2>(numbers[1], numbers[3], lanes);
        exchange<width, 1>(numbers[0], numbers[1], lanes);
        exchange<width, 1>(numbers[2], numbers[3], lanes);
    }
}

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
std::size_t find_near(const std::int32_t* pairs, const std::uint8_t* loaded, std::uint32_t first, std::uint32_t last,
    const ReachBall* balls, const StepConstants& step, std::uint32_t* near)
{
    std::size_t count = 0;
    for (std::uint32_t k = first; k < last; k += width) {
        const int pairs_left = last - k < width ? static_cast<int>(last - k) : width;
        std::int32_t a[width], b[width];
        for (int lane = 0; lane < width; ++lane) {
            const std::uint32_t pair = lane < pairs_left ? k + static_cast<std::uint32_t>(lane) : k;
            a[lane] = pairs[2 * pair];
            b[lane] = pairs[2 * pair + 1];
        }
        const Balls<width> ball_a(a, balls), ball_b(b, balls);
        const Vector<width> apart = across<width>(ball_a, ball_b, step);
        const Numbers<width> radii = ball_a.radius + ball_b.radius;
        const Flags<width> meet = apart.dot(apart) <= radii * radii;
        for (int lane = 0; lane < pairs_left; ++lane) {
            near[count] = k + static_cast<std::uint32_t>(lane); // no branch: which are near is no pattern
            count += static_cast<std::size_t>((meet[lane] != 0) | (loaded[k + lane] != 0));
        }
    }
    return count;
}

/// How the spheres a and b of these touches lie to each other and move.
template <int width>
[[gnu::always_inline]] inline void detect(
    TouchPack& touch, int first, const ReachBall* balls, const double* motion, const StepConstants& step)
{
    ContactPack& contact = touch.contact;
    const double *motion_a[width], *motion_b[width];
    for (int lane = 0; lane < width; ++lane) {
        motion_a[lane] = motion + std::int64_t{pack_size} * contact.a[first + lane];
        motion_b[lane] = motion + std::int64_t{pack_size} * contact.b[first + lane];
    }
    Numbers<width> a[pack_size], b[pack_size];
    gather<width>(a, motion_a);
    gather<width>(b, motion_b);
    const Vector<width> apart =
        across<width>(Balls<width>(contact.a + first, balls), Balls<width>(contact.b + first, balls), step);
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
    store<width>(touch.within_reach + first, within);
    if (step.restitution)
        store<width>(touch.closes + first, closing_time<Numbers<width>>(-apart.dot(velocity), velocity.dot(velocity),
                                               square - radii * radii, root<width>));
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
[[gnu::always_inline]] inline N stored_energy(const N& gap, const NormalLaw<N>& law, const StepConstants& step)
{
    if (step.law.rigid) return N{};
    const auto is_spring = (gap < 0.0) & (law.compliance > 0.0);
    const N compliance = is_spring ? law.compliance : N{} + 1.0;
    const N energy = spring_energy<N>(gap, compliance, step.law.h) * law.feedback_share;
    return is_spring ? energy : N{};
}

/// Notes what does not close by itself, or opens. What an impact elsewhere closes within this step is an impact of its
/// own in the next one: such a contact waits beside one. Spheres that touch without a load count as apart. In a split
/// step nothing waits: walls must hold what is thrown at them. And spheres that miss each other: the law of their gap
/// along the normal of now would brake them.
/// @param is_free no impact, and it bears nothing
template <int width>
[[gnu::always_inline]] inline void leave_out(
    TouchPack& touch, int first, const Numbers<width>& closes, const Flags<width>& is_free, const StepConstants& step)
{
    const Numbers<width> gap = load<width>(touch.gap + first), none = {};
    const Numbers<width> at_end = gap + step.law.h * load<width>(touch.u_n_ahead + first);
    const Flags<width> misses = (gap > 0.0) & (closes >= none + step.law.h);
    const Flags<width> apart = misses | ((gap <= 0.0) & (at_end >= none - step.touching));
    const Flags<width> may = step.law.parts > 1.0 ? Flags<width>{} : is_free;
    store<width>(touch.waits + first, may & apart);
    store<width>(touch.passes_by + first, may & misses & (at_end < 0.0));
}

/// The law of these touches, and the numbers of their contacts' solve.
template <int width>
[[gnu::always_inline]] inline void apply_law(TouchPack& touch, int first, const StepConstants& step)
{
    using N = Numbers<width>;
    using F = Flags<width>;
    ContactPack& contact = touch.contact;
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
    const N left = free_overlap<N>(gap, number(touch.free_overlap), loaded);
    const N unsprung = (rests & (restitution > 0.0)) ? left : none;
    const N spring = gap + unsprung;
    const auto law = normal_law<N>(
        {impact, is_open, spring, impact ? u_n : number(touch.u_n_before), w, warm.dot(normal), restitution,
            number(touch.stiffness), load_flags<width>(touch.jammed + first), number(touch.u_n_turned)},
        step.law);

    warm.store(contact.impulse, first);
    const N arm_scale = number(contact.arm_scale);
    store<width>(contact.target + first, law.target);
    store<width>(contact.compliance + first, law.compliance);
    store<width>(contact.normal_mass + first, 1.0 / (w + law.compliance));
    store<width>(contact.tangent_mass + first, 1.0 / (w * (1.0 + step.inverse_inertia * arm_scale * arm_scale)));
    store<width>(touch.free_overlap + first, unsprung);
    store<width>(touch.impact + first, impact);
    store<width>(touch.open + first, is_open);
    store<width>(touch.carries + first, warm.dot(normal) > 0.0);

    const F bears = (restitution == 0.0) | loaded; // what an impact overlaps is no spring
    store<width>(touch.stored_energy + first, bears ? stored_energy<N>(spring, law, step) : none);
    leave_out<width>(touch, first, closes, (!impact) & (!bears), step);
}

template <int width> void make_contacts(TouchPack& touch, const StepConstants& step)
{
    for (int first = 0; first < pack_size; first += width) apply_law<width>(touch, first, step);
}

template <int width>
void touch_spheres(TouchPack& touch, const ReachBall* balls, const double* motion, const StepConstants& step)
{
    for (int first = 0; first < pack_size; first += width) {
        detect<width>(touch, first, balls, motion, step);
        apply_law<width>(touch, first, step);
    }
}

template <int width> constexpr TouchKernel touches()
{
    return {find_near<width>, touch_spheres<width>, make_contacts<width>};
}

} // namespace talus::packs
