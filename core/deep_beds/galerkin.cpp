// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/deep_beds/galerkin.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <span>
#include <utility>

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

    std::span<const std::uint32_t> entries_of(std::size_t sphere) const
    {
        return {entry.data() + first[sphere], entry.data() + first[sphere + 1]};
    }
};

/// The nodes that the loads of a sphere reach: a box of them from one cell on, two or three along each axis.
struct Footprint {
    LatticeIndex cell = {};
    std::array<int, 3> nodes = {2, 2, 2};

    static constexpr int shapes = 8;
    int shape() const { return (nodes[0] - 2) + 2 * (nodes[1] - 2) + 4 * (nodes[2] - 2); }
    static Footprint of_shape(const LatticeIndex& cell, int shape)
    {
        return {cell, {2 + (shape & 1), 2 + (shape >> 1 & 1), 2 + (shape >> 2 & 1)}};
    }

    int node_count() const { return nodes[0] * nodes[1] * nodes[2]; }
    int number(int x, int y, int z) const { return (z * nodes[1] + y) * nodes[0] + x; }
    LatticeIndex offset(int number) const
    {
        return {number % nodes[0], number / nodes[0] % nodes[1], number / (nodes[0] * nodes[1])};
    }
};

Footprint footprint_of(std::span<const std::uint32_t> entries, const std::vector<Load>& loads)
{
    Footprint footprint{loads[entries[0] / 2].place.cell};
    for (int d = 0; d < 3; ++d) {
        std::int32_t low = 0, high = 0;
        for (const auto entry : entries) {
            const auto way = loads[entry / 2].place.cell[d] - footprint.cell[d];
            low = std::min(low, way);
            high = std::max(high, way);
        }
        footprint.cell[d] += low;
        footprint.nodes[d] = 2 + high - low;
    }
    return footprint;
}

/// Spheres that have one footprint.
struct Group {
    Footprint footprint;
    std::uint32_t begin, end; ///< in Groups::sphere
};

/// The loaded spheres by their footprints, in the order of the cells' numbers.
struct Groups {
    std::vector<Group> list;
    std::vector<std::uint32_t> sphere; ///< ascending in each group
};

Groups group_spheres(const LoadsOfSpheres& of, const std::vector<Load>& loads, const HatGrid& grid)
{
    const auto spheres = static_cast<std::int64_t>(of.first.size()) - 1;
    constexpr std::size_t none = ~std::size_t{0};
    std::vector<std::size_t> key(of.first.size() - 1, none);
#pragma omp parallel for schedule(static) if (spheres > 1000)
    for (std::int64_t i = 0; i < spheres; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const auto entries = of.entries_of(k);
        if (entries.empty()) continue;
        const Footprint footprint = footprint_of(entries, loads);
        key[k] = grid.number(footprint.cell) * Footprint::shapes + static_cast<std::size_t>(footprint.shape());
    }

    // Counting sort.
    std::vector<std::uint32_t> next(grid.node_count() * Footprint::shapes, 0);
    for (const auto k : key)
        if (k != none) ++next[k];
    Groups groups;
    std::uint32_t begin = 0;
    for (std::size_t k = 0; k < next.size(); ++k) {
        if (next[k] == 0) continue;
        const auto cell = grid.node(k / Footprint::shapes);
        groups.list.push_back(
            {Footprint::of_shape(cell, static_cast<int>(k % Footprint::shapes)), begin, begin + next[k]});
        next[k] = std::exchange(begin, begin + next[k]);
    }
    groups.sphere.resize(begin);
    for (std::size_t i = 0; i < key.size(); ++i)
        if (key[i] != none) groups.sphere[next[key[i]]++] = static_cast<std::uint32_t>(i);
    return groups;
}

/// What a group contributes, by the nodes of its footprint.
struct GroupSums {
    std::vector<double> curvature; ///< the lower triangle, row by row
    std::array<double, span_nodes> power = {}, unsliding = {};
};

/// F_s on one sphere, by node: linear, then turning and so scaled that its square too counts with 1/m.
using Forces = std::array<std::array<double, span_nodes>, 6>;

