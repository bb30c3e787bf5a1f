// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/piston_group.hpp"

#include "core/contact_basis.hpp"
#include "core/multibody/stepping.hpp"
#include "core/stabilisation.hpp"

#include <numeric>

namespace talus
{
namespace
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using multibody::BodyRows;
using multibody::Constraint;
using multibody::Law;
using multibody::Problem;
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, 6>;

constexpr Index contact_rows = 1 + multibody::tangent_rows;

/// τ/h of the guides: critical damping, as for the contacts (upsilon of stabilisation.hpp).
constexpr double guide_relaxation = 2.0;

/// A sphere in the terms of its Motion: v with the mass m, and, where it turns, a = r ω with 2/5 m.
void add_sphere(Problem& problem, const Motion& m, bool spin)
{
    VectorXd mass = VectorXd::Constant(spin ? 6 : 3, 1.0 / m.inverse_mass);
    if (spin) mass.tail<3>() /= inverse_inertia_factor;
    problem.add_body(mass.asDiagonal(), VectorXd::Zero(mass.size())); // it comes with its velocity in each sweep
}

/// A piston with the velocity of its centre and its spin; p = M v⁽⁰⁾ + h f.
void add_piston(Problem& problem, const Piston& piston, const PistonState& own, const Model& model, double time)
{
    const Eigen::Matrix3d inertia = own.pose.rotation * piston.inertia * own.pose.rotation.transpose();
    MatrixXd mass = MatrixXd::Zero(6, 6);
    mass.topLeftCorner<3, 3>().diagonal().setConstant(piston.mass);
    mass.bottomRightCorner<3, 3>() = inertia;
    const Vec3 force = piston.mass * model.gravity + piston.load_at(time) * piston.guide;
    VectorXd momentum(6);
    momentum << piston.mass * own.velocity + model.time_step * force, inertia * own.spin;
    problem.add_body(mass, momentum);
}

/// What the sphere contributes to the rows of a contact: u = v + n × a, and ω = a/r for the rolling rows.
MatrixXd sphere_rows(const Eigen::Matrix3d& basis, double radius, Index rows, bool spin)
{
    RowMatrix G = RowMatrix::Zero(rows, 6);
    G.topLeftCorner<contact_rows, 3>() = basis.transpose();
    for (Index i = 0; i < contact_rows; ++i) G.block<1, 3>(i, 3) = basis.col(i).cross(basis.col(0)).transpose();
    for (Index i = contact_rows; i < rows; ++i)
        G.block<1, 3>(i, 3) = basis.col(i - multibody::rolling_rows).transpose() / radius;
    return G.leftCols(spin ? 6 : 3);
}

/// What the piston does: −(V + Ω × arm), and −Ω.
MatrixXd piston_rows(const Eigen::Matrix3d& basis, const Vec3& arm, Index rows)
{
    RowMatrix G = RowMatrix::Zero(rows, 6);
    G.topLeftCorner<contact_rows, 3>() = -basis.transpose();
    for (Index i = 0; i < contact_rows; ++i) G.block<1, 3>(i, 3) = -arm.cross(basis.col(i)).transpose();
    for (Index i = contact_rows; i < rows; ++i)
        G.block<1, 3>(i, 3) = -basis.col(i - multibody::rolling_rows).transpose();
    return G;
}

/// The rows of a guide: two directions across its axis, three turns, and the axis itself while the piston is held.
void add_guide(Problem& problem, std::size_t body, const Piston& piston, const PistonState& own, bool held, double h)
{
    RowMatrix G = RowMatrix::Zero(held ? 6 : 5, 6);
    const Vec3 across = any_perpendicular(piston.guide);
    G.block<1, 3>(0, 0) = across.transpose();
    G.block<1, 3>(1, 0) = piston.guide.cross(across).transpose();
    G.block<3, 3>(2, 3).setIdentity();
    if (held) G.block<1, 3>(5, 0) = piston.guide.transpose();

    const Eigen::AngleAxisd turn(own.pose.rotation);
    PistonState::GuideVector displacement, velocity;
    displacement << own.pose(piston.center) - piston.center, turn.angle() * turn.axis();
    velocity << own.velocity, own.spin;
    const VectorXd gap = G * displacement, speed = G * velocity;
    VectorXd target(G.rows());
    for (Index i = 0; i < G.rows(); ++i)
        target[i] = multibody::holonomic_row(gap[i], speed[i], infinity, guide_relaxation * h, h).target;
    problem.add_constraint({.law = Law::equality}, {{body, G}}, VectorXd::Zero(G.rows()), target);
}

/// Makes the problem body by body, constraint by constraint.
class ProblemMaker
{
public:
    ProblemMaker(const ContactNetwork& network, const State& state, const Model& model)
        : contacts_(network.piston_contacts), arms_(network.piston_arms), state_(state), model_(model),
          rows_(contact_rows + (model.physics.rolling ? multibody::rolling_rows : 0)),
          body_of_sphere_(state.count(), unknown)
    {
    }

