// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/sweep_sums.hpp"
#include "core/contacts/contact_network.hpp"
#include "core/multibody/algorithm_3_1.hpp"
#include "core/world/state.hpp"

#include <vector>

namespace talus
{

/// The problem of a step's pistons in the words of core/multibody: first the contacts with them, in their order, then
/// a guide for each piston.
struct PistonProblem {
    multibody::Problem problem;         ///< bodies: the pistons, then the spheres below
    std::vector<std::int32_t> spheres;  ///< that have a contact with a piston
    std::vector<Eigen::Matrix3d> bases; ///< by contact: normal and two tangents as columns
    Eigen::VectorXd warm_impulse;       ///< λ⁰ [N s, N m s]
};

/// The constraints of a step that move pistons: their guides, and the contacts of spheres with them.
///
/// A contact that meets a piston beside its centre would turn it, so its block D_kk is not diagonal, which the sphere
/// kernel wants; and all contacts of a piston share that one body, so they cannot go into tiles. They form one group
/// that one thread takes after the tiles of a sweep: one sweep of Algorithm 3.1 (core/multibody) on velocities that are
/// fetched from the spheres and put back.
///
/// A guide has five holonomic rows, eq. (2) of the note with τ = 2h and without compliance: two displacements across
/// the axis and three angles; until the piston is released, the displacement along the axis too. Guides come last, so
/// that after every sweep, converged or not, a piston is on its guide to round-off.
class PistonGroup
{
public:
    /// Nothing where the model has no pistons. Reads v⁽⁰⁾ of the pistons.
    /// @pre the contacts of this step are assembled
    /// @param h of the step [s]
    PistonGroup(const ContactNetwork& network, const State& state, const Model& model, double h);
    PistonGroup(const PistonGroup&) = delete;
    PistonGroup& operator=(const PistonGroup&) = delete;

    bool empty() const { return sequence_.empty(); }

    /// v ← v + M⁻¹ Gᵀ λ⁰ for the spheres and the pistons.
    void warm_start(Body* bodies);

    /// One sweep; returns the sums of what it did.
    SweepSums sweep(Body* bodies);

    /// The sums of ε at these velocities.
    SweepSums measure(const Body* bodies);

    /// How the surface of a piston moves at this arm from its centre.
    WallRow motion_at(std::size_t piston, const Vec3& arm) const;

    /// The impulses of contact k grow by the share growth[k], and velocities with them; then the guides take up what
    /// would leave them.
    void scale(const std::vector<double>& growth, Body* bodies);

    /// Writes the impulses into the contacts, velocities and guide impulses into the pistons.
    void store(ContactNetwork& network, State& state) const;

private:
    PistonProblem own_;
    multibody::Iterate iterate_;
    multibody::ProjectedGaussSeidel<multibody::Iterate> algorithm_;
    std::vector<std::size_t> sequence_; ///< of the constraints
    std::vector<std::size_t> guides_;   ///< the last of them

    void fetch(const Body* bodies);
    void put_back(Body* bodies) const;
};

} // namespace talus
