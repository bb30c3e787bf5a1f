// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/candidates/candidate_list.hpp"
#include "core/contacts/contact.hpp"

#include <cstdint>
#include <ranges>
#include <vector>

namespace talus
{

/// Contacts of one kind in one step, by tile.
struct ContactArrays {
    std::vector<Contact> contact;
    std::vector<ContactTerms> terms;
    std::vector<RollingRow> rolling; ///< empty unless the scene has rolling resistance
    std::vector<WallRow> wall;       ///< empty unless walls move, and between spheres
    std::vector<ContactGeometry> geometry;
    std::vector<std::uint32_t> first; ///< by tile: where its contacts begin, and …
    std::vector<std::uint32_t> count; ///< … how many there are; the rest of a tile's slots is not used

    /// Makes room for as many contacts as there are slots.
    /// @param first_slot of each tile, and the number of all
    void resize(const std::vector<std::uint32_t>& first_slot, bool with_rolling, bool with_moving_walls = false);

    std::size_t tiles() const { return count.size(); }
    bool empty() const { return contact.empty(); }
    /// The indices of the contacts of a tile.
    auto of_tile(std::size_t tile) const
    {
        return std::views::iota(std::size_t{first[tile]}, std::size_t{first[tile]} + count[tile]);
    }
};

/// The contacts of one step; scratch, made anew in every step.
struct StepContacts {
    ContactArrays spheres;
    ContactArrays walls;           ///< without those with pistons …
    ContactArrays pistons;         ///< … which one thread takes after the tiles: all are in one
    std::vector<Vec3> piston_arms; ///< from the centre of the piston to where the contact is [m]

    /// Makes room for as many contacts as the list has slots.
    void resize(const CandidateList& list, const ModelledPhysics& physics);
    /// Forgets them, where spheres have been renumbered since.
    void clear();
};

/// Who may touch whom, who does, and with what impulse: all that a step needs beyond the spheres themselves.
///
///   kept from step to step                                     scratch of a step
///
///   list      update_candidates: listed boxes,
///     |       pairs by tile; the place of a pair is its slot
///     v
///   carried   λ, touch: by slot  -- assemble_contacts -->  contacts  n, g, law, λ⁰: by tile, those that are near
///     ^                                                        |     their `slot` says where λ comes from
///     |                                                        |     warm start, sweeps: λ
///     +------------------ carry_impulses ----------------------+
///
/// Impulses stay in place as long as the list does, and move with their pairs when it is laid down anew.
struct ContactNetwork {
    CandidateList list;
    Carried carried;
    StepContacts contacts;

    /// What is kept.
    void persist(Archive& archive) { archive(list, carried); }
};

} // namespace talus
