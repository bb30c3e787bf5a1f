// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/step_problem.hpp"

#include "core/contacts/attractions.hpp"
#include "core/solver/step_parts.hpp"

#include <algorithm>
#include <numeric>

namespace talus
{
namespace
{

using Eigen::Index;
using Eigen::VectorXd;
using multibody::BodyRows;

/// States a step's problem body by body, constraint by constraint.
class Statement
{
public:
    Statement(const State& state, const ContactNetwork& network, const Model& model)
        : state_(state), model_(model), rows_(rows_of_contact(model.physics))
    {
        auto& order = stated_.sphere_of_body;
        order.resize(state.count());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::ranges::sort(order, {}, [&](std::size_t sphere) { return state.id[sphere]; });
        body_of_sphere_.resize(state.count());
        std::vector<Body> attracted = state.bodies;
        apply_attractions(network, attracted);
        for (std::size_t body = 0; body < order.size(); ++body) {
            body_of_sphere_[order[body]] = body;
            add_sphere_body(
                stated_.problem, attracted[order[body]], model.physics.spin, model.time_step * model.gravity);
        }
        const std::vector<WallLoad> attractions = attractions_of_pistons(network, model);
        for (std::size_t k = 0; k < model.pistons.size(); ++k)
            add_piston_body(stated_.problem, model.pistons[k], state.pistons[k], model.gravity, attractions[k],
                model.time_step, state.time);
    }

    void add_sphere_contact(const TileContacts& contacts, std::size_t k)
    {
        add_contact(contacts, k, false, [&](const Eigen::Matrix3d& basis) {
            return BodyRows{
                body_of_sphere_[contacts.b(k)], sphere_rows(basis, rows_, state_.body(contacts.b(k)),
                                                    model_.physics.spin, -1.0, contacts.contact(k).arm_scale)};
        });
    }

    void add_wall_contact(const TileContacts& contacts, std::size_t k) { add_contact(contacts, k, true, nullptr); }

    /// @param arm from the piston's centre [m]
    void add_piston_contact(const TileContacts& contacts, std::size_t k, const Vec3& arm)
    {
        const auto piston = static_cast<std::size_t>(model_.walls[contacts.b(k)].piston);
        add_contact(contacts, k, true, [&](const Eigen::Matrix3d& basis) {
            return BodyRows{state_.count() + piston, piston_rows(basis, rows_, arm)};
        });
    }

    void add_guides()
    {
        for (std::size_t k = 0; k < model_.pistons.size(); ++k) {
            const PistonState& own = state_.pistons[k];
            add_guide(stated_.problem, state_.count() + k, model_.pistons[k], own, model_.time_step, state_.time);
            append_warm(own.guide_impulse.head(stated_.problem.constraints().back().rows));
        }
    }

    StepProblem finished()
    {
        stated_.warm_impulse = Eigen::Map<const VectorXd>(warm_.data(), static_cast<Index>(warm_.size()));
        return std::move(stated_);
    }

private:
    const State& state_;
    const Model& model_;
    Index rows_; ///< of a contact
    StepProblem stated_;
    std::vector<double> warm_;
    std::vector<std::size_t> body_of_sphere_;

    /// @param rows_of_other returns what body b contributes; null at a wall
    template <class RowsOfOther>
    void add_contact(const TileContacts& contacts, std::size_t k, bool with_wall, RowsOfOther&& rows_of_other)
    {
        const Contact c = contacts.contact(k);
        const Eigen::Matrix3d basis = contact_basis(c.normal);
        std::vector<BodyRows> bodies = {
            {body_of_sphere_[c.a], sphere_rows(basis, rows_, state_.body(c.a), model_.physics.spin, 1.0, c.arm_scale)}};
        if constexpr (!std::is_null_pointer_v<std::decay_t<RowsOfOther>>) bodies.push_back(rows_of_other(basis));
        talus::add_contact(stated_.problem, contacts, k, basis, rows_, bodies);
        append_warm(impulse_in_rows(contacts, k, basis, rows_));
        const Vec3 point = state_.position[c.a] - (state_.radius[c.a] + 0.5 * c.gap) * c.normal;
        stated_.contacts.push_back({c.a, c.b, with_wall, c.gap, c.kind, point});
    }

    void append_warm(const VectorXd& impulse) { warm_.insert(warm_.end(), impulse.begin(), impulse.end()); }
};

} // namespace

StepProblem make_step_problem(const State& state, const ContactNetwork& network, const Model& model)
{
    Statement statement(state, network, model);
    const StepContacts& contacts = network.contacts;
    for (std::size_t tile = 0; tile < contacts.spheres.size(); ++tile) {
        for (const std::size_t k : contacts.spheres[tile].indices())
            statement.add_sphere_contact(contacts.spheres[tile], k);
        for (const std::size_t k : contacts.walls[tile].indices()) statement.add_wall_contact(contacts.walls[tile], k);
    }
    for (const std::size_t k : contacts.pistons.indices())
        statement.add_piston_contact(contacts.pistons, k, contacts.piston_arms[k]);
    statement.add_guides();
    return statement.finished();
}

} // namespace talus
