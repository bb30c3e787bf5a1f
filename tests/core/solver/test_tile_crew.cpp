// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/region.hpp"
#include "core/candidates/tile_crew.hpp"

#include <catch2/catch.hpp>

#include <chrono>
#include <cstdint>

using namespace talus;

namespace
{

/// Holds this thread up for that long: about as long as others spin before they go to sleep.
void linger(double microseconds)
{
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double, std::micro>(microseconds);
    while (std::chrono::steady_clock::now() < end) {}
}

} // namespace

TEST_CASE("a crew takes each tile once, no colour before the one before it, and never sleeps for ever", "[tile_crew]")
{
    constexpr int calls = 2000;
    const auto threads = GENERATE(1, 2, 3, 4);
    Tiles tiles;
    tiles.color_first = {0, 3, 3, 4, 9, 12, 13, 13, 20};
    tiles.tiles.resize(20);
    Random random(1);
    std::vector<double> delay; // of the last tile in a call
    for (int call = 0; call < calls; ++call) delay.push_back(call % 4 == 0 ? 40 * uniform(random) : 0);

    const auto color_of = [&](std::uint32_t t) {
        std::size_t color = 0;
        while (tiles.color_first[color + 1] <= t) ++color;
        return color;
    };
    // Each visit writes down how many tiles before its colour had been taken in this call: without a barrier, too few.
    std::vector<int> visits(tiles.count()), missed(tiles.count());
    int turns = 0, late = 0;
    TileCrew crew(tiles, threads);
#pragma omp parallel num_threads(threads)
    for (int call = 0; call < calls; ++call) {
        crew.color_by_color([&](std::uint32_t t) {
            for (std::uint32_t before = 0; before < tiles.color_first[color_of(t)]; ++before)
                if (visits[before] != call + 1) ++missed[t];
            if (t + 1 == tiles.count()) linger(delay[static_cast<std::size_t>(call)]);
            ++visits[t];
        });
        crew.by_one([&] {
            if (++turns != call + 1 || visits.back() != turns) ++late;
        });
    }
    CHECK(visits == std::vector<int>(tiles.count(), calls));
    CHECK(missed == std::vector<int>(tiles.count(), 0));
    CHECK(turns == calls);
    CHECK(late == 0);
}
