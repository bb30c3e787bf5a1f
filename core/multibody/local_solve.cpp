// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/multibody/local_solve.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus::multibody
{
namespace
{

using Eigen::Index;
using Eigen::Vector2d;

/// The rows of a contact that lie on a disk, and the disk's radius over λ_n.
struct DiskRows {
    Index first;
    double coefficient;
};

constexpr Index disk_size = 2;
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 2 + 2 * disk_size, 1>; ///< rows of a contact
static_assert(tangent_rows == disk_size && rolling_rows == disk_size);

/// Calls visit(DiskRows) for the tangential and, where there are such, the rolling rows of a contact.
template <class Visit> void for_each_disk(const Constraint& contact, Visit&& visit)
{
    visit(DiskRows{1, contact.friction});
    if (contact.rolls()) visit(DiskRows{1 + tangent_rows, contact.rolling_reach});
}

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// One row as an equation, least ≤ z_i ≤ most, and what that changes in all rows.
void solve_row(const LocalProblem& local, Index i, double least, double most, LocalVector y, LocalVector z)
{
    if (local.D(i, i) <= 0.0) return; // nothing moves: both bodies are fixed
    const double solved = std::clamp(z[i] - local.omega * y[i] / local.D(i, i), least, most);
    y += local.D.col(i) * (solved - z[i]);
    z[i] = solved;
}

/// One disk of a contact, and what that changes in all rows.
void solve_disk(const LocalProblem& local, const DiskRows& rows, LocalVector y, LocalVector z)
{
    const Eigen::Matrix2d D = local.D.block<disk_size, disk_size>(rows.first, rows.first) / local.omega;
    if (D.trace() <= 0.0) return;
    const Vector2d old = z.segment<disk_size>(rows.first);
    const Vector2d b = y.segment<disk_size>(rows.first) - D * old;
    const Vector2d solved = solve_on_disk(D, b, rows.coefficient * z[0]);
    y += local.D.middleCols<disk_size>(rows.first) * (solved - old);
    z.segment<disk_size>(rows.first) = solved;
}

double least_impulse(const Constraint& constraint, Index row)
{
    const bool is_bounded = constraint.law == Law::unilateral || (constraint.law == Law::contact && row == 0);
    return is_bounded ? 0.0 : -unbounded;
}

/// What (21) makes of the impulse of (18): z = z_1 direction + stuck.
struct SlidingDirection {
    Vector direction; ///< 1 for the normal, μ w for what slides, zero for what sticks
    Vector stuck;     ///< the parts that stick, as (18) has them
    bool slides = false;
};

SlidingDirection sliding_direction(const Constraint& contact, const LocalVector& z)
{
    SlidingDirection sliding{Vector::Zero(z.size()), Vector::Zero(z.size())};
    sliding.direction[0] = 1.0;
    for_each_disk(contact, [&](const DiskRows& rows) {
        const Vector2d part = z.segment<disk_size>(rows.first);
        if (part.norm() <= rows.coefficient * z[0]) {
            sliding.stuck.segment<disk_size>(rows.first) = part;
            return;
        }
        sliding.direction.segment<disk_size>(rows.first) = rows.coefficient * part.normalized();
        sliding.slides = true;
    });
    if (!contact.twists()) return sliding;
    const double twist = z[twisting_row];
    if (std::abs(twist) <= contact.twisting_reach * z[0]) {
        sliding.stuck[twisting_row] = twist;
    } else {
        sliding.direction[twisting_row] = std::copysign(contact.twisting_reach, twist);
        sliding.slides = true;
    }
    return sliding;
}

} // namespace

void solve_by_block(const LocalProblem& local, LocalVector y, LocalVector z)
{
    z -= local.omega * local.inverse.lazyProduct(y);
    project(local.constraint, z);
}

void solve_along_sliding(const LocalProblem& local, LocalVector y, LocalVector z)
{
    if (local.constraint.law != Law::contact) return solve_by_block(local, y, z);
    const auto D = local.D.row(0) / local.omega;
    const double b = y[0] - D.dot(z); // r₁ − (D λ)₁ of (20)
    z -= local.omega * local.inverse.lazyProduct(y);
    const auto sliding = sliding_direction(local.constraint, z);
    const double denominator = D.dot(sliding.direction);
    if (sliding.slides && denominator > 0.0) {
        const double normal = -(b + D.dot(sliding.stuck)) / denominator;
        z = std::max(0.0, normal) * sliding.direction + sliding.stuck;
    }
    project(local.constraint, z);
}

void solve_by_row(const LocalProblem& local, LocalVector y, LocalVector z)
{
    for (Index i = 0; i < z.size(); ++i) solve_row(local, i, least_impulse(local.constraint, i), unbounded, y, z);
    project(local.constraint, z);
}

void solve_in_sequence(const LocalProblem& local, LocalVector y, LocalVector z)
{
    switch (local.constraint.law) {
    case Law::equality:
        z -= local.omega * local.inverse.lazyProduct(y);
        return;
    case Law::unilateral:
        return solve_by_row(local, y, z);
    case Law::contact:
        break;
    }
    solve_row(local, 0, 0.0, unbounded, y, z);
    for_each_disk(local.constraint, [&](const DiskRows& rows) { solve_disk(local, rows, y, z); });
    if (!local.constraint.twists()) return;
    const double most = local.constraint.twisting_reach * z[0];
    solve_row(local, twisting_row, -most, most, y, z);
}

void solve_locally(LocalSolve how, const LocalProblem& local, LocalVector y, LocalVector z)
{
    limit_parting(local.constraint, z[0], local.D(0, 0), y);
    switch (how) {
    case LocalSolve::block:
        return solve_by_block(local, y, z);
    case LocalSolve::sliding:
        return solve_along_sliding(local, y, z);
    case LocalSolve::scalar:
        return solve_by_row(local, y, z);
    case LocalSolve::sequential:
        return solve_in_sequence(local, y, z);
    }
}

Vector2d solve_on_disk(const Eigen::Matrix2d& D, const Vector2d& b, double radius)
{
    constexpr int most_steps = 100; // some five do; exact at once where D is isotropic
    constexpr double exact_enough = 1e-14;
    const double push = b.norm();
    if (radius <= 0.0 || push == 0.0) return Vector2d::Zero();
    const auto solved = [&](double alpha) -> Vector2d {
        return -((D + alpha * Eigen::Matrix2d::Identity()).inverse() * b);
    };
    const bool is_singular = D.determinant() <= std::numeric_limits<double>::epsilon() * D.squaredNorm();
    const double least = is_singular ? exact_enough * D.norm() : 0.0; // in place of α = 0
    if (solved(least).norm() <= radius) return solved(least);

    // |z(α)| falls with α and reaches the radius between these two: Newton on 1/|z|, kept between them.
    double low = std::max(least, push / radius - D.norm()), high = push / radius;
    if (!std::isfinite(high)) return -radius / push * b;
    double alpha = low;
    Vector2d z = solved(alpha);
    for (int step = 0; step < most_steps && std::abs(z.norm() - radius) > exact_enough * radius; ++step) {
        (z.norm() > radius ? low : high) = alpha;
        const Vector2d slope = (D + alpha * Eigen::Matrix2d::Identity()).inverse() * z;
        const double newton = alpha + z.squaredNorm() / z.dot(slope) * (z.norm() - radius) / radius;
        alpha = newton > low && newton < high ? newton : 0.5 * (low + high);
        z = solved(alpha);
    }
    return z * (radius / z.norm());
}

} // namespace talus::multibody
