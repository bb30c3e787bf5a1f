// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/properties/room.hpp"

#include "core/contacts/wall_contacts.hpp"

#include <algorithm>
#include <numeric>

namespace talus::test
{
namespace
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double fastest_way_out = 30.0;  ///< than the walls, that many times as fast: more is no room
constexpr double parting = 1e-4;          ///< with what all must be able to part [smallest diameters a step] …
constexpr double fastest_parting = 300.0; ///< … and how many times as fast spheres may be for that

/// Whether all walls near the spheres leave one direction open, so that spreading them on that side parts them all.
bool is_open(const std::vector<Touch>& all)
{
    Vec3 sum = Vec3::Zero();
    for (const Touch& touch : all)
        if (touch.with_wall) sum += touch.normal;
    return std::ranges::all_of(all, [&](const Touch& touch) {
        return !touch.with_wall || (touch.wall_velocity.isZero(0.0) && touch.normal.dot(sum) > 0.1 * sum.norm());
    });
}

} // namespace

std::vector<Touch> touches(const World& world, double h, double within)
{
    const State& state = world.state;
    std::vector<Touch> found;
    for (std::size_t i = 0; i < state.count(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const Vec3 apart = state.position[i] - state.position[j];
            const double gap = apart.norm() - state.radius[i] - state.radius[j];
            if (gap < within) found.push_back({i, j, false, apart.normalized(), Vec3::Zero(), gap});
        }
    const auto walls = place_walls(world.model, state, h);
    std::vector<WallPoint> points;
    std::vector<std::int32_t> patches;
    for (std::size_t w = 0; w < walls.size(); ++w)
        for (std::size_t i = 0; i < state.count(); ++i) {
            const Vec3& x = state.position[i];
            const double r = state.radius[i];
            patches.clear();
            points.clear();
            walls[w].patches_near(Box{x, x}.grown(r + within), patches);
            for (const std::int32_t patch : patches) {
                points.push_back(walls[w].nearest_point(static_cast<std::size_t>(patch), x));
                if (points.back().distance > r + within) points.pop_back();
            }
            keep_local_minima(walls[w], r + within, points);
            for (const WallPoint& at : points)
                found.push_back({i, w, true, at.normal,
                    walls[w].velocity(static_cast<std::size_t>(at.patch), x - r * at.normal), at.distance - r});
        }
    return found;
}

VectorXd nonnegative_least_squares(const MatrixXd& A, const VectorXd& b)
{
    const Index n = A.cols();
    VectorXd x = VectorXd::Zero(n);
    std::vector<Index> passive;
    const auto solve_passive = [&] {
        MatrixXd columns(A.rows(), static_cast<Index>(passive.size()));
        for (std::size_t k = 0; k < passive.size(); ++k) columns.col(static_cast<Index>(k)) = A.col(passive[k]);
        return VectorXd(columns.colPivHouseholderQr().solve(b));
    };
    for (Index rounds = 0; rounds < 10 * n + 10; ++rounds) {
        const VectorXd w = A.transpose() * (b - A * x);
        Index best = -1;
        double most = 1e-12 * A.norm() * b.norm();
        for (Index k = 0; k < n; ++k)
            if (w[k] > most && std::ranges::find(passive, k) == passive.end()) {
                best = k;
                most = w[k];
            }
        if (best < 0) return x;
        passive.push_back(best);
        for (;;) {
            const VectorXd s = solve_passive();
            double share = 1.0;
            Index first_out = -1; // the one that is the first to become negative on the way
            for (std::size_t k = 0; k < passive.size(); ++k)
                if (const double at = x[passive[k]], to = s[static_cast<Index>(k)]; to <= 0.0)
                    if (const double own = at > 0.0 ? at / (at - to) : 0.0; own <= share) {
                        share = own;
                        first_out = passive[k];
                    }
            for (std::size_t k = 0; k < passive.size(); ++k)
                x[passive[k]] += share * (s[static_cast<Index>(k)] - x[passive[k]]);
            if (first_out < 0) break;
            x[first_out] = 0.0;
            std::erase(passive, first_out);
        }
    }
    return x;
}

bool has_room(const World& world, double h)
{
    const Model& model = world.model;
    if (world.state.count() == 0) return true;
    for (const Vec3& x : world.state.position)
        if (!x.allFinite()) return false;
    const auto all = touches(world, h, model.min_diameter);
    if (is_open(all)) return true;
    double fastest = 0.0;
    for (const Touch& touch : all) fastest = std::max(fastest, touch.wall_velocity.norm());
    // The unknowns: velocities of spheres, and of pistons along their guides, in smallest diameters a step.
    const double unit = model.min_diameter / h;
    const auto spheres = static_cast<Index>(world.state.count());
    const Index unknowns = 3 * spheres + static_cast<Index>(model.pistons.size());
    MatrixXd G = MatrixXd::Zero(unknowns, static_cast<Index>(all.size()));
    VectorXd least(static_cast<Index>(all.size()));
    for (std::size_t k = 0; k < all.size(); ++k) {
        const Touch& touch = all[k];
        const auto row = static_cast<Index>(k);
        G.block<3, 1>(3 * static_cast<Index>(touch.a), row) = touch.normal;
        least[row] = parting - std::max(0.0, touch.gap) / model.min_diameter;
        if (!touch.with_wall) {
            G.block<3, 1>(3 * static_cast<Index>(touch.b), row) = -touch.normal;
        } else if (const auto piston = model.walls[touch.b].piston; piston >= 0) {
            G(3 * spheres + piston, row) = -touch.normal.dot(model.pistons[static_cast<std::size_t>(piston)].guide);
        } else {
            least[row] += touch.normal.dot(touch.wall_velocity) / unit;
        }
    }
    // The least v with Gᵀ v ≥ least: v = −r / r_last of the residual r of the least squares below.
    MatrixXd E(unknowns + 1, G.cols());
    E << G, least.transpose();
    VectorXd f = VectorXd::Zero(unknowns + 1);
    f[unknowns] = 1.0;
    const VectorXd r = E * nonnegative_least_squares(E, f) - f;
    const double fastest_allowed = fastest_way_out * fastest / unit + fastest_parting * parting;
    return -r[unknowns] > 1e-12 && r.head(unknowns).norm() < fastest_allowed * -r[unknowns];
}

} // namespace talus::test
