// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/step/contact_gain.hpp"

#include "core/packs/law.hpp"
#include "core/solver/whole_contact.hpp"
#include "core/step/diagnostics.hpp"

#include <algorithm>
#include <array>

namespace talus
{
namespace
{

/// The gains of contacts of one kind.
template <bool wall, class R> class Gains
{
public:
    Gains(const State& state, double h) : state_(state), h_(h) {}

    double of(const TileContacts& contacts) const
    {
        double sum = 0.0;
        for (const std::size_t k : contacts.indices()) {
            const WholeContact own = whole_contact<wall, R>(contacts, k);
            sum += std::max(0.0, given_to_bodies(own) - given_by_spring(own, contacts.geometry(k)));
        }
        return sum;
    }

private:
    const State& state_;
    double h_;

    /// By how much the contact's impulses raise the bodies' kinetic energy, but for what its wall put in [J].
    double given_to_bodies(WholeContact own) const
    {
        const std::array<Motion, 2> with = {
            state_.motion[own.contact.a], state_.motion[wall ? own.contact.a : own.contact.b]};
        std::array<Motion, 2> without = with;
        own.contact.a = 0;
        own.contact.b = 1;
        apply_impulse<wall, R>(own, -own.contact.impulse, without.data());
        if constexpr (R::rolling) apply_rolling_impulse<wall>(own.contact, -own.rolling.impulse, without.data());
        double gain = kinetic_energy(with[0]) - kinetic_energy(without[0]);
        if constexpr (!wall) gain += kinetic_energy(with[1]) - kinetic_energy(without[1]);
        if constexpr (wall && R::moving_walls) gain -= own.contact.impulse.dot(own.wall.velocity);
        if constexpr (wall && R::moving_walls && R::rolling) gain -= own.rolling.impulse.dot(own.wall.spin);
        return gain;
    }

    /// What the contact's spring gives in the step, where it gives [J].
    double given_by_spring(const WholeContact& own, const ContactGeometry& geometry) const
    {
        if (own.terms.compliance == 0.0) return 0.0;
        const Contact& c = own.contact;
        const double way = h_ * contact_velocity<wall, R>(own, state_.motion.data()).dot(c.normal);
        const double kappa = geometry.compression;
        const auto held_at = [&](double at) { return 2.0 * upsilon / (own.terms.compliance * h_ * h_) * at * at; };
        return std::max(0.0, held_at(kappa) - held_at(std::max(0.0, kappa - way)));
    }
};

} // namespace

double contact_gain(const ContactNetwork& network, const State& state, const Model& model, double h)
{
    const StepContacts& contacts = network.contacts;
    const auto tiles = static_cast<std::int64_t>(contacts.spheres.size());
    std::vector<double> of_tile(contacts.spheres.size());
    with_rows(model.physics, [&](auto rows) {
        using R = decltype(rows);
        const Gains<false, R> spheres(state, h);
        const Gains<true, R> walls(state, h);
#pragma omp parallel for schedule(dynamic) if (tiles > 16)
        for (std::int64_t t = 0; t < tiles; ++t) {
            const auto tile = static_cast<std::size_t>(t);
            of_tile[tile] = spheres.of(contacts.spheres[tile]) + walls.of(contacts.walls[tile]);
        }
    });
    double sum = 0.0;
    for (const double one : of_tile) sum += one;
    return sum;
}

} // namespace talus
