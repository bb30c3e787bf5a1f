// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/law/coulomb.hpp"
#include "core/law/hertz.hpp"
#include "core/law/touch_record.hpp"
#include "core/packs/kernels.hpp"
#include "core/packs/numbers.hpp"
#include "core/packs/packed_slots.hpp"

/// Detection between spheres, and the laws of all contacts, METHOD (4), `width` at a time.
namespace talus::packs
{

/// The first `count` numbers of the places of spheres, number beside number.
template <int width, int count> struct Places {
    Numbers<width> number[count];

    [[gnu::always_inline]] Places(const std::int32_t* sphere, const SpherePlace* places)
    {
        const double* records[width];
        for (int lane = 0; lane < width; ++lane) records[lane] = places[sphere[lane]].center;
        gather<width>(number, records);
    }
    [[gnu::always_inline]] Vector<width> center() const { return {number[0], number[1], number[2]}; }
    [[gnu::always_inline]] const Numbers<width>& radius() const { return number[3]; }
    [[gnu::always_inline]] Vector<width> velocity() const { return {number[4], number[5], number[6]}; }
    [[gnu::always_inline]] const Numbers<width>& inverse_mass() const { return number[7]; }
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
    const Vector<width>& a, const Vector<width>& b, const StepConstants& step)
{
    const Vector<width> direct = a - b;
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
        Numbers<width> reaches;
        for (int lane = 0; lane < width; ++lane) {
            const std::uint32_t pair = lane < pairs_left ? k + static_cast<std::uint32_t>(lane) : k;
            a[lane] = pairs[2 * pair];
            b[lane] = pairs[2 * pair + 1];
            reaches[lane] = spheres.reaches[a[lane]] + spheres.reaches[b[lane]];
        }
        const Places<width, 4> place_a(a, spheres.places), place_b(b, spheres.places);
        const Vector<width> apart = across<width>(place_a.center(), place_b.center(), step);
        const Flags<width> meet = apart.dot(apart) <= reaches * reaches;
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
[[gnu::always_inline]] inline Flags<width> detect(
    ContactPack& contact, TouchPack& touch, int first, const SpherePlace* places, const StepConstants& step)
{
    std::int32_t sphere_a[width], sphere_b[width];
    Flags<width> empty = {};
    for (int lane = 0; lane < width; ++lane) {
        const bool is_empty = contact.a[first + lane] < 0;
        sphere_a[lane] = is_empty ? 0 : contact.a[first + lane];
        sphere_b[lane] = is_empty ? 0 : contact.b[first + lane];
        empty[lane] = -static_cast<std::int64_t>(is_empty);
    }
    const Places<width, 8> a(sphere_a, places), b(sphere_b, places);
    const Vector<width> apart = across<width>(a.center(), b.center(), step), velocity = a.velocity() - b.velocity();
    const Numbers<width> radii = a.radius() + b.radius(), none = {}, one = none + 1.0;
    const Numbers<width> square = apart.dot(apart), distance = root<Numbers<width>>(square);

    // A gap is laid where the spheres' free paths close it, or come nearest in this step.
    const Numbers<width> approach = -apart.dot(velocity), speed_squared = velocity.dot(velocity);
    const Numbers<width> closes = closing_time<Numbers<width>>(approach, speed_squared, square - radii * radii);
    const Numbers<width> nearest =
        smaller<Numbers<width>>(none + step.law.h, approach / (speed_squared > 0.0 ? speed_squared : one));
    const Flags<width> touching = touches<Numbers<width>>(distance - radii, step.law),
                       ahead = (!touching) & (approach > 0.0);
    const Numbers<width> instant = ahead ? smaller<Numbers<width>>(closes, nearest) : none;
    const Vector<width> then = apart.plus(velocity, instant);
    const Numbers<width> distance_then = root<Numbers<width>>(then.dot(then));
    // Spheres with one centre are pushed apart along a fixed direction: any will do, but always the same.
    const Flags<width> separate = distance_then > 0.0;
    const Numbers<width> inverse = one / (separate ? distance_then : one), per_radii = one / radii;
    const Vector<width> normal{then.x * inverse, then.y * inverse, separate ? then.z * inverse : one};
    const Numbers<width> gap = (ahead ? normal.dot(apart) : distance) - radii, u_n = normal.dot(velocity);
    const Flags<width> within = (gap <= step.reach) | (gap + step.horizon * u_n <= 0.0);
    normal.store(contact.normal, first);
    store<width>(contact.arm_scale + first, distance_then * per_radii);
    store<width>(touch.inverse_mass_sum + first, a.inverse_mass() + b.inverse_mass());
    store<width>(touch.gap + first, gap);
    store<width>(touch.diameter + first, 2.0 * smaller<Numbers<width>>(a.radius(), b.radius()));
    store<width>(touch.reduced_radius + first, a.radius() * b.radius() * per_radii);
    store<width>(touch.u_n + first, u_n); // gravity is the same for both
    store<width>(touch.u_n_before + first, u_n);
    store<width>(touch.closes + first, closes);
    return within & ~empty;
}

/// The impulse carried into a contact: turned into the new frame and cut back to the cone, nothing for an impact.
template <int width>
[[gnu::always_inline]] inline Vector<width> warm_impulse(const Vector<width>& carried, const Vector<width>& normal,
    const Numbers<width>& friction, const Flags<width>& impact)
{
    const Numbers<width> along = carried.dot(normal), normal_impulse = larger<Numbers<width>>(Numbers<width>{}, along);
    Vector<width> tangent = carried.plus(normal, -along);
    cut_to_disk<Numbers<width>>(tangent, friction * normal_impulse);
    const Vector<width> warm = tangent.plus(normal, normal_impulse);
    const Numbers<width> none = {};
    return {impact ? none : warm.x, impact ? none : warm.y, impact ? none : warm.z};
}

/// What the laws of these touches depend on, but for their springs. @param along the normal impulse that they carry
template <int width>
[[gnu::always_inline]] inline ContactEvent<Numbers<width>> event_without_spring(
    const TouchPack& touch, int first, const Numbers<width>& along, const StepConstants& step)
{
    using N = Numbers<width>;
    const auto number = [&](const double* row) __attribute__((always_inline))
    {
        return load<width>(row + first);
    };
    const Flags<width> pushed = load_flags<width>(touch.pushed + first);
    return {number(touch.gap), number(touch.diameter), number(touch.reduced_radius), number(touch.u_n),
        number(touch.u_n_before), number(touch.closes), number(touch.inverse_mass_sum), number(touch.restitution),
        number(touch.stiffness), pushed ? N{} : larger<N>(N{}, along) * step.law.parts, N{},
        load_flags<width>(touch.struck + first)};
}

/// Where materials have moduli: makes the springs of these touches, of what they have handed on.
template <int width>
[[gnu::noinline]] void make_springs(TouchPack& touch, int first, const Numbers<width>& along, const StepConstants& step)
{
    using N = Numbers<width>;
    const auto spring = spring_of_step<N>(load<width>(touch.compression + first), along > 0.0,
        event_without_spring<width>(touch, first, along, step), load<width>(touch.modulus + first), step.law);
    store<width>(touch.stiffness + first, spring.stiffness);
    store<width>(touch.compression + first, spring.compression);
    store<width>(touch.shift + first, spring.shift);
    store<width>(touch.full_shift + first, spring.full_shift);
}

/// What the laws of these touches depend on.
template <int width>
[[gnu::always_inline]] inline ContactEvent<Numbers<width>> event_of(
    TouchPack& touch, int first, const Numbers<width>& along, const StepConstants& step)
{
    using N = Numbers<width>;
    if (step.law.elastic) make_springs<width>(touch, first, along, step);
    ContactEvent<N> event = event_without_spring<width>(touch, first, along, step);
    const N w = event.inverse_mass_sum, spring = spring_compliance<N>(event.stiffness, w, step.law);
    const N handed = load<width>(touch.compression + first);
    const N taken =
        taken_over<N>(handed, along > 0.0, event.gap, event.u_n_before, event.restitution, spring, w, step.law);
    // Made already, or now: a choice, since GCC 12 fails on a branch here where registers hold two numbers.
    event.compression = load<width>(touch.modulus + first) > 0.0 ? handed : taken;
    event.shift = load<width>(touch.shift + first);
    event.full_shift = load<width>(touch.full_shift + first);
    return event;
}

/// What the springs of these touches hold, and what pushing out has put into them: nothing for those that keep none.
/// What was not stored before is pushed in; what yields gives up of its spring, it does in this step.
template <int width>
[[gnu::always_inline]] inline void note_springs(TouchPack& touch, int first, const ContactEvent<Numbers<width>>& event,
    const NormalLaw<Numbers<width>>& law, const Flags<width>& keeps, const Flags<width>& yields, const LawOfStep& step)
{
    using N = Numbers<width>;
    const N none = {}, w = event.inverse_mass_sum, spring = spring_compliance<N>(event.stiffness, w, step);
    const Flags<width> stored = keeps & (event.compression > none + touching_gap * step.min_diameter);
    const N u_stored = stored ? event.u_n_before : none;
    const N borne = yields ? 0.5 * step.h * smaller<N>(none, event.u_n_before) : none;
    const N kappa = law.compression - borne, pressed = stored ? kappa - law.grown : none;
    const N square = spring_square<N>(kappa, u_stored, spring, w, step);
    const N square_before = spring_square<N>(pressed, u_stored, spring, w, step);
    const N energy_of_one = energy_of_square<N>(none + 1.0, spring, w, step);
    store<width>(touch.stored_energy + first, keeps ? energy_of_one * square : none);
    store<width>(touch.push_out_energy + first, keeps ? energy_of_one * (square - square_before) : none);
    store<width>(touch.stored + first, keeps ? square_before : none);
    store<width>(touch.spring + first, spring);
    store<width>(touch.compression + first, law.compression);
}

/// The law of these touches, and the numbers of their contacts' solve: zeros for those that are out of reach.
template <int width>
[[gnu::always_inline]] inline void apply_law(
    ContactPack& contact, TouchPack& touch, int first, const Flags<width>& within_reach, const StepConstants& step)
{
    using N = Numbers<width>;
    using F = Flags<width>;
    const N none = {};
    const Vector<width> normal = Vector<width>::load(contact.normal, first);
    const Vector<width> carried = Vector<width>::load(touch.carried, first);
    const ContactEvent<N> event = event_of<width>(touch, first, carried.dot(normal), step);
    const N w = event.inverse_mass_sum, arm_scale = load<width>(contact.arm_scale + first);
    const F strikes = is_impact<N>(event, step.law), impact = strikes & within_reach,
            open = !touches<N>(event.gap, step.law);
    const F strained = overstrained<N>(event, step.law), yields = strained & ~impact;
    const NormalLaw<N> law = normal_law<N>(event, impact, step.law);
    const Vector<width> warm = warm_impulse<width>(carried, normal, load<width>(contact.friction + first), impact);

    const auto put = [&](double* row, const N& numbers) __attribute__((always_inline))
    {
        store<width>(row + first, within_reach ? numbers : none);
    };
    put(contact.impulse[0], warm.x);
    put(contact.impulse[1], warm.y);
    put(contact.impulse[2], warm.z);
    put(contact.target, law.target);
    put(touch.compliance, law.compliance);
    put(contact.parting, law.parting);
    const N softer = w + law.compliance, turning = w * (1.0 + step.inverse_inertia_factor * arm_scale * arm_scale);
    const N of_both = 1.0 / (softer * turning); // divisions are dear
    put(contact.normal_mass, turning * of_both);
    put(contact.tangent_mass, softer * of_both);

    note_springs<width>(touch, first, event, law, within_reach & (law.compression > none), yields, step.law);
    put(touch.push, law.push);
    put(touch.strain, strained ? -event.gap / elastic_overlap<N>(event, step.law) : none);
    put(touch.impact_size, any_of(impact) ? (impact ? impact_size<N>(event) : none) : none);
    const auto kind = [](ContactKind which) { return F{} + static_cast<std::int64_t>(which); };
    store<width>(
        touch.kind + first, impact ? kind(ContactKind::impact)
                                   : (open ? kind(ContactKind::open) : (yields ? kind(ContactKind::yielding) : F{})));
}

/// What the spheres' materials and slots say of these touches.
template <int width>
[[gnu::always_inline]] inline void recall(ContactPack& contact, TouchPack& touch, RecordPack& record, int first,
    const SphereNumbers& spheres, const LawOfStep& step)
{
    const double* laws[width];
    std::uint32_t slot[width];
    for (int lane = 0; lane < width; ++lane) {
        const bool is_empty = contact.a[first + lane] < 0;
        const std::int32_t a = is_empty ? 0 : contact.a[first + lane], b = is_empty ? 0 : contact.b[first + lane];
        laws[lane] = spheres.laws + 8 * (spheres.material[a] * spheres.materials + spheres.material[b]);
        slot[lane] = is_empty ? record.slot[0] : record.slot[first + lane];
    }
    Numbers<width> law[4];
    gather<width>(law, laws);
    store<width>(contact.friction + first, law[0]);
    store<width>(touch.restitution + first, law[1]);
    store<width>(touch.stiffness + first, law[3]);
    if (step.elastic) {
        for (const double*& record_of_pair : laws) record_of_pair += 4;
        gather<width>(law, laws);
        store<width>(touch.modulus + first, law[1]);
    }
    const auto carried = CarriedRecords<width>::gather(slot, spheres.carried);
    carried.impulse.store(touch.carried, first);
    store<width>(touch.compression + first, carried.compression);
    const Flags<width> last = carried.touch & std::int64_t{TouchRecord::last_bits};
    store<width>(touch.struck + first, last == std::int64_t{TouchRecord::impact});
    store<width>(touch.pushed + first, last == std::int64_t{TouchRecord::closing_a_gap});
    narrow<width>(record.touch + first, carried.touch);
}

/// Notes what has become of these touches, those within reach.
template <int width>
[[gnu::always_inline]] inline void take_down(RecordPack& record, TouchSums& sums, const TouchPack& touch, int first,
    const Flags<width>& within_reach, const LawOfStep& step)
{
    const Numbers<width> gap = load<width>(touch.gap + first), none = {};
    const Flags<width> kind = load_flags<width>(touch.kind + first), overlaps = within_reach & (gap < 0.0);
    const auto add = [&](double* sum, const Numbers<width>& part) __attribute__((always_inline))
    {
        store<width>(sum + first, load<width>(sum + first) + part);
    };
    add(sums.overlap, overlaps ? -gap : none);
    add(sums.stored_energy, load<width>(touch.stored_energy + first));
    add(sums.push_out_energy, load<width>(touch.push_out_energy + first));
    const Numbers<width> worst = load<width>(sums.worst_overlap + first);
    store<width>(sums.worst_overlap + first, larger<Numbers<width>>(worst, overlaps ? -gap : none));
    const auto count = [&](std::int64_t * number, const Flags<width>& which) __attribute__((always_inline))
    {
        store<width>(number + first, load_flags<width>(number + first) - which);
    };
    count(sums.overlapping, overlaps);
    count(sums.contacts, within_reach);
    count(sums.impacts, within_reach & (kind == static_cast<std::int64_t>(ContactKind::impact)));
    const Numbers<width> strain = load<width>(touch.strain + first), before = load<width>(sums.worst_strain + first);
    store<width>(sums.worst_strain + first, larger<Numbers<width>>(before, within_reach ? strain : none));
    const Flags<width> meets = within_reach & (load<width>(touch.closes + first) <= none + step.h);
    const Numbers<width> closing = load<width>(sums.closing_speed + first);
    store<width>(
        sums.closing_speed + first, larger<Numbers<width>>(closing, meets ? -load<width>(touch.u_n + first) : none));

    store<width>(record.gap + first, gap);
    store<width>(record.inverse_mass_sum + first, load<width>(touch.inverse_mass_sum + first));
    store<width>(record.compliance + first, load<width>(touch.compliance + first));
    store_floats<width>(record.compression + first, load<width>(touch.compression + first));
    store_floats<width>(record.stored + first, load<width>(touch.stored + first));
    store_floats<width>(record.spring + first, load<width>(touch.spring + first));
    store_floats<width>(record.push + first, load<width>(touch.push + first));
    if (step.elastic) store_floats<width>(record.shift + first, load<width>(touch.shift + first));
    store_floats<width>(record.restitution + first, load<width>(touch.restitution + first));
    store_floats<width>(record.hands_on + first,
        kind == static_cast<std::int64_t>(ContactKind::impact) ? none : none + __builtin_inf());
    narrow<width>(reinterpret_cast<std::uint8_t*>(record.kind) + first, within_reach & kind);
    narrow<width>(record.touch + first, within_reach & widened<width>(record.touch + first));
    record.in_problem |= static_cast<std::uint8_t>(bits<width>(within_reach) << first);
}

/// Makes contacts of these touches, those within reach.
template <int width>
[[gnu::always_inline]] inline void make_contacts(ContactPack& contact, RecordPack& record, TouchPack& touch,
    TouchSums& sums, PackImpacts& impacts, int first, const Flags<width>& within_reach, const StepConstants& step)
{
    apply_law<width>(contact, touch, first, within_reach, step);
    take_down<width>(record, sums, touch, first, within_reach, step.law);
    const Numbers<width> size = load<width>(touch.impact_size + first);
    store<width>(impacts.size + first, size);
    impacts.lanes |= bits<width>(size > 0.0) << first;
}

template <int width>
PackImpacts touch_spheres(
    ContactPack& contact, RecordPack& record, TouchSums& sums, const SphereNumbers& spheres, const StepConstants& step)
{
    TouchPack touch;
    PackImpacts impacts;
    record.in_problem = 0;
#pragma GCC unroll 4
    for (int first = 0; first < pack_size; first += width) {
        recall<width>(contact, touch, record, first, spheres, step.law);
        const Flags<width> within_reach = detect<width>(contact, touch, first, spheres.places, step);
        make_contacts<width>(contact, record, touch, sums, impacts, first, within_reach, step);
    }
    return impacts;
}

template <int width>
PackImpacts touch_walls(
    ContactPack& contact, RecordPack& record, TouchPack& touch, TouchSums& sums, const StepConstants& step)
{
    PackImpacts impacts;
    record.in_problem = 0;
    for (int first = 0; first < pack_size; first += width) {
        Flags<width> found;
        for (int lane = 0; lane < width; ++lane) found[lane] = -static_cast<std::int64_t>(contact.a[first + lane] >= 0);
        make_contacts<width>(contact, record, touch, sums, impacts, first, found, step);
    }
    return impacts;
}

/// What these contacts were in their step, for their records.
template <int width>
[[gnu::always_inline]] inline Flags<width> last_of(const Flags<width>& kind, const Flags<width>& loaded)
{
    using F = Flags<width>;
    const F was_impact = kind == static_cast<std::int64_t>(ContactKind::impact),
            was_open = kind == static_cast<std::int64_t>(ContactKind::open);
    return loaded & (was_impact ? F{} + std::int64_t{TouchRecord::impact}
                                : (was_open ? F{} + std::int64_t{TouchRecord::closing_a_gap}
                                            : F{} + std::int64_t{TouchRecord::loaded}));
}

template <int width>
unsigned hand_on(
    const ContactPack& contact, RecordPack& record, const LawOfStep& law, double* carried, HandedOn& handed)
{
    using N = Numbers<width>;
    using F = Flags<width>;
    unsigned deep_lanes = 0;
#pragma GCC unroll 4
    for (int first = 0; first < pack_size; first += width) {
        const Vector<width> normal = Vector<width>::load(contact.normal, first);
        const Vector<width> impulse = Vector<width>::load(contact.impulse, first);
        const N along = impulse.dot(normal), none = {};
        const Vector<width> tangent = impulse.plus(normal, -along);
        const N excess = beyond_disk<N>(tangent, load<width>(contact.friction + first) * along);
        const N spring = load_floats<width>(record.spring + first), w = load<width>(record.inverse_mass_sum + first);
        const N u_n = solved_velocity<N>(load<width>(contact.target + first), load<width>(record.compliance + first),
            load<width>(contact.parting + first), along);
        const N gap = load<width>(record.gap + first);
        const N kappa = compression_after<N>(load_floats<width>(record.compression + first),
            law.elastic ? gap + load_floats<width>(record.shift + first) : gap, u_n,
            load_floats<width>(record.restitution + first), law);
        const N stored = load_floats<width>(record.stored + first);
        const N square = handed_on<N>(kappa, stored, u_n, along, spring, w, law);
        const N pushed = load_floats<width>(record.push + first) * along;
        const F kind = widened<width>(reinterpret_cast<const std::uint8_t*>(record.kind) + first);
        const auto put = [&](double* sums, const N& numbers) __attribute__((always_inline))
        {
            store<width>(sums + first, numbers);
        };
        put(handed.cone_violation, larger<N>(load<width>(handed.cone_violation + first), excess));
        put(handed.stored_energy, load<width>(handed.stored_energy + first) +
                                      (square > 0.0 ? energy_of_square<N>(square, spring, w, law) : none));
        put(handed.push_out_energy, load<width>(handed.push_out_energy + first) + pushed);

        const N most = load_floats<width>(record.hands_on + first);
        N share = none + 1.0;
        if (any_of(along > most)) share = along > most ? most / along : share;
        const F is_deep = -gap > none + jammed_overlap * law.min_diameter;
        const F touch = is_deep ? widened<width>(record.touch + first) : last_of<width>(kind, along > 0.0);
        narrow<width>(record.touch + first, touch);
        deep_lanes |= bits<width>(is_deep) << first;

        const N of_carried = law.elastic ? square * share_of_carried<N>(spring, w, law) : square;
        const CarriedRecords<width> carries{impulse * share, root<N>(of_carried), touch};
        double* records[width];
        for (int lane = 0; lane < width; ++lane)
            records[lane] =
                contact.a[first + lane] < 0 ? nullptr : carried + std::size_t{4} * record.slot[first + lane];
        carries.scatter(records);
    }
    return deep_lanes & record.in_problem;
}

template <int width> constexpr TouchKernel touches()
{
    return {find_near<width>, touch_spheres<width>, touch_walls<width>, hand_on<width>};
}

} // namespace talus::packs