    PistonProblem make()
    {
        for (std::size_t k = 0; k < model_.pistons.size(); ++k)
            add_piston(made_.problem, model_.pistons[k], state_.pistons[k], model_, state_.time);
        for (std::size_t k = 0; k < contacts_.count[0]; ++k) add_contact(k);
        for (std::size_t k = 0; k < model_.pistons.size(); ++k)
            add_guide(made_.problem, k, model_.pistons[k], state_.pistons[k], !model_.pistons[k].is_free(state_.time),
                model_.time_step);
        set_warm_impulse();
        return std::move(made_);
    }

private:
    static constexpr std::size_t unknown = 0; ///< the number of a piston, never that of a sphere

    const ContactArrays& contacts_;
    const std::vector<Vec3>& arms_;
    const State& state_;
    const Model& model_;
    const Index rows_; ///< of a contact
    PistonProblem made_;
    std::vector<std::size_t> body_of_sphere_;

    std::size_t body_of(std::int32_t sphere)
    {
        auto& body = body_of_sphere_[sphere];
        if (body == unknown) {
            body = made_.problem.body_count();
            made_.spheres.push_back(sphere);
            add_sphere(made_.problem, state_.motion[sphere], model_.physics.spin);
        }
        return body;
    }

    void add_contact(std::size_t k)
    {
        const Contact& c = contacts_.contact[k];
        const ContactTerms& terms = contacts_.terms[k];
        const auto& basis = made_.bases.emplace_back(contact_basis(c.normal));
        Constraint law{.law = Law::contact, .friction = terms.friction};
        if (model_.physics.rolling) law.rolling_reach = contacts_.rolling[k].reach;
        VectorXd compliance = VectorXd::Zero(rows_), target = VectorXd::Zero(rows_);
        compliance[0] = terms.compliance;
        target[0] = c.target;
        const auto piston = static_cast<std::size_t>(model_.walls[c.b].piston);
        made_.problem.add_constraint(law,
            {{body_of(c.a), sphere_rows(basis, state_.radius(c.a), rows_, model_.physics.spin)},
                {piston, piston_rows(basis, arms_[k], rows_)}},
            compliance, target);
        made_.warm_size += terms.inverse_mass_sum * c.impulse.squaredNorm();
        if (model_.physics.rolling)
            made_.warm_size += contacts_.rolling[k].impulse.squaredNorm() / contacts_.rolling[k].inertia;
    }

