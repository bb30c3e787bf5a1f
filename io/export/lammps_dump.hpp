// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/export/recorded_run.hpp"

#include <string>

/// Frames as LAMMPS dumps them, which OVITO reads. Its ids and types count from 1: ours + 1.
namespace talus
{

inline constexpr const char* particle_dump = "particles.lammpstrj";
inline constexpr const char* contact_dump = "contacts.dump";           ///< between spheres
inline constexpr const char* wall_contact_dump = "wall_contacts.dump"; ///< of spheres with walls

/// One frame of spheres, `dump custom`: id, type (material + 1), radius, x, y, z and what else the frame has. The box
/// is the cell along periodic axes, and shrunk round the spheres along the others.
std::string dump_particles(vtkPolyData& frame, std::size_t number, double time, const RecordedRun& run);

enum class ContactsOf { spheres, walls };

/// One frame of contacts, `dump local`: what touches, the force on the first sphere, the ends of the contact's line.
std::string dump_contacts(
    vtkPolyData& frame, std::size_t number, double time, const RecordedRun& run, ContactsOf which);

} // namespace talus