class GroupSum
{
public:
    GroupSum(const Group& group, const LoadsOfSpheres& of, const std::vector<Load>& loads)
        : footprint_(group.footprint), nodes_(group.footprint.node_count()), of_(of), loads_(loads)
    {
        sums_.curvature.assign(static_cast<std::size_t>(nodes_ * (nodes_ + 1) / 2), 0.0);
    }

    void add(std::uint32_t sphere, double inverse_mass)
    {
        Forces forces;
        for (auto& row : forces) std::fill_n(row.begin(), nodes_, 0.0);
        for (const auto entry : of_.entries_of(sphere)) add_load(forces, loads_[entry / 2], entry % 2);
        double* sum = sums_.curvature.data();
        for (int s = 0; s < nodes_; ++s) {
            std::array<double, 6> scaled;
            for (std::size_t r = 0; r < 6; ++r) scaled[r] = inverse_mass * forces[r][static_cast<std::size_t>(s)];
            for (std::size_t t = 0; t <= static_cast<std::size_t>(s); ++t)
                *sum++ += scaled[0] * forces[0][t] + scaled[1] * forces[1][t] + scaled[2] * forces[2][t] +
                          scaled[3] * forces[3][t] + scaled[4] * forces[4][t] + scaled[5] * forces[5][t];
        }
    }

    GroupSums result() { return std::move(sums_); }

private:
    const Footprint& footprint_;
    int nodes_;
    const LoadsOfSpheres& of_;
    const std::vector<Load>& loads_;
    GroupSums sums_;

    void add_load(Forces& forces, const Load& load, bool is_b)
    {
        const Vec3 push = is_b ? -load.impulse : load.impulse;
        const Vec3 turn = std::sqrt(inverse_inertia_factor) * (is_b ? load.turn_b : load.turn_a);
        std::array<int, 3> begin;
        for (int d = 0; d < 3; ++d) begin[d] = load.place.cell[d] - footprint_.cell[d];
        for (int corner = 0; corner < 8; ++corner) {
            const auto at = corner_of_cell(corner);
            const double hat = load.place.hat(at);
            const auto node =
                static_cast<std::size_t>(footprint_.number(begin[0] + at[0], begin[1] + at[1], begin[2] + at[2]));
            for (int d = 0; d < 3; ++d) {
                forces[static_cast<std::size_t>(d)][node] += hat * push[d];
                forces[static_cast<std::size_t>(d + 3)][node] += hat * turn[d];
            }
            if (is_b) continue;
            sums_.power[node] += hat * load.power;
            sums_.unsliding[node] += hat * load.unsliding;
        }
    }
};

/// The nodes of a footprint by their numbers in the grid.
std::vector<std::size_t> nodes_of(const Footprint& footprint, const HatGrid& grid)
{
    std::vector<std::size_t> nodes;
    for (int k = 0; k < footprint.node_count(); ++k) {
        const auto at = footprint.offset(k);
        const auto& cell = footprint.cell;
        nodes.push_back(grid.number({cell[0] + at[0], cell[1] + at[1], cell[2] + at[2]}));
    }
    return nodes;
}

/// Of a node of a footprint among the 125 within reach: differences of codes are places in a stencil.
int stencil_code(const LatticeIndex& offset)
{
    return (offset[2] * reach + offset[1]) * reach + offset[0];
}
constexpr int stencil_center = reach_nodes / 2;

/// The rows of the nodes in use, in the order of the nodes' numbers. Returns the node of each.
std::vector<std::size_t> number_rows(std::vector<std::int32_t>& row_of, const Groups& groups, const HatGrid& grid)
{
    row_of.assign(grid.node_count(), -1);
    for (const auto& group : groups.list)
        for (const auto node : nodes_of(group.footprint, grid)) row_of[node] = 0;
    std::vector<std::size_t> nodes;
    for (std::size_t node = 0; node < row_of.size(); ++node) {
        if (row_of[node] < 0) continue;
        row_of[node] = static_cast<std::int32_t>(nodes.size());
        nodes.push_back(node);
    }
    return nodes;
}

