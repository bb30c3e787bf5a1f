// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/deep_beds/pressure_scaling.hpp"

#include "core/candidates/tile_crew.hpp"
#include "core/deep_beds/galerkin.hpp"
#include "core/solver/gauss_seidel.hpp"
#include "core/solver/whole_contact.hpp"

#include <Eigen/IterativeLinearSolvers>

#include <algorithm>

namespace talus
{
namespace
{

using Eigen::VectorXd;

constexpr int sweeps_before = 2;           ///< in a step
constexpr double negligible = 1e-4;        ///< share of a load: what is missing of it need not be corrected
constexpr double hat_spacing = 4.0;        ///< mean diameters …
constexpr double widest_grain = 1.0;       ///< … and at least so many largest ones: a sphere must fit into a cell
constexpr double least_growth = -0.8;      ///< α of a node: impulses stay positive …
constexpr double most_growth = 4.0;        ///< … and what carried little does not run away
constexpr double coarse_tolerance = 1e-3;  ///< of the coarse system, on |r|
constexpr int most_coarse_iterations = 30; ///< 10 are too few, more gain nothing

Box box_of(const std::vector<Vec3>& positions)
{
    Box around;
    for (const Vec3& x : positions) around.extend(x);
    return around;
}

HatGrid make_grid(const State& state, const Model& model)
{
    const Box around = box_of(state.position);
    const double spacing = std::max(hat_spacing * model.mean_diameter, widest_grain * model.max_diameter);
    return {spacing, around.grown(0.5 * model.max_diameter), model.contents.min};
}

/// t along α at which the energy is least, at most 1; 0 where it rises from the start.
double line_search(const CoarseEnergy& energy, const VectorXd& alpha)
{
    const double slope = energy.power.dot(alpha);
    const double curvature = alpha.dot((energy.curvature * alpha));
    return slope < 0.0 && curvature > 0.0 ? std::min(1.0, -slope / curvature) : 0.0;
}

/// The share by which the impulse of each load grows.
std::vector<double> growth_of_loads(
    const Loads& loads, const HatGrid& grid, const CoarseEnergy& energy, const VectorXd& growth)
{
    const auto count = static_cast<std::int64_t>(loads.list.size());
    std::vector<double> result(loads.list.size());
#pragma omp parallel for schedule(static) if (count > 1000)
    for (std::int64_t i = 0; i < count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        for_each_hat(loads.list[k], grid, energy.row_of,
            [&](std::int32_t row, double hat) { result[k] += hat == 0.0 ? 0.0 : hat * growth[row]; });
    }
    return result;
}

/// By how much impulses grow.
struct Growth {
    std::vector<double> of_load; ///< share; empty where the energy would rise
    double largest = 0.0;        ///< at a node
};

/// Where the pressure would have to grow, and how far it may without the energy rising.
Growth find_growth(const Loads& loads, const HatGrid& grid, const State& state, const Model& model)
{
    const CoarseEnergy energy = coarse_energy(loads, grid, state, model);
    Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver(energy.curvature);
    solver.setTolerance(coarse_tolerance).setMaxIterations(most_coarse_iterations);
    const VectorXd alpha = solver.solve(VectorXd(-energy.unsliding)).cwiseMax(least_growth).cwiseMin(most_growth);
    const double step = line_search(energy, alpha);
    if (step == 0.0) return {};
    return {growth_of_loads(loads, grid, energy, step * alpha), (step * alpha).cwiseAbs().maxCoeff()};
}

/// @param share by which each loaded contact grows. @return behind the last of them
template <bool wall, class R> const double* scale(TileContacts& contacts, const double* share, Body* bodies)
{
    for (const std::size_t k : contacts.indices()) {
        if (!contacts.is_loaded(k)) continue;
        whole_contact<wall, R>(contacts.span(), k, bodies).grow(packs::Numbers<1>{*share});
        ++share;
    }
    return share;
}

template <class R>
void apply(ContactNetwork& network, const Loads& loads, const std::vector<double>& growth, Body* bodies)
{
    const auto scale_tile = [&](std::size_t tile) {
        const double* const share = growth.data() + loads.first[tile];
        scale<true, R>(
            network.contacts.walls[tile], scale<false, R>(network.contacts.spheres[tile], share, bodies), bodies);
    };
    with_tile_crew(network.list.tiles, [&](TileCrew& crew) { crew.color_by_color(scale_tile); });
}

/// @param change ε of what the last sweep before changed
bool needs_scaling(double change, const State& state, const Model& model)
{
    if (state.count() == 0) return false;
    const double layers = box_of(state.position).extent().maxCoeff() / model.mean_diameter + 1.0;
    double lightest = infinity, heaviest = 0.0;
    for (std::size_t i = 0; i < state.count(); ++i) {
        lightest = std::min(lightest, state.mass(i));
        heaviest = std::max(heaviest, state.mass(i));
    }
    for (const Piston& piston : model.pistons) heaviest = std::max(heaviest, piston.mass);
    return change * std::max(layers * layers, heaviest / lightest) > negligible;
}

} // namespace

void ScalingReport::then(const ScalingReport& next)
{
    corrections += next.corrections;
    refused += next.refused;
    largest = std::max(largest, next.largest);
}

ScalingReport scale_pressure(ContactNetwork& network, PistonGroup& pistons, State& state, const Model& model)
{
    const HatGrid grid = make_grid(state, model);
    const Loads loads = find_loads(network, pistons, state, model, grid);
    if (loads.list.empty()) return {};

    // What hangs together is corrected together: a hat that reaches into two silos would bind them.
    const auto networks = networks_of(loads, state.count(), model.pistons.size());
    std::vector<double> growth(loads.list.size(), 0.0);
    double largest = 0.0;
    for (const auto& places : networks) {
        const Growth own = find_growth(networks.size() > 1 ? part_of(loads, places) : loads, grid, state, model);
        largest = std::max(largest, own.largest);
        for (std::size_t k = 0; k < own.of_load.size(); ++k) growth[places[k]] = own.of_load[k];
    }
    if (largest == 0.0) return {.corrections = 1, .refused = 1};

    Body* bodies = state.bodies.data();
    with_rows(model.physics, [&](auto rows) { apply<decltype(rows)>(network, loads, growth, bodies); });
    if (!pistons.empty()) {
        growth.erase(growth.begin(), growth.begin() + static_cast<std::ptrdiff_t>(loads.first_of_pistons()));
        pistons.scale(growth, bodies);
    }
    return {.corrections = 1, .largest = largest};
}

ScalingReport correct_pressures(ContactNetwork& network, PistonGroup& pistons, State& state, const Model& model)
{
    if (!model.solver.pressure_scaling) return {};
    const int sweeps = std::min(sweeps_before, model.solver.max_sweeps - 1);
    const double change = sweep_contacts(sweeps, network, pistons, state.bodies, model.physics);
    ScalingReport report;
    if (needs_scaling(change, state, model)) report = scale_pressure(network, pistons, state, model);
    report.sweeps = sweeps;
    return report;
}

} // namespace talus
