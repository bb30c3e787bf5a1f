// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pressure_scaling/coarse_system.hpp"

namespace talus
{

using Eigen::Index;
using Eigen::VectorXd;

VectorXd CoarseSystem::diagonal() const
{
    VectorXd d = VectorXd::Zero(size());
    for (Index row = 0; row < size(); ++row)
        for (auto k = first_entry[row]; k < first_entry[row + 1]; ++k)
            if (column[k] == row) d[row] += value[k];
    for (const auto& body : shared) d += body.inverse_mass * body.impulse.cwiseAbs2();
    return d;
}

VectorXd CoarseSystem::times(const VectorXd& x) const
{
    VectorXd y(size());
    for (Index row = 0; row < size(); ++row) {
        double sum = 0.0;
        for (auto k = first_entry[row]; k < first_entry[row + 1]; ++k) sum += value[k] * x[column[k]];
        y[row] = sum;
    }
    for (const auto& body : shared) y += body.inverse_mass * body.impulse.dot(x) * body.impulse;
    return y;
}

VectorXd CoarseSystem::solved(const VectorXd& b, double tolerance, int most_iterations) const
{
    const VectorXd inverse_diagonal = diagonal().unaryExpr([](double d) { return d > 0.0 ? 1.0 / d : 0.0; });
    VectorXd x = VectorXd::Zero(size());
    VectorXd r = b, z = inverse_diagonal.cwiseProduct(r), p = z;
    double rz = r.dot(z);
    const double enough = tolerance * rz;
    for (int iteration = 0; iteration < most_iterations && rz > enough; ++iteration) {
        const VectorXd q = times(p);
        const double curvature = p.dot(q);
        if (!(curvature > 0.0)) break;
        x += rz / curvature * p;
        r -= rz / curvature * q;
        z = inverse_diagonal.cwiseProduct(r);
        const double last = std::exchange(rz, r.dot(z));
        p = z + rz / last * p;
    }
    return x;
}

} // namespace talus
