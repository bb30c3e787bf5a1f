// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pressure_scaling/galerkin.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace talus
{
namespace
{

using Eigen::Index;
using Eigen::VectorXd;

constexpr int span = 3; ///< nodes along an axis that the contacts of one sphere reach at most: two cells
constexpr int span_nodes = span * span * span;
constexpr int reach = 2 * span - 1; ///< nodes along an axis with which one node can share a sphere
constexpr int reach_nodes = reach * reach * reach;

/// Which loads each sphere has, as twice the number of the load, and one more where the sphere is its b.
struct LoadsOfSpheres {
    std::vector<std::uint32_t> first; ///< spheres + 1
    std::vector<std::uint32_t> entry;

    LoadsOfSpheres(const std::vector<Load>& loads, std::size_t spheres) : first(spheres + 1, 0)
    {
        for (const Load& load : loads) {
            ++first[load.a + 1];
            if (load.b >= 0) ++first[load.b + 1];
        }
        std::partial_sum(first.begin(), first.end(), first.begin());
        entry.resize(first.back());
        auto next = first;
        for (std::uint32_t k = 0; k < loads.size(); ++k) {
            entry[next[loads[k].a]++] = 2 * k;
            if (loads[k].b >= 0) entry[next[loads[k].b]++] = 2 * k + 1;
        }
    }
};

/// The cells in which the loads of a sphere begin, and whether they reach into a second one along each axis.
struct Footprint {
    LatticeIndex cell = {};
    std::array<int, 3> nodes = {2, 2, 2}; ///< along each axis
};

/// The spheres whose footprints begin in one cell, cell after cell.
struct SpheresOfCells {
    std::vector<std::size_t> cell;     ///< numbers of the cells in use, ascending
    std::vector<std::uint32_t> first;  ///< cells + 1
    std::vector<std::uint32_t> sphere; ///< ascending in each cell
    std::vector<Footprint> footprint;  ///< by sphere
};

Footprint footprint_of(
    const std::uint32_t* begin, const std::uint32_t* end, const std::vector<Load>& loads, const HatGrid& grid)
{
    Footprint footprint{loads[*begin / 2].place.cell};
    for (int d = 0; d < 3; ++d) {
        std::int32_t low = 0, high = 0;
        for (const auto* e = begin; e != end; ++e) {
            const auto way = grid.cells_between(d, footprint.cell[d], loads[*e / 2].place.cell[d]);
            low = std::min(low, way);
            high = std::max(high, way);
        }
        footprint.cell[d] += low;
        footprint.nodes[d] = 2 + high - low;
    }
    return footprint;
}

SpheresOfCells sort_into_cells(const LoadsOfSpheres& of, const std::vector<Load>& loads, const HatGrid& grid)
{
    const auto spheres = static_cast<std::int64_t>(of.first.size()) - 1;
    SpheresOfCells sorted;
    sorted.footprint.resize(of.first.size() - 1);
    std::vector<std::size_t> cell_of(of.first.size() - 1);
#pragma omp parallel for schedule(static) if (spheres > 1000)
    for (std::int64_t i = 0; i < spheres; ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (of.first[k] == of.first[k + 1]) continue;
        sorted.footprint[k] =
            footprint_of(&of.entry[of.first[k]], &of.entry[of.first[k]] + (of.first[k + 1] - of.first[k]), loads, grid);
        cell_of[k] = grid.number(sorted.footprint[k].cell);
    }
    std::vector<std::uint32_t> count(grid.node_count(), 0);
    for (std::size_t i = 0; i < cell_of.size(); ++i)
        if (of.first[i] != of.first[i + 1]) ++count[cell_of[i]];
    sorted.first = {0};
    for (std::size_t c = 0; c < count.size(); ++c) {
        if (count[c] == 0) continue;
        sorted.cell.push_back(c);
        sorted.first.push_back(sorted.first.back() + count[c]);
        count[c] = sorted.first[sorted.first.size() - 2];
    }
    sorted.sphere.resize(sorted.first.back());
    for (std::size_t i = 0; i < cell_of.size(); ++i)
        if (of.first[i] != of.first[i + 1]) sorted.sphere[count[cell_of[i]]++] = static_cast<std::uint32_t>(i);
    return sorted;
}

/// What one cell contributes, by the 27 nodes from its lowest on.
struct CellSums {
    Eigen::Matrix<double, span_nodes, span_nodes> curvature; ///< the lower triangle
    Eigen::Matrix<double, span_nodes, 1> power, unsliding;

    CellSums()
    {
        curvature.setZero();
        power.setZero();
        unsliding.setZero();
    }
};

constexpr int local_number(int x, int y, int z)
{
    return (z * span + y) * span + x;
}

/// Adds a sphere to the sums of the cell in which its footprint begins.
void add_sphere(CellSums& sums, std::uint32_t sphere, const LoadsOfSpheres& of, const std::vector<Load>& loads,
    const Footprint& footprint, const HatGrid& grid, double inverse_mass)
{
    // F_s on the sphere, linear and turning, so scaled that its square is that of M⁻¹ᐟ²F_s times the mass.
    Eigen::Matrix<double, 6, span_nodes> force;
    std::array<int, span_nodes> nodes; // those that the footprint has
    int count = 0;
    for (int z = 0; z < footprint.nodes[2]; ++z)
        for (int y = 0; y < footprint.nodes[1]; ++y)
            for (int x = 0; x < footprint.nodes[0]; ++x) {
                nodes[count++] = local_number(x, y, z);
                force.col(nodes[count - 1]).setZero();
            }

    for (auto k = of.first[sphere]; k < of.first[sphere + 1]; ++k) {
        const bool is_b = of.entry[k] % 2;
        const Load& load = loads[of.entry[k] / 2];
        Eigen::Matrix<double, 6, 1> effect;
        effect << (is_b ? -load.impulse : load.impulse),
            std::sqrt(inverse_inertia_factor) * (is_b ? load.turn_b : load.turn_a);
        std::array<int, 3> begin;
        for (int d = 0; d < 3; ++d) begin[d] = grid.cells_between(d, footprint.cell[d], load.place.cell[d]);
        for (int corner = 0; corner < 8; ++corner) {
            const std::array<int, 3> at = {corner & 1, corner >> 1 & 1, corner >> 2 & 1};
            const double hat = load.place.hat(at);
            const int node = local_number(begin[0] + at[0], begin[1] + at[1], begin[2] + at[2]);
            force.col(node) += hat * effect;
            if (is_b) continue;
            sums.power[node] += hat * load.power;
            sums.unsliding[node] += hat * load.unsliding;
        }
    }
    for (int s = 0; s < count; ++s)
        for (int t = 0; t <= s; ++t)
            sums.curvature(nodes[s], nodes[t]) += inverse_mass * force.col(nodes[s]).dot(force.col(nodes[t]));
}

/// The 27 nodes of a cell by their numbers.
std::array<std::size_t, span_nodes> nodes_of_cell(std::size_t cell, const HatGrid& grid)
{
    const auto low = grid.node(cell);
    std::array<std::size_t, span_nodes> nodes;
    for (int z = 0; z < span; ++z)
        for (int y = 0; y < span; ++y)
            for (int x = 0; x < span; ++x)
                nodes[local_number(x, y, z)] = grid.number({low[0] + x, low[1] + y, low[2] + z});
    return nodes;
}

/// The way from one node of a cell to another, as a place among the 125 that are within reach.
int place_in_stencil(int from, int to)
{
    int place = 0;
    for (int stride = span * span; stride > 0; stride /= span)
        place = place * reach + to / stride % span - from / stride % span + span - 1;
    return place;
}

/// The rows of the nodes in use, in the order of the nodes' numbers.
std::vector<std::size_t> number_rows(
    std::vector<std::int32_t>& row_of, const SpheresOfCells& cells, const HatGrid& grid)
{
    row_of.assign(grid.node_count(), -1);
    for (const auto cell : cells.cell)
        for (const auto node : nodes_of_cell(cell, grid)) row_of[node] = 0;
    std::vector<std::size_t> nodes;
    for (std::size_t node = 0; node < row_of.size(); ++node) {
        if (row_of[node] < 0) continue;
        row_of[node] = static_cast<std::int32_t>(nodes.size());
        nodes.push_back(node);
    }
    return nodes;
}

/// A row for each node, with the entries that are not zero.
void add_rows(CoarseSystem& system, const std::vector<std::size_t>& nodes, const std::vector<double>& stencils,
    const std::vector<std::int32_t>& row_of, const HatGrid& grid)
{
    for (std::size_t row = 0; row < nodes.size(); ++row) {
        const auto node = grid.node(nodes[row]);
        for (int place = 0; place < reach_nodes; ++place) {
            const double value = stencils[row * reach_nodes + static_cast<std::size_t>(place)];
            if (value == 0.0) continue;
            const LatticeIndex other = {node[0] + place % reach - (span - 1),
                node[1] + place / reach % reach - (span - 1), node[2] + place / (reach * reach) - (span - 1)};
            system.column.push_back(row_of[grid.number(other)]);
            system.value.push_back(value);
        }
        system.first_entry.push_back(system.column.size());
    }
}

/// Pistons move along their guides only, and reach far: each is one term of its own.
void add_pistons(CoarseEnergy& energy, const Loads& loads, const HatGrid& grid, const State& state, const Model& model)
{
    auto& shared = energy.curvature.shared;
    for (const Piston& piston : model.pistons)
        shared.push_back({piston.is_free(state.time) ? 1.0 / piston.mass : 0.0, VectorXd::Zero(energy.power.size())});
    for (std::size_t k = loads.first_of_pistons(); k < loads.list.size(); ++k) {
        const Load& load = loads.list[k];
        const double along_guide = -load.impulse.dot(model.pistons[load.piston].guide);
        for_each_hat(load, grid, energy.row_of,
            [&](std::int32_t row, double hat) { shared[load.piston].impulse[row] += hat * along_guide; });
    }
}

} // namespace

CoarseEnergy coarse_energy(const Loads& loads, const HatGrid& grid, const State& state, const Model& model)
{
    const LoadsOfSpheres of(loads.list, state.count());
    const SpheresOfCells cells = sort_into_cells(of, loads.list, grid);
    const auto cell_count = static_cast<std::int64_t>(cells.cell.size());

    std::vector<CellSums> sums(cells.cell.size());
#pragma omp parallel for schedule(dynamic) if (cell_count > 8)
    for (std::int64_t k = 0; k < cell_count; ++k) {
        const auto c = static_cast<std::size_t>(k);
        for (auto i = cells.first[c]; i < cells.first[c + 1]; ++i) {
            const auto sphere = cells.sphere[i];
            add_sphere(
                sums[c], sphere, of, loads.list, cells.footprint[sphere], grid, state.motion[sphere].inverse_mass);
        }
    }

    CoarseEnergy energy;
    const auto nodes = number_rows(energy.row_of, cells, grid);
    energy.power = energy.unsliding = VectorXd::Zero(static_cast<Index>(nodes.size()));
    std::vector<double> stencils(nodes.size() * reach_nodes, 0.0);
    for (std::size_t c = 0; c < sums.size(); ++c) {
        const auto of_cell = nodes_of_cell(cells.cell[c], grid);
        const auto add = [&](int s, int t) {
            stencils[static_cast<std::size_t>(energy.row_of[of_cell[s]] * reach_nodes + place_in_stencil(s, t))] +=
                sums[c].curvature(std::max(s, t), std::min(s, t));
        };
        for (int s = 0; s < span_nodes; ++s) {
            energy.power[energy.row_of[of_cell[s]]] += sums[c].power[s];
            energy.unsliding[energy.row_of[of_cell[s]]] += sums[c].unsliding[s];
            for (int t = 0; t < span_nodes; ++t) add(s, t);
        }
    }
    add_rows(energy.curvature, nodes, stencils, energy.row_of, grid);
    add_pistons(energy, loads, grid, state, model);
    return energy;
}

} // namespace talus
