// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/piston_group.hpp"

#include "core/contacts/attractions.hpp"
#include "core/solver/step_parts.hpp"

#include <numeric>

namespace talus
{
namespace
{

using Eigen::Index;
using Eigen::VectorXd;
using multibody::Constraint;

/// Makes the problem body by body, constraint by constraint.
class ProblemMaker
{
public:
    ProblemMaker(const ContactNetwork& network, const State& state, const Model& model, double h)
        : contacts_(network.contacts.pistons), arms_(network.contacts.piston_arms), state_(state), model_(model), h_(h),
          rows_(rows_of_contact(model.physics)), attractions_(attractions_of_pistons(network, model)),
          body_of_sphere_(state.count(), unknown)
    {
    }

    PistonProblem make()
    {
        for (std::size_t k = 0; k < model_.pistons.size(); ++k)
            add_piston_body(
                made_.problem, model_.pistons[k], state_.pistons[k], model_.gravity, attractions_[k], h_, state_.time);
        for (const std::size_t k : contacts_.indices()) add_contact(k);
        for (std::size_t k = 0; k < model_.pistons.size(); ++k)
            add_guide(made_.problem, k, model_.pistons[k], state_.pistons[k], h_, state_.time);
        set_warm_impulse();
        return std::move(made_);
    }

private:
    static constexpr std::size_t unknown = 0; ///< the number of a piston, never that of a sphere

    const TileContacts& contacts_;
    const std::vector<Vec3>& arms_;
    const State& state_;
    const Model& model_;
    const double h_;                          ///< of the step [s]
    const Index rows_;                        ///< of a contact
    const std::vector<WallLoad> attractions_; ///< by piston
    PistonProblem made_;
    std::vector<std::size_t> body_of_sphere_;

    std::size_t body_of(std::int32_t sphere)
    {
        auto& body = body_of_sphere_[sphere];
        if (body == unknown) {
            body = made_.problem.body_count();
            made_.spheres.push_back(sphere);
            // without gravity: its velocity comes from the spheres in each sweep
            add_sphere_body(made_.problem, state_.body(sphere), model_.physics.spin, Vec3::Zero());
        }
        return body;
    }

    void add_contact(std::size_t k)
    {
        const Contact c = contacts_.contact(k);
        const auto& basis = made_.bases.emplace_back(contact_basis(c.normal));
        const auto piston = static_cast<std::size_t>(model_.walls[c.b].piston);
        talus::add_contact(made_.problem, contacts_, k, basis, rows_,
            {{body_of(c.a), sphere_rows(basis, rows_, state_.body(c.a), model_.physics.spin, 1.0, 1.0)},
                {piston, piston_rows(basis, rows_, arms_[k])}});
    }

    void set_warm_impulse()
    {
        const auto& constraints = made_.problem.constraints();
        made_.warm_impulse.resize(made_.problem.rows());
        for (const std::size_t k : contacts_.indices())
            made_.warm_impulse.segment(constraints[k].first_row, rows_) =
                impulse_in_rows(contacts_, k, made_.bases[k], rows_);
        for (std::size_t k = 0; k < model_.pistons.size(); ++k) {
            const Constraint& guide = constraints[contacts_.count() + k];
            made_.warm_impulse.segment(guide.first_row, guide.rows) = state_.pistons[k].guide_impulse.head(guide.rows);
        }
    }
};

PistonProblem make_problem(const ContactNetwork& network, const State& state, const Model& model, double h)
{
    if (model.pistons.empty()) return {};
    return ProblemMaker(network, state, model, h).make();
}

} // namespace

PistonGroup::PistonGroup(const ContactNetwork& network, const State& state, const Model& model, double h)
    : own_(make_problem(network, state, model, h)), iterate_(own_.problem),
      algorithm_(iterate_, multibody::LocalSolve::sequential), sequence_(own_.problem.constraints().size())
{
    std::iota(sequence_.begin(), sequence_.end(), std::size_t{0});
    guides_.assign(sequence_.end() - static_cast<std::ptrdiff_t>(model.pistons.size()), sequence_.end());
}

void PistonGroup::warm_start(Body* bodies)
{
    fetch(bodies);
    for (const std::size_t k : sequence_) iterate_.add(k, own_.problem.rows_of(k, own_.warm_impulse));
    put_back(bodies);
}

SweepSums PistonGroup::sweep(Body* bodies)
{
    fetch(bodies);
    const SweepSums sums = algorithm_.sweep(iterate_, sequence_);
    put_back(bodies);
    return sums;
}

SweepSums PistonGroup::measure(const Body* bodies)
{
    fetch(bodies);
    return algorithm_.measure(iterate_);
}

WallRow PistonGroup::motion_at(std::size_t piston, const Vec3& arm) const
{
    const auto velocity = own_.problem.dofs_of(piston, iterate_.velocity());
    const Vec3 spin = velocity.tail<3>();
    return {velocity.head<3>() + spin.cross(arm), spin};
}

void PistonGroup::scale(const std::vector<double>& growth, Body* bodies)
{
    fetch(bodies);
    for (std::size_t k = 0; k < growth.size(); ++k)
        iterate_.add(k, growth[k] * own_.problem.rows_of(k, iterate_.impulse()));
    algorithm_.sweep(iterate_, guides_);
    put_back(bodies);
}

void PistonGroup::store(ContactNetwork& network, State& state) const
{
    if (empty()) return;
    auto& contacts = network.contacts.pistons;
    const auto& impulse = iterate_.impulse();
    for (const std::size_t k : contacts.indices()) {
        const auto own = own_.problem.rows_of(k, impulse);
        contacts.set_impulse(k, own_.bases[k] * own.head<contact_rows>());
        if (contacts.has_rolling()) contacts.set_rolling_impulse(k, rolling_in_space(own_.bases[k], own));
    }
    for (std::size_t k = 0; k < state.pistons.size(); ++k) {
        PistonState& piston = state.pistons[k];
        const auto guide = own_.problem.rows_of(contacts.count() + k, impulse);
        piston.guide_impulse.setZero();
        piston.guide_impulse.head(guide.size()) = guide;
        const auto velocity = own_.problem.dofs_of(k, iterate_.velocity());
        piston.velocity = velocity.head<3>();
        piston.spin = velocity.tail<3>();
    }
}

void PistonGroup::fetch(const Body* bodies)
{
    const auto pistons = own_.problem.body_count() - own_.spheres.size();
    for (std::size_t k = 0; k < own_.spheres.size(); ++k) {
        const Body& m = bodies[own_.spheres[k]];
        auto velocity = own_.problem.dofs_of(pistons + k, iterate_.velocity());
        velocity.head<3>() = m.velocity;
        if (velocity.size() == 6) velocity.tail<3>() = m.rim_velocity;
    }
}

void PistonGroup::put_back(Body* bodies) const
{
    const auto pistons = own_.problem.body_count() - own_.spheres.size();
    for (std::size_t k = 0; k < own_.spheres.size(); ++k) {
        Body& m = bodies[own_.spheres[k]];
        const auto velocity = own_.problem.dofs_of(pistons + k, iterate_.velocity());
        m.velocity = velocity.head<3>();
        if (velocity.size() == 6) m.rim_velocity = velocity.tail<3>();
    }
}

} // namespace talus
