// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

/// Contact problems in the format of FCLIB, the library of frictional contact problems: HDF5 files.
/// [Acary, Brémond, Koziara & Pérignon 2014, "FCLIB: a collection of discrete 3D frictional contact problems", INRIA
/// RT-0444; https://github.com/FrictionalContactLibrary/fclib]
namespace talus
{

/// What a problem is stated in.
///
///   local:            u = W r + q
///   global:           M v = H r + G l + f,   u = Hᵀ v + w,   Gᵀ v + b = 0
///   global_rolling:   global, with rolling friction
///
/// At every contact u and r obey the law of Signorini and Coulomb with the friction mu. FCLIB has no local form with
/// rolling friction.
enum class FclibForm { local, global, global_rolling };

/// Where a solver may begin, or what it found. A vector is empty where the file has none.
struct FclibGuess {
    Eigen::VectorXd v; ///< velocities of the bodies, one for each row of M; global forms
    Eigen::VectorXd u; ///< relative velocities at the contacts, rows_per_contact of each
    Eigen::VectorXd r; ///< reactions (forces or impulses), rows_per_contact of each contact; r_n > 0 pushes apart
    Eigen::VectorXd l; ///< reactions of the constraints, one for each column of G
};

/// A problem as FCLIB states it, in the units of its author: for N contacts and D rows of a contact, matrices and
/// vectors of D N rows hold contact after contact, and of each first the normal, then the tangents, then with rolling
/// friction the two axes of rolling.
struct FclibProblem {
    FclibForm form = FclibForm::local;
    int rows_per_contact = 3; ///< D, `spacedim` of the file: 3, or 2 in the plane; 5 with rolling friction

    Eigen::SparseMatrix<double> W; ///< local: D N × D N; need not be symmetric

    Eigen::SparseMatrix<double> M; ///< global: mass, n × n
    Eigen::SparseMatrix<double> H; ///< global: n × D N
    Eigen::SparseMatrix<double> G; ///< global: n × number of constraints, 0 where the file has none

    Eigen::VectorXd q;    ///< local: D N; u without reactions
    Eigen::VectorXd f;    ///< global: n
    Eigen::VectorXd w;    ///< global: D N
    Eigen::VectorXd b;    ///< global: one for each column of G
    Eigen::VectorXd mu;   ///< N; ‖r_t‖ ≤ mu r_n
    Eigen::VectorXd mu_r; ///< global_rolling: N; ‖r_rolling‖ ≤ mu_r r_n

    std::string title;
    std::string description;

    std::vector<FclibGuess> guesses;
    FclibGuess solution;

    /// Lists that FCLIB does not know, in the file's group "talus", of which other tools take no notice: where the
    /// bodies and contacts of a problem come from. Their names: `origin_lists`.
    std::map<std::string, Eigen::VectorXd> origin;

    Eigen::Index contacts() const { return mu.size(); }                         ///< N
    Eigen::Index contact_rows() const { return rows_per_contact * contacts(); } ///< D N
};

/// Of spheres: id, radius [m], position [m], three for each. Of contacts, but those that stop a spring: id_a, id_b (at
/// a wall −1), wall (−1 between spheres), gap [m], kind (0 resting, 1 open, 2 impact, 3 yielding, 4 bearing, 5
/// deferred), point [m], three for each.
inline constexpr std::array origin_lists = {"bodies/id", "bodies/radius", "bodies/position", "contacts/id_a",
    "contacts/id_b", "contacts/wall", "contacts/gap", "contacts/kind", "contacts/point"};

/// Reads a problem with its guesses and its solution. Of a file with several problems the first of global,
/// global_rolling and local is read. What FCLIB may store as triplets, compressed columns or compressed rows comes as
/// compressed columns, with entries of the same place added up.
/// @throws InputError where the file is missing, no HDF5 file or broken; lacks a group or dataset; holds a list of a
///   wrong length, an index out of range, a negative friction or a number that is not finite; or has constraints in
///   the local form (V, R, s)
FclibProblem read_fclib(const std::filesystem::path& path);

/// Writes a problem with its guesses and its solution, so that other tools for FCLIB read it: matrices as triplets,
/// empty vectors and texts left out. The file appears whole or not at all.
/// @pre sizes as FclibProblem says
/// @throws OutputError
void write_fclib(const FclibProblem& problem, const std::filesystem::path& path);

} // namespace talus