    void set_warm_impulse()
    {
        const auto& constraints = made_.problem.constraints();
        made_.warm_impulse.resize(made_.problem.rows());
        for (std::size_t k = 0; k < contacts_.count[0]; ++k) {
            auto own = made_.warm_impulse.segment(constraints[k].first_row, rows_);
            own.head<contact_rows>() = made_.bases[k].transpose() * contacts_.contact[k].impulse;
            if (model_.physics.rolling)
                own.tail<multibody::rolling_rows>() =
                    made_.bases[k].rightCols<multibody::rolling_rows>().transpose() * contacts_.rolling[k].impulse;
        }
        for (std::size_t k = 0; k < model_.pistons.size(); ++k) {
            const Constraint& guide = constraints[contacts_.count[0] + k];
            made_.warm_impulse.segment(guide.first_row, guide.rows) = state_.pistons[k].guide_impulse.head(guide.rows);
        }
    }
};

PistonProblem make_problem(const ContactNetwork& network, const State& state, const Model& model)
{
    if (model.pistons.empty()) return {};
    return ProblemMaker(network, state, model).make();
}

} // namespace

PistonGroup::PistonGroup(const ContactNetwork& network, const State& state, const Model& model)
    : own_(make_problem(network, state, model)), iterate_(own_.problem),
      algorithm_(iterate_, multibody::LocalSolve::sequential), sequence_(own_.problem.constraints().size())
{
    std::iota(sequence_.begin(), sequence_.end(), std::size_t{0});
}

double PistonGroup::warm_start(Motion* motion)
{
    fetch(motion);
    for (const std::size_t k : sequence_) iterate_.add(k, own_.problem.rows_of(k, own_.warm_impulse));
    put_back(motion);
    return own_.warm_size;
}

SweepSums PistonGroup::sweep(Motion* motion)
{
    fetch(motion);
    const SweepSums sums = algorithm_.sweep(iterate_, sequence_);
    put_back(motion);
    return sums;
}

SweepSums PistonGroup::measure(const Motion* motion)
{
    fetch(motion);
    return algorithm_.measure(iterate_);
}

void PistonGroup::store(ContactNetwork& network, State& state) const
{
    if (empty()) return;
    auto& contacts = network.piston_contacts;
    const auto& impulse = iterate_.impulse();
    for (std::size_t k = 0; k < contacts.count[0]; ++k) {
        const auto own = own_.problem.rows_of(k, impulse);
        contacts.contact[k].impulse = own_.bases[k] * own.head<contact_rows>();
        if (!contacts.rolling.empty())
            contacts.rolling[k].impulse =
                own_.bases[k].rightCols<multibody::rolling_rows>() * own.tail<multibody::rolling_rows>();
    }
    for (std::size_t k = 0; k < state.pistons.size(); ++k) {
        PistonState& piston = state.pistons[k];
        const auto guide = own_.problem.rows_of(contacts.count[0] + k, impulse);
        piston.guide_impulse.setZero();
        piston.guide_impulse.head(guide.size()) = guide;
        const auto velocity = own_.problem.dofs_of(k, iterate_.velocity());
        piston.velocity = velocity.head<3>();
        piston.spin = velocity.tail<3>();
    }
}

void PistonGroup::fetch(const Motion* motion)
{
    const auto pistons = own_.problem.body_count() - own_.spheres.size();
    for (std::size_t k = 0; k < own_.spheres.size(); ++k) {
        const Motion& m = motion[own_.spheres[k]];
        auto velocity = own_.problem.dofs_of(pistons + k, iterate_.velocity());
        velocity.head<3>() = m.velocity;
        if (velocity.size() == 6) velocity.tail<3>() = m.rim_velocity;
    }
}

void PistonGroup::put_back(Motion* motion) const
{
    const auto pistons = own_.problem.body_count() - own_.spheres.size();
    for (std::size_t k = 0; k < own_.spheres.size(); ++k) {
        Motion& m = motion[own_.spheres[k]];
        const auto velocity = own_.problem.dofs_of(pistons + k, iterate_.velocity());
        m.velocity = velocity.head<3>();
        if (velocity.size() == 6) m.rim_velocity = velocity.tail<3>();
    }
}

} // namespace talus
