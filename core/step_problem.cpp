// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/step_problem.hpp"

#include "core/contact_basis.hpp"

namespace talus
{
namespace
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using multibody::Law;

constexpr Index contact_rows = 1 + multibody::tangent_rows;

/// States a step's problem body by body, contact by contact.
class Statement
{
public:
    Statement(const State& state, const Model& model)
        : state_(state), spin_(model.physics.spin),
          rows_(contact_rows + (model.physics.rolling ? multibody::rolling_rows : 0))
    {
        for (std::size_t i = 0; i < state.count(); ++i) add_sphere(i, model.time_step * model.gravity);
    }

    void add_contact(const ContactArrays& arrays, std::size_t k, bool with_wall)
    {
        const Contact& c = arrays.contact[k];
        const Eigen::Matrix3d basis = contact_basis(c.normal);
        const double arm_scale = arrays.terms[k].arm_scale;
        const auto a = static_cast<std::size_t>(c.a), b = static_cast<std::size_t>(c.b);

        std::vector<multibody::BodyRows> bodies = {{a, rows_of_sphere(a, -arm_scale, basis, 1.0)}};
        if (!with_wall) bodies.push_back({b, rows_of_sphere(b, arm_scale, basis, -1.0)});
        VectorXd compliance = VectorXd::Zero(rows_), target = VectorXd::Zero(rows_);
        compliance[0] = arrays.terms[k].compliance;
        target[0] = c.target;
        if (!arrays.wall.empty()) target += in_rows(basis, arrays.wall[k].velocity, arrays.wall[k].spin);
        stated_.problem.add_constraint({.law = Law::contact,
                                           .friction = arrays.terms[k].friction,
                                           .rolling_reach = arrays.rolling.empty() ? 0.0 : arrays.rolling[k].reach},
            bodies, compliance, target);
        const VectorXd impulse =
            in_rows(basis, c.impulse, arrays.rolling.empty() ? Vec3::Zero().eval() : arrays.rolling[k].impulse);
        warm_impulse_.insert(warm_impulse_.end(), impulse.begin(), impulse.end());
    }

    StepProblem finished()
    {
        stated_.warm_impulse =
            Eigen::Map<const VectorXd>(warm_impulse_.data(), static_cast<Index>(warm_impulse_.size()));
        return std::move(stated_);
    }

private:
    const State& state_;
    bool spin_;
    Index rows_; ///< of a contact
    StepProblem stated_;
    std::vector<double> warm_impulse_;

    /// p = M v⁽⁰⁾ + h f with M = diag(m, m, m, I, I, I).
    void add_sphere(std::size_t i, const Vec3& gravity_push)
    {
        VectorXd mass = VectorXd::Constant(spin_ ? 6 : 3, state_.mass(i)), velocity(mass.size());
        velocity.head<3>() = state_.motion[i].velocity + gravity_push;
        if (spin_) {
            mass.tail<3>() *= state_.radius(i) * state_.radius(i) / inverse_inertia_factor;
            velocity.tail<3>() = state_.angular_velocity(i);
        }
        stated_.problem.add_body(mass.asDiagonal(), mass.cwiseProduct(velocity));
    }

    /// What a sphere contributes to the rows: ± direction·(v + ω × arm), and ± axis·ω for the rolling rows.
    /// @param arm_over_radius of the lever arm along n
    MatrixXd rows_of_sphere(std::size_t i, double arm_over_radius, const Eigen::Matrix3d& basis, double sign) const
    {
        MatrixXd G = MatrixXd::Zero(rows_, spin_ ? 6 : 3);
        G.topLeftCorner<contact_rows, 3>() = sign * basis.transpose();
        if (!spin_) return G;
        const Vec3 arm = arm_over_radius * state_.radius(i) * basis.col(0);
        for (Index row = 0; row < contact_rows; ++row)
            G.block<1, 3>(row, 3) = sign * arm.cross(basis.col(row)).transpose();
        for (Index row = contact_rows; row < rows_; ++row)
            G.block<1, 3>(row, 3) = sign * basis.col(row - multibody::rolling_rows).transpose();
        return G;
    }

    /// A vector in the directions of normal and tangents, another in those of the rolling axes.
    VectorXd in_rows(const Eigen::Matrix3d& basis, const Vec3& vector, const Vec3& rolling) const
    {
        VectorXd both(rows_);
        both.head<contact_rows>() = basis.transpose() * vector;
        both.tail(rows_ - contact_rows) = (basis.transpose() * rolling).tail(rows_ - contact_rows);
        return both;
    }
};

} // namespace

StepProblem make_step_problem(const State& state, const ContactNetwork& contacts, const Model& model)
{
    Statement statement(state, model);
    const auto add = [&](const ContactArrays& arrays, std::size_t first, std::size_t tile, bool with_wall) {
        for (std::size_t k = first; k < first + arrays.count[tile]; ++k) statement.add_contact(arrays, k, with_wall);
    };
    for (std::size_t tile = 0; tile < contacts.tiles.count(); ++tile) {
        add(contacts.sphere_contacts, contacts.pairs_of_tile[tile], tile, false);
        add(contacts.wall_contacts, contacts.wall_slots_of_tile[tile], tile, true);
    }
    return statement.finished();
}

} // namespace talus
