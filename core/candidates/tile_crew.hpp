// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/candidates/tiles.hpp"

#include <omp.h>

#include <atomic>
#include <cstdint>
#include <optional>

namespace talus
{

/// Shares tiles out among the threads of a parallel region, colour after colour.
///
/// A sweep has eight colours and so eight barriers, a few microseconds apart. OpenMP's own barrier spins, and on a busy
/// machine a thread may then spin for a whole time slice while the one it waits for has no processor; this one gives
/// its processor away after a short spin.
class TileCrew
{
public:
    TileCrew(const Tiles& tiles, int threads) : tiles_(tiles), threads_(threads) {}

    /// Runs work(tile) for all tiles, the tiles of one colour at the same time. To be called by every thread of the
    /// region; all have finished when it returns.
    template <class Work> void color_by_color(Work&& work)
    {
        for (std::size_t color = 0; color < Tiles::colors; ++color) {
            const auto end = tiles_.color_first[color + 1];
            run_until(end, color + 1 < Tiles::colors ? end : 0, work);
        }
    }

    /// Calls work(tile) for all tiles at the same time.
    template <class Work> void all_at_once(Work&& work)
    {
        run_until(static_cast<std::uint32_t>(tiles_.count()), 0, work);
    }

    /// Runs work() once, on one thread; all wait for it.
    template <class Work> void by_one(Work&& work)
    {
        const auto once = [&](std::uint32_t) { work(); };
        run_until(1, 0, once);
    }

private:
    static constexpr int short_spin = 5000; ///< loads of a cached word: some microseconds

    const Tiles& tiles_;
    const int threads_;
    alignas(64) std::atomic<std::uint32_t> next_{0}; ///< tile to be taken next
    alignas(64) std::atomic<int> waiting_{0};
    alignas(64) std::atomic<std::uint32_t> round_{0};

    template <class Work> void run_until(std::uint32_t end, std::uint32_t next_begin, const Work& work)
    {
        for (auto t = next_.fetch_add(1, std::memory_order_relaxed); t < end;
             t = next_.fetch_add(1, std::memory_order_relaxed))
            work(t);
        wait_for_all(next_begin);
    }

    /// A barrier; the last thread to arrive sets the tile with which the next round begins.
    void wait_for_all(std::uint32_t next_tile)
    {
        const auto round = round_.load(std::memory_order_relaxed);
        if (waiting_.fetch_add(1, std::memory_order_acq_rel) + 1 == threads_) {
            waiting_.store(0, std::memory_order_relaxed);
            next_.store(next_tile, std::memory_order_relaxed);
            // Not release: notify_all reads whether anyone sleeps, and a processor may read that before it has written
            // this. Then one who goes to sleep in between is never woken.
            round_.store(round + 1, std::memory_order_seq_cst);
            round_.notify_all();
            return;
        }
        for (int spins = 0; spins < short_spin; ++spins)
            if (round_.load(std::memory_order_acquire) != round) return;
        round_.wait(round, std::memory_order_acquire);
    }
};

/// Runs body(crew) on every thread of a parallel region; on this thread alone where the tiles are too few to share.
template <class Body> void with_tile_crew(const Tiles& tiles, Body&& body)
{
    constexpr std::size_t few_tiles = 2 * Tiles::colors;
    std::optional<TileCrew> crew;
#pragma omp parallel if (tiles.count() > few_tiles)
    {
#pragma omp single
        crew.emplace(tiles, omp_get_num_threads());
        body(*crew);
    }
}

} // namespace talus
