// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/build/build_scene.hpp"
#include "tests/scenarios/small_scene.hpp"

#include <catch2/catch.hpp>

#include <functional>
#include <limits>
#include <string>
#include <vector>

using namespace talus;
using namespace talus::test;

namespace
{

/// Beads at rest on the floor, and on each other.
std::string saved()
{
    auto simulation = build_scene(small_scene()).simulation;
    for (int k = 0; k < 1000; ++k) step(simulation);
    REQUIRE(!simulation.contacts.pairs.empty());
    REQUIRE(!simulation.contacts.wall_pairs.empty());
    Archive archive;
    archive(simulation);
    return archive.bytes();
}

void put_back(Simulation& simulation, const std::string& bytes)
{
    Archive archive(bytes);
    archive(simulation);
    CHECK(archive.at_end());
}

using Spoil = std::function<void(State&, ContactNetwork&)>;

const std::vector<std::pair<std::string, Spoil>> contradictions = {
    {"a list that is too short", [](State& s, ContactNetwork&) { s.id.pop_back(); }},
    {"a material that is not there", [](State& s, ContactNetwork&) { s.material[3] = 1; }},
    {"a wall that is not there", [](State& s, ContactNetwork&) { s.last_wall[3] = 1; }},
    {"no number", [](State& s, ContactNetwork&) { s.position[3].x() = std::numeric_limits<double>::quiet_NaN(); }},
    {"a sphere of no size", [](State& s, ContactNetwork&) { s.motion[3].radius = 0.0; }},
    {"a piston that is not there", [](State& s, ContactNetwork&) { s.pistons.emplace_back(); }},
    {"a pair with a sphere that is not there", [](State&, ContactNetwork& c) { c.pairs[0].b = 20; }},
    {"pairs of more tiles", [](State&, ContactNetwork& c) { c.pairs_of_tile.push_back(c.pairs_of_tile.back()); }},
    {"pairs past the end", [](State&, ContactNetwork& c) { c.pair_count[0] += 100000; }},
    {"impulses of fewer pairs", [](State&, ContactNetwork& c) { c.pair_carried.impulse.pop_back(); }},
    {"a sphere in a tile that is not there", [](State&, ContactNetwork& c) { c.tiles.spheres[0] = -1; }},
    {"colours of more tiles", [](State&, ContactNetwork& c) { ++c.tiles.color_first.back(); }},
    {"a patch that the wall does not have", [](State&, ContactNetwork& c) { c.patches[0] = 100; }},
    {"patches past the end", [](State&, ContactNetwork& c) { c.wall_pairs.back().patches += 1; }},
    {"boxes of more spheres", [](State&, ContactNetwork& c) { c.listed_box.emplace_back(); }},
};

} // namespace

TEST_CASE("a saved state is put back", "[saved_state]")
{
    const std::string bytes = saved();
    auto simulation = build_scene(small_scene()).simulation;
    put_back(simulation, bytes);
    Archive again;
    again(simulation);
    CHECK(again.bytes() == bytes);
    CHECK(step(simulation).contacts > 0);
}

TEST_CASE("a saved state that contradicts itself is refused", "[saved_state]")
{
    const std::string bytes = saved();
    for (const auto& [text, spoil] : contradictions) {
        INFO(text);
        auto simulation = build_scene(small_scene()).simulation, other = build_scene(small_scene()).simulation;
        put_back(simulation, bytes);
        spoil(simulation.state, simulation.contacts);
        Archive spoilt;
        spoilt(simulation);
        CHECK_THROWS_AS(put_back(other, spoilt.bytes()), ArchiveError);
    }
}