/// Adds what a group contributes to the stencils of its nodes.
void add_group(CoarseEnergy& energy, std::vector<double>& stencils, const Footprint& footprint, const GroupSums& sums,
    const HatGrid& grid)
{
    const auto nodes = nodes_of(footprint, grid);
    std::array<std::int64_t, span_nodes> row, code;
    for (std::size_t s = 0; s < nodes.size(); ++s) {
        row[s] = energy.row_of[nodes[s]];
        code[s] = stencil_code(footprint.offset(static_cast<int>(s)));
        energy.power[row[s]] += sums.power[s];
        energy.unsliding[row[s]] += sums.unsliding[s];
    }
    const double* sum = sums.curvature.data();
    for (std::size_t s = 0; s < nodes.size(); ++s)
        for (std::size_t t = 0; t <= s; ++t, ++sum) {
            stencils[static_cast<std::size_t>(row[s] * reach_nodes + stencil_center + code[t] - code[s])] += *sum;
            if (t < s)
                stencils[static_cast<std::size_t>(row[t] * reach_nodes + stencil_center + code[s] - code[t])] += *sum;
        }
}

using Entries = std::vector<Eigen::Triplet<double>>;

/// The entries of A that are not zero.
void add_entries(Entries& entries, const std::vector<std::size_t>& nodes, const std::vector<double>& stencils,
    const std::vector<std::int32_t>& row_of, const HatGrid& grid)
{
    for (std::size_t row = 0; row < nodes.size(); ++row) {
        const auto node = grid.node(nodes[row]);
        for (int place = 0; place < reach_nodes; ++place) {
            const double value = stencils[row * reach_nodes + static_cast<std::size_t>(place)];
            if (value == 0.0) continue;
            const LatticeIndex other = {node[0] + place % reach - (span - 1),
                node[1] + place / reach % reach - (span - 1), node[2] + place / (reach * reach) - (span - 1)};
            entries.emplace_back(static_cast<std::int32_t>(row), row_of[grid.number(other)], value);
        }
    }
}

/// Pistons move along their guides only, and reach far: each binds all nodes that it reaches.
void add_pistons(Entries& entries, const CoarseEnergy& energy, const Loads& loads, const HatGrid& grid,
    const State& state, const Model& model)
{
    std::vector<std::map<std::int32_t, double>> impulse(model.pistons.size()); // by piston and row
    for (std::size_t k = loads.first_of_pistons(); k < loads.list.size(); ++k) {
        const Load& load = loads.list[k];
        const double along_guide = -load.impulse.dot(model.pistons[load.piston].guide);
        for_each_hat(load, grid, energy.row_of,
            [&](std::int32_t row, double hat) { impulse[load.piston][row] += hat * along_guide; });
    }
    for (std::size_t k = 0; k < model.pistons.size(); ++k) {
        if (!model.pistons[k].is_free(state.time)) continue;
        for (const auto& [row, own] : impulse[k])
            for (const auto& [column, other] : impulse[k])
                entries.emplace_back(row, column, own * other / model.pistons[k].mass);
    }
}

} // namespace

CoarseEnergy coarse_energy(const Loads& loads, const HatGrid& grid, const State& state, const Model& model)
{
    const LoadsOfSpheres of(loads.list, state.count());
    const Groups groups = group_spheres(of, loads.list, grid);
    const auto group_count = static_cast<std::int64_t>(groups.list.size());
    std::vector<GroupSums> sums(groups.list.size());
#pragma omp parallel for schedule(dynamic) if (group_count > 16)
    for (std::int64_t k = 0; k < group_count; ++k) {
        const auto g = static_cast<std::size_t>(k);
        GroupSum sum(groups.list[g], of, loads.list);
        for (auto i = groups.list[g].begin; i < groups.list[g].end; ++i)
            sum.add(groups.sphere[i], state.body(groups.sphere[i]).inverse_mass);
        sums[g] = sum.result();
    }

    CoarseEnergy energy;
    const auto nodes = number_rows(energy.row_of, groups, grid);
    energy.power = energy.unsliding = VectorXd::Zero(static_cast<Index>(nodes.size()));
    std::vector<double> stencils(nodes.size() * reach_nodes, 0.0);
    for (std::size_t g = 0; g < sums.size(); ++g) add_group(energy, stencils, groups.list[g].footprint, sums[g], grid);
    Entries entries;
    add_entries(entries, nodes, stencils, energy.row_of, grid);
    add_pistons(entries, energy, loads, grid, state, model);
    energy.curvature.resize(energy.power.size(), energy.power.size());
    energy.curvature.setFromTriplets(entries.begin(), entries.end());
    return energy;
}

} // namespace talus
