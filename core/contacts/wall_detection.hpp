// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contacts/contact_network.hpp"
#include "core/contacts/wall_assembly.hpp"
#include "core/contacts/wall_contacts.hpp"
#include "core/world/placed_wall.hpp"

#include <span>
#include <vector>

namespace talus
{

/// A place where a sphere touches a wall, or will, by its pair.
struct WallMeeting {
    WallPair* pair;
    WallPoint at;
};

/// Finds where spheres meet walls. A sphere touches a wall where it is nearest; a gap is laid where the sphere's free
/// path comes nearest to the wall in this step. What lies behind the tangent plane of a nearer place is out of reach,
/// of whichever wall it is: so level joints are no obstacle.
class WallDetection
{
public:
    WallDetection(ContactNetwork& network, const State& state, const Model& model, const std::vector<PlacedWall>& walls,
        const StepConstants& step)
        : network_(network), state_(state), model_(model), walls_(walls), step_(step)
    {
    }

    /// The meetings of one sphere with all walls that stand near it, those of a pair behind each other.
    /// @param pairs of the sphere
    const std::vector<WallMeeting>& find(std::span<WallPair> pairs);

    /// The touches of one pair, in the order of its meetings: `use(WallTouch, WallMeeting)`.
    template <class Use> void lay(std::span<const WallMeeting> meetings, Use&& use)
    {
        WallPair& pair = *meetings.front().pair;
        points_.clear();
        for (const WallMeeting& meeting : meetings) points_.push_back(meeting.at);
        match_carried(network_.carried, pair, points_);
        if (model_.physics.attraction) stay_attached(pair);
        for (std::size_t k = 0; k < meetings.size(); ++k)
            use(touch(meetings[k], pair.first + static_cast<std::uint32_t>(k)), meetings[k]);
    }

    /// A pair that does not meet: what it carried is gone.
    void forget(WallPair& pair) { match_carried(network_.carried, pair, {}); }

    /// Where the image of the sphere is for which the walls are listed.
    Vec3 place(std::int32_t sphere) const;

private:
    ContactNetwork& network_;
    const State& state_;
    const Model& model_;
    const std::vector<PlacedWall>& walls_;
    const StepConstants& step_;
    Vec3 x_ = Vec3::Zero();      ///< of the sphere that is looked at …
    std::vector<WallPoint> now_; ///< … and where it is nearest to the patches of its walls
    std::vector<WallMeeting> meetings_;
    std::vector<WallPoint> points_;
    std::vector<std::uint8_t> hidden_;
    std::vector<Vec3> attached_; ///< normals of what attracted the sphere in the step before

    void note_attached(std::span<const WallPair> pairs);
    /// What attracts a sphere goes on to do so where it passes from wall to wall.
    void stay_attached(const WallPair& pair);
    void add_touching(WallPair& pair, double reach);
    void add_gaps(WallPair& pair, std::span<const WallPoint> now, std::size_t touching);
    void drop_hidden(std::size_t from, std::size_t behind_all, double radius);
    Vec3 free_velocity(const PlacedWall& wall, const Body& body, std::size_t patch) const;
    WallPoint nearest_on_path(
        const PlacedWall& wall, const WallPoint& now, const WallPoint& at_end, const Vec3& velocity) const;
    WallTouch touch(const WallMeeting& meeting, std::uint32_t slot) const;
};

} // namespace talus
