// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact_network.hpp"
#include "core/contacts/loads.hpp"
#include "core/multibody/problem.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

/// What a step's problem is made of in the words of core/multibody: its bodies, and the rows of its constraints.
namespace talus
{

inline constexpr Eigen::Index contact_rows = 1 + multibody::tangent_rows; ///< without those of rolling

/// The rows that each contact of a scene has: contact_rows, with rolling resistance two more, and one with twisting.
Eigen::Index rows_of_contact(const ModelledPhysics& physics);

/// The normal and two tangents as columns, right-handed: the directions of a contact's rows. Its rolling rows have the
/// tangents for axes.
Eigen::Matrix3d contact_basis(const Vec3& normal);

/// A vector in the directions of the first rows, and another one in those of the rolling rows.
Eigen::VectorXd in_rows(const Eigen::Matrix3d& basis, Eigen::Index rows, const Vec3& vector, const Vec3& rolling);

/// A body of one sphere: v with the mass m and, where it turns, a = r ω with 2/5 m.
/// @param gain h f/m [m/s]
void add_sphere_body(multibody::Problem& problem, const Body& body, bool spin, const Vec3& gain);

/// What its body contributes to the rows of a contact, METHOD (3): ±v + s n × a and, in the rolling rows, ±a/r.
/// @param sign 1 for a, −1 for b
Eigen::MatrixXd sphere_rows(
    const Eigen::Matrix3d& basis, Eigen::Index rows, const Body& body, bool spin, double sign, double arm_scale);

/// Appends a contact: its law, its compliance and its target, in which the prescribed velocity of a wall stands.
/// @param bodies what they contribute to its rows
void add_contact(multibody::Problem& problem, const TileContacts& contacts, std::size_t k, const Eigen::Matrix3d& basis,
    Eigen::Index rows, const std::vector<multibody::BodyRows>& bodies);

/// The angular impulse of a contact's rolling rows, the inverse of in_rows.
Vec3 rolling_in_space(const Eigen::Matrix3d& basis, const Eigen::Ref<const Eigen::VectorXd>& impulse);

/// The impulses that a contact has, by its rows.
Eigen::VectorXd impulse_in_rows(
    const TileContacts& contacts, std::size_t k, const Eigen::Matrix3d& basis, Eigen::Index rows);

/// A piston with the velocity of its centre and its spin; p = M v⁽⁰⁾ + h f.
/// @param attraction what that does to it in the step; @param h of the step [s], which begins at this time [s]
void add_piston_body(multibody::Problem& problem, const Piston& piston, const PistonState& own, const Vec3& gravity,
    const WallLoad& attraction, double h, double time);

/// What a piston contributes to the rows of a contact that lies at `arm` from its centre: −(V + Ω × arm), and −Ω.
Eigen::MatrixXd piston_rows(const Eigen::Matrix3d& basis, Eigen::Index rows, const Vec3& arm);

/// The guide of a piston: holonomic rows, eq. (2) of the note with τ = 2h and without compliance, for two displacements
/// across its axis, three turns and, until the piston is released, the displacement along its axis.
/// @param body the piston's number in the problem
void add_guide(
    multibody::Problem& problem, std::size_t body, const Piston& piston, const PistonState& own, double h, double time);

} // namespace talus
