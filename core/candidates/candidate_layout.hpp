// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/candidates/contact_network.hpp"
#include "core/world/model.hpp"
#include "core/world/state.hpp"

#include <vector>

namespace talus
{

/// Where the impulses of an entry come from.
struct EntrySource {
    static constexpr std::int32_t none = -1;
    std::int32_t old = none; ///< index in the old list
    bool opposite = false;   ///< the two spheres have changed places
};

/// A pair of spheres, a < b.
struct PairEntry {
    IndexPair pair;
    EntrySource source;
};

/// A sphere and a wall near it.
struct WallEntry {
    std::int32_t sphere, wall;
    std::uint32_t first, patches;         ///< in the entries' own patch array
    std::int32_t old = EntrySource::none; ///< index in the old list
};

/// A candidate list as it was found, in no particular order.
struct CandidateEntries {
    std::vector<PairEntry> pairs;
    std::vector<WallEntry> walls;
    std::vector<std::int32_t> patches;
};

/// Lays the list down in the network by tile, in the order in which it is swept; impulses stay with their pairs.
void lay_down(ContactNetwork& network, const CandidateEntries& entries, const State& state, const Model& model);

} // namespace talus
