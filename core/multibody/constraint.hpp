// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <limits>

namespace talus::multibody
{

/// What the impulse λ_k of a constraint may be, with y = G v + Σ λ − q of its rows.
enum class Law {
    equality,   ///< y = 0; λ_k has either sign
    unilateral, ///< each row by itself: 0 ≤ λ ⟂ y ≥ 0
    contact, ///< rows normal, tangent, tangent[, rolling, rolling[, twisting]]: 0 ≤ λ_n ⟂ y_n ≥ 0; |λ_t| ≤ μ λ_n, and
             ///< where y_t is not zero λ_t = −μ λ_n y_t/|y_t|; so the others, with their reach in place of μ
};

inline constexpr Eigen::Index tangent_rows = 2; ///< of a contact, after its normal
inline constexpr Eigen::Index rolling_rows = 2; ///< of a contact, after its tangents, where it has them
inline constexpr Eigen::Index twisting_row = 1 + tangent_rows + rolling_rows; ///< of a contact that has one

/// One constraint: its rows in λ, q and Σ, and the law of its impulse.
struct Constraint {
    Law law = Law::equality;
    Eigen::Index first_row = 0;
    Eigen::Index rows = 0;
    double friction = 0.0;                                     ///< μ of a contact
    double headroom = std::numeric_limits<double>::infinity(); ///< a contact asks for G v = q_n + this at most [m/s] …
    double compliance = 0.0;     ///< … or for q_n − Σ_n λ_n, with this Σ_n, if that is less [1/kg]
    double rolling_reach = 0.0;  ///< μ_r R* [m] of a contact with rolling rows: |λ_r| ≤ μ_r R* λ_n
    double twisting_reach = 0.0; ///< μ_t R* [m] of one with a twisting row

    bool rolls() const { return law == Law::contact && rows >= twisting_row; }
    bool twists() const { return law == Law::contact && rows > twisting_row; }
};

/// y_n of a contact is G v − min(q_n − Σ_n λ_n, q_n + headroom): what its rows' y becomes by that, where the second is
/// less as much of it as changes λ_n as it should. @param diagonal D_nn, Σ_n included
void limit_parting(const Constraint& constraint, double normal_impulse, double diagonal, Eigen::Ref<Eigen::VectorXd> y);

/// The nearest impulse, part by part, that the law allows: normal and unilateral rows not below zero, then tangential
/// and rolling rows radially onto the disks that the normal one allows; eq. (19) with μ² z₁² where the note has μ z₁².
void project(const Constraint& constraint, Eigen::Ref<Eigen::VectorXd> impulse);

/// By how much an impulse breaks its law [N s, rolling rows N m s]: the worst of −λ_n and |λ_t| − μ λ_n; 0 if it does
/// not.
double cone_violation(const Constraint& constraint, const Eigen::Ref<const Eigen::VectorXd>& impulse);

} // namespace talus::multibody
